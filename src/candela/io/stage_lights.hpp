#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "candela/io/inside_folder.hpp"
#include "candela/scene/diagnostics.hpp"
#include "candela/scene/light_units.hpp"
#include "candela/scene/scene.hpp"

namespace candela::io {

/// One entry of a stage's `lights`: a new light, or what becomes of lights that the scene has.
struct StageLight {
    std::string where;                     ///< file and JSON pointer, for what shows only beside a scene
    std::vector<std::string> keys;         ///< that the entry has
    std::optional<std::string> overrides;  ///< the name of the scene's lights that this changes
    bool off = false;                      ///< ... or takes away
    std::optional<std::string> node;       ///< in whose frame the light stands
    std::optional<scene::LightType> type;
    std::optional<scene::LightStrength> strength;
    std::optional<glm::dvec3> position;  ///< in the world, or in the frame of `node`
    std::optional<glm::vec3> direction;
    std::optional<glm::dvec3> look_at;  ///< the same
    std::optional<glm::vec3> right;
    float roll_rad = 0.0f;
    std::filesystem::path profile;  ///< IES or EULUMDAT; empty: none
    std::optional<scene::ProfileScale> profile_scale;
    float profile_multiplier = 1.0f;
    std::filesystem::path image;  ///< on a rectangle; empty: none
    /// The rest: what each key does to a light that has its type.
    std::vector<std::function<void(scene::Light&)>> edits;
};

/// Reads the array `lights`. Throws Error (Fault::input) naming file and JSON pointer.
[[nodiscard]] std::vector<StageLight> read_stage_lights(const nlohmann::json& value, const std::string& where,
                                                        const SearchFolders& folders);

/// Throws Error (Fault::input) for a key that lights of this type do not have.
void check_stage_light_keys(const StageLight& light, scene::LightType type);

/// Puts the lights into the scene, in the order of the file, so that a later entry may override an earlier
/// one. Throws Error (Fault::input) for a node or light that the scene does not have.
void place_stage_lights(const std::vector<StageLight>& lights, scene::Scene& scene, Diagnostics& diagnostics);

}  // namespace candela::io
