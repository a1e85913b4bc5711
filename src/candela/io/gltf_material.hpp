#pragma once

#include <array>
#include <vector>

#include "candela/io/gltf_document.hpp"
#include "candela/scene/progress.hpp"
#include "candela/scene/scene.hpp"

namespace candela::io {

/// Which of the file's TEXCOORD_n the sets of scene::Primitive::uv are.
using UvSets = std::array<std::uint32_t, 2>;

/// The materials of a document, with every KHR_materials_* extension that scene::Material carries, their
/// textures and samplers, each read when it is first asked for: what no primitive uses is not read.
class GltfMaterials {
  public:
    /// Scene::materials, textures and images take the places that they have in the file.
    GltfMaterials(const GltfDocument& document, scene::Scene& scene);

    /// Reads the material, and says which sets its textures take their coordinates from: the first two,
    /// unless it uses others.
    const UvSets& uv_sets(std::uint32_t material);

  private:
    [[nodiscard]] UvSets assign_uv_sets(scene::Material& material, const JsonView& source) const;

    const GltfDocument& document_;
    scene::Scene& scene_;
    std::vector<std::optional<UvSets>> materials_;
    std::vector<bool> textures_;
};

/// All textures that a material may use.
[[nodiscard]] std::array<scene::TextureRef*, 13> texture_refs(scene::Material& material);

/// Texture `index` of the document with its sampler; without an image when it has none that can be read.
[[nodiscard]] scene::Texture read_texture(const GltfDocument& document, std::uint32_t index);

/// Decodes the images that the scene's materials use, on all processors; the others stay empty. A texture
/// whose image is missing or broken is taken out of its materials, with a warning.
/// `progress` after each image, by any thread, one at a time.
void read_images(const GltfDocument& document, const StepFunction& progress, scene::Scene& scene);

}  // namespace candela::io
