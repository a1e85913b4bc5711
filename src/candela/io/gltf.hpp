#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "candela/scene/diagnostics.hpp"
#include "candela/scene/scene.hpp"

namespace candela::io {

struct GltfOptions {
    float time_s =
        0.0f;  ///< animations, skins and morph targets are evaluated here; channels clamp at their ends
    float light_scale =
        1.0f;  ///< multiplies every KHR_lights_punctual intensity (exporters that lie about units)
};

/// Reads .gltf or .glb (told apart by content) with everything it refers to inside its own folder; poses it
/// at options.time_s. Throws Error (Fault::input) with file and JSON pointer; raises warnings for what is
/// skipped.
[[nodiscard]] scene::Scene load_gltf(const std::filesystem::path& file, const GltfOptions& options,
                                     Diagnostics& diagnostics);

/// The same from memory; external URIs are errors. `name` stands for the file in messages.
[[nodiscard]] scene::Scene load_gltf_from_memory(std::span<const std::byte> bytes, const std::string& name,
                                                 const GltfOptions& options, Diagnostics& diagnostics);

}  // namespace candela::io
