#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "candela/scene/scene.hpp"

namespace candela::io {

/// Where an entry of a stage's probes stands, beside what it is: a node of the scene, found once there is a
/// scene.
template <class Probe>
struct StageProbe {
    std::string where;                ///< file and JSON pointer
    std::optional<std::string> node;  ///< in whose frame it stands
    Probe probe;                      ///< but for its place about its own middle
    glm::dvec3 center{0.0};           ///< in the world, or in the frame of `node`
};

struct StageProbes {
    std::vector<StageProbe<scene::ReflectionProbe>> reflection;
    std::vector<StageProbe<scene::IrradianceVolume>> irradiance;
};

/// The arrays `reflection_probes` and `irradiance_volumes`. Throw Error (Fault::input) naming file and JSON
/// pointer.
void read_reflection_probes(const nlohmann::json& value, const std::string& where, StageProbes& out);
void read_irradiance_volumes(const nlohmann::json& value, const std::string& where, StageProbes& out);

/// Puts them into the scene, the smallest first. Throws Error (Fault::input) for a node that the scene does
/// not have.
void place_stage_probes(const StageProbes& probes, scene::Scene& scene);

}  // namespace candela::io
