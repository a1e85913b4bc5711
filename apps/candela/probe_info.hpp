#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "candela/scene/probe.hpp"

namespace candela::app {

/// Where a probe of the stage stands and what it reaches.
[[nodiscard]] nlohmann::json probe_json(const scene::ReflectionProbe& probe);
[[nodiscard]] nlohmann::json volume_json(const scene::IrradianceVolume& volume);

/// The same for people.
[[nodiscard]] std::string probe_line(const nlohmann::json& probe);
[[nodiscard]] std::string volume_line(const nlohmann::json& volume);

}  // namespace candela::app
