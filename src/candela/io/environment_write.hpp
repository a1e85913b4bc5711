#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "candela/scene/cube_map.hpp"
#include "candela/scene/scene.hpp"

/// Filtered environments for other programs.
namespace candela::io {

/// How EnvironmentPreset::candela stores its cubes.
enum class CubeFormat : std::uint8_t {
    ktx2,         ///< RGBA16F
    ktx2_rgb9e5,  ///< E5B9G9R9: half the size, nine bits for the strongest channel
    dds,          ///< RGBA16F, DX10 header
    exr,          ///< one equirectangular EXR a level
    exr_faces,    ///< six EXR a level
};

/// Whose conventions the files follow (docs/image-based-light.md, "Formats and conventions").
enum class EnvironmentPreset : std::uint8_t {
    candela,
    filament,  ///< KTX 1 as cmgen writes it, R11F_G11F_B10F, with the harmonics inside
    threejs,   ///< the unfiltered picture as EXR, which three.js filters itself, and a LightProbe
    gltf,      ///< EXT_lights_image_based: RGBD faces and a glTF file that refers to them
};

[[nodiscard]] const char* name_of(CubeFormat format);
[[nodiscard]] const char* name_of(EnvironmentPreset preset);
/// None for names that are no preset's (or format's).
[[nodiscard]] std::optional<CubeFormat> cube_format_by_name(const std::string& name);
[[nodiscard]] std::optional<EnvironmentPreset> preset_by_name(const std::string& name);

/// What an environment must be filtered to for a preset; write_filtered_environment refuses others.
struct FilterDemand {
    std::optional<scene::RoughnessMapping> mapping;  ///< none: any
    std::uint32_t smallest_level = 1;                ///< texels a side of the coarsest level, at least
    bool power_of_two = false;
};
[[nodiscard]] FilterDemand demand_of(EnvironmentPreset preset);

/// Writes the cubes, the harmonics (.json, .h, .glsl) and environment.json, which says what they mean, into
/// `folder`, which is made when it is not there. `format` is of EnvironmentPreset::candela alone; `source`,
/// of threejs alone, is what was filtered: written as it is, scaled and turned by whole texels, instead of
/// level 0. All or nothing: the files appear under their names when all are whole. Returns their names,
/// environment.json last. Throws Error (Fault::input for a folder that cannot be had or an environment
/// against demand_of, Fault::machine when the disk fails).
std::vector<std::filesystem::path> write_filtered_environment(const std::filesystem::path& folder,
                                                              const scene::FilteredEnvironment& environment,
                                                              CubeFormat format, EnvironmentPreset preset,
                                                              const scene::Environment* source = nullptr);

}  // namespace candela::io
