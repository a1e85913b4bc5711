#pragma once

#include <filesystem>

#include "candela/scene/diagnostics.hpp"
#include "candela/scene/scene.hpp"

namespace candela::io {

/// Writes what glTF can carry of a scene as it stands: meshes, materials, textures, cameras, instances, and
/// lights by KHR_lights_punctual, EXT_lights_ies and EXT_lights_area. A .glb holds everything; of a .gltf the
/// buffer with the pictures and profiles is in a .bin beside it. Raises a warning for each thing that glTF
/// cannot say. Throws Error when the folder is missing or the disk is full.
void write_gltf(const std::filesystem::path& file, const scene::Scene& scene, Diagnostics& diagnostics);

}  // namespace candela::io
