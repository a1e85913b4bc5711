#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "candela/scene/probe.hpp"
#include "candela/scene/world_frame.hpp"

namespace candela::app {

/// Where a probe of the stage stands and what it reaches.
[[nodiscard]] nlohmann::json probe_json(const scene::ReflectionProbe& probe, const scene::WorldFrame& frame);
[[nodiscard]] nlohmann::json volume_json(const scene::IrradianceVolume& volume,
                                         const scene::WorldFrame& frame);

/// The same for people.
[[nodiscard]] std::string probe_line(const nlohmann::json& probe);
[[nodiscard]] std::string volume_line(const nlohmann::json& volume);

}  // namespace candela::app
