#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "candela/realtime/emissive_lights.hpp"
#include "candela/scene/scene.hpp"

namespace candela::app {

/// A light in all the units that apply, with its size, colour, range and carrier.
[[nodiscard]] nlohmann::json light_json(const scene::Light& light, const scene::Scene& scene);

/// The same for people: a first line, and its quantities below.
[[nodiscard]] std::vector<std::string> light_lines(const nlohmann::json& light);

/// An emissive surface, as a light.
[[nodiscard]] nlohmann::json emissive_json(const realtime::EmissiveSurface& surface,
                                           const scene::Scene& scene);
[[nodiscard]] std::vector<std::string> emissive_lines(const nlohmann::json& surface);

}  // namespace candela::app
