#include "candela/realtime/packed_textures.hpp"

#include <cmath>

namespace candela::realtime {

std::uint32_t PackedTextures::first_texel(std::uint32_t image) {
    const auto [entry, fresh] =
        texel_of_image_.try_emplace(image, static_cast<std::uint32_t>(texels_.size()));
    if (fresh) {
        const std::vector<std::uint8_t>& rgba = scene_->images[image].rgba;
        for (std::size_t i = 0; i + 3 < rgba.size(); i += 4) {
            texels_.push_back(std::uint32_t{rgba[i]} | std::uint32_t{rgba[i + 1]} << 8u |
                              std::uint32_t{rgba[i + 2]} << 16u | std::uint32_t{rgba[i + 3]} << 24u);
        }
    }
    return entry->second;
}

std::uint32_t PackedTextures::add_record(std::uint32_t image, const scene::Sampler& sampler) {
    const scene::Image& picture = scene_->images[image];
    const std::uint32_t nearest = sampler.magnify == scene::Filter::nearest ? 1u : 0u;
    const std::uint32_t how = static_cast<std::uint32_t>(sampler.wrap_s) |
                              static_cast<std::uint32_t>(sampler.wrap_t) << 2u | nearest << 4u;
    records_.push_back({first_texel(image), picture.width, picture.height, how});
    return static_cast<std::uint32_t>(records_.size() - 1);
}

std::uint32_t PackedTextures::record_of_image(std::uint32_t image) {
    if (image >= scene_->images.size() || scene_->images[image].rgba.empty()) return kNoRecord;
    scene::Sampler edge;
    edge.wrap_s = edge.wrap_t = scene::Wrap::clamp_to_edge;
    return add_record(image, edge);
}

std::uint32_t PackedTextures::record_of(const scene::TextureRef& ref) {
    if (ref.texture >= scene_->textures.size()) return kNoRecord;
    const scene::Texture& texture = scene_->textures[ref.texture];
    if (texture.image >= scene_->images.size() || scene_->images[texture.image].rgba.empty())
        return kNoRecord;
    const auto known = record_of_texture_.find(ref.texture);
    if (known != record_of_texture_.end()) return known->second;
    return record_of_texture_[ref.texture] = add_record(texture.image, texture.sampler);
}

glm::vec2 transformed_uv(const scene::TextureRef& ref, const glm::vec2& uv) {
    const float c = std::cos(ref.rotation_rad);
    const float s = std::sin(ref.rotation_rad);
    const glm::vec2 scaled = uv * ref.scale;
    return {c * scaled.x + s * scaled.y + ref.offset.x, -s * scaled.x + c * scaled.y + ref.offset.y};
}

}  // namespace candela::realtime
