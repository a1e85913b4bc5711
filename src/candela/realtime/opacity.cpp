#include "candela/realtime/opacity.hpp"

#include <algorithm>

namespace candela::realtime {
namespace {

bool every_texel_opaque(const scene::Image& image) {
    for (std::size_t i = 3; i < image.rgba.size(); i += 4) {
        if (image.rgba[i] != 255) return false;
    }
    return true;
}

}  // namespace

Opacity::Opacity(const scene::Scene& scene) : scene_(&scene), image_is_opaque_(scene.images.size(), true) {
    for (const scene::Material& material : scene.materials) {
        const scene::TextureRef& ref = material.base_color_texture;
        if (material.alpha_mode != scene::AlphaMode::blend || ref.texture >= scene.textures.size()) continue;
        const std::uint32_t image = scene.textures[ref.texture].image;
        if (image < scene.images.size()) image_is_opaque_[image] = every_texel_opaque(scene.images[image]);
    }
}

bool Opacity::needs_blending(const scene::Primitive& primitive) const {
    const scene::Material& material = scene_->materials[primitive.material];
    if (material.alpha_mode != scene::AlphaMode::blend) return false;
    if (material.base_color.a < 1.0f) return true;
    const scene::TextureRef& ref = material.base_color_texture;
    if (ref.texture < scene_->textures.size()) {
        const std::uint32_t image = scene_->textures[ref.texture].image;
        if (image < image_is_opaque_.size() && !image_is_opaque_[image]) return true;
    }
    return std::any_of(primitive.colors.begin(), primitive.colors.end(),
                       [](const glm::vec4& color) { return color.a < 1.0f; });
}

}  // namespace candela::realtime
