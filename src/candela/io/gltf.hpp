#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "candela/scene/diagnostics.hpp"
#include "candela/scene/memory_budget.hpp"
#include "candela/scene/progress.hpp"
#include "candela/scene/scene.hpp"

namespace candela::io {

/// What the numbers of KHR_lights_punctual mean. Blender's exporter writes one of these, by its "lighting
/// mode".
enum class GltfLightUnits : std::uint8_t {
    spec,      ///< cd and lx, as the extension says; Blender's "Standard"
    unitless,  ///< 1/683 of that; Blender's "Unitless"
    raw,       ///< W of a point or spot, W/m^2 of a sun; Blender's "Raw"
};

struct GltfOptions {
    float time_s =
        0.0f;  ///< animations, skins and morph targets are evaluated here; channels clamp at their ends
    float light_scale = 1.0f;  ///< multiplies every light of the file
    GltfLightUnits light_units = GltfLightUnits::spec;
    StepFunction progress;                      ///< from any thread, one at a time
    std::optional<scene::MemoryBudget> memory;  ///< absent: what the machine has left
    std::string animation;                      ///< the one that plays, by name or number; empty: the first
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
