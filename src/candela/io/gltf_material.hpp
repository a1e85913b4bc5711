#pragma once

#include "candela/io/gltf_document.hpp"
#include "candela/scene/progress.hpp"
#include "candela/scene/scene.hpp"

namespace candela::io {

/// Reads a material with every KHR_materials_* extension that scene::Material carries.
[[nodiscard]] scene::Material read_material(const GltfDocument& document, std::uint32_t index,
                                            Diagnostics& diagnostics);

/// Reads samplers and textures; images are decoded by read_images.
void read_textures(const GltfDocument& document, scene::Scene& scene);

/// Decodes the images that the scene's materials use, on all processors; the others stay empty.
/// `progress` after each image, by any thread, one at a time.
void read_images(const GltfDocument& document, const StepFunction& progress, scene::Scene& scene);

}  // namespace candela::io
