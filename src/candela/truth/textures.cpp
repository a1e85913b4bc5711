#include "candela/truth/textures.hpp"

#include <algorithm>
#include <cmath>

#include "shading/transfer.glsl"

namespace candela::truth {
namespace {

int wrapped(int i, int size, scene::Wrap wrap) {
    switch (wrap) {
        case scene::Wrap::clamp_to_edge:
            return std::clamp(i, 0, size - 1);
        case scene::Wrap::mirrored_repeat: {
            const int period = 2 * size;
            const int m = ((i % period) + period) % period;
            return m < size ? m : period - 1 - m;
        }
        default: {
            const int m = i % size;
            return m < 0 ? m + size : m;
        }
    }
}

/// Hostile coordinates must not overflow an int; beyond this a texture is noise anyway.
float tame(float x) {
    return std::isfinite(x) ? std::clamp(x, -1.0e6f, 1.0e6f) : 0.0f;
}

}  // namespace

Textures::Textures(const scene::Scene& scene) : scene_(&scene) {
    for (std::size_t i = 0; i < linear_from_srgb_.size(); ++i) {
        linear_from_srgb_[i] = shading::linear_from_srgb(glm::vec3(static_cast<float>(i) / 255.0f)).x;
    }
}

glm::vec4 Textures::texel(const scene::Image& image, int x, int y, Transfer transfer) const {
    const std::uint8_t* t =
        image.rgba.data() +
        (static_cast<std::size_t>(y) * image.width + static_cast<std::size_t>(x)) * std::size_t{4};
    constexpr float unit = 1.0f / 255.0f;
    const float alpha = static_cast<float>(t[3]) * unit;
    if (transfer == Transfer::srgb) {
        return {linear_from_srgb_[t[0]], linear_from_srgb_[t[1]], linear_from_srgb_[t[2]], alpha};
    }
    return {static_cast<float>(t[0]) * unit, static_cast<float>(t[1]) * unit, static_cast<float>(t[2]) * unit,
            alpha};
}

glm::vec4 Textures::read(const scene::TextureRef& ref, const glm::vec2& uv, Transfer transfer) const {
    if (ref.texture >= scene_->textures.size()) return glm::vec4(1.0f);
    const scene::Texture& texture = scene_->textures[ref.texture];
    if (texture.image >= scene_->images.size()) return glm::vec4(1.0f);
    const scene::Image& image = scene_->images[texture.image];
    if (image.rgba.empty()) return glm::vec4(1.0f);
    return filtered(image, texture.sampler, transformed_uv(ref, uv), transfer);
}

glm::vec3 Textures::read_srgb_image(std::uint32_t image, const glm::vec2& uv) const {
    if (image >= scene_->images.size() || scene_->images[image].rgba.empty()) return glm::vec3(1.0f);
    scene::Sampler edge;
    edge.wrap_s = edge.wrap_t = scene::Wrap::clamp_to_edge;
    return glm::vec3(filtered(scene_->images[image], edge, uv, Transfer::srgb));
}

glm::vec3 Textures::mean_of_srgb_image(std::uint32_t image) const {
    if (image >= scene_->images.size() || scene_->images[image].rgba.empty()) return glm::vec3(1.0f);
    const scene::Image& picture = scene_->images[image];
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i + 3 < picture.rgba.size(); i += 4) {
        for (int c = 0; c < 3; ++c)
            sum[c] += static_cast<double>(linear_from_srgb_[picture.rgba[i + static_cast<std::size_t>(c)]]);
    }
    return glm::vec3(sum / static_cast<double>(picture.rgba.size() / 4));
}

glm::vec4 Textures::filtered(const scene::Image& image, const scene::Sampler& s, const glm::vec2& at,
                             Transfer transfer) const {
    const int width = static_cast<int>(image.width);
    const int height = static_cast<int>(image.height);
    const float x = tame(at.x) * static_cast<float>(width);
    const float y = tame(at.y) * static_cast<float>(height);
    if (s.magnify == scene::Filter::nearest) {
        return texel(image, wrapped(static_cast<int>(std::floor(x)), width, s.wrap_s),
                     wrapped(static_cast<int>(std::floor(y)), height, s.wrap_t), transfer);
    }
    const float left = std::floor(x - 0.5f);
    const float top = std::floor(y - 0.5f);
    const float fx = x - 0.5f - left;
    const float fy = y - 0.5f - top;
    const int x0 = wrapped(static_cast<int>(left), width, s.wrap_s);
    const int x1 = wrapped(static_cast<int>(left) + 1, width, s.wrap_s);
    const int y0 = wrapped(static_cast<int>(top), height, s.wrap_t);
    const int y1 = wrapped(static_cast<int>(top) + 1, height, s.wrap_t);
    const glm::vec4 upper =
        texel(image, x0, y0, transfer) * (1.0f - fx) + texel(image, x1, y0, transfer) * fx;
    const glm::vec4 lower =
        texel(image, x0, y1, transfer) * (1.0f - fx) + texel(image, x1, y1, transfer) * fx;
    return upper * (1.0f - fy) + lower * fy;
}

glm::vec2 transformed_uv(const scene::TextureRef& ref, const glm::vec2& uv) {
    const glm::vec2 scaled = uv * ref.scale;
    if (ref.rotation_rad == 0.0f) return scaled + ref.offset;
    const float c = std::cos(ref.rotation_rad);
    const float s = std::sin(ref.rotation_rad);
    return {c * scaled.x + s * scaled.y + ref.offset.x, -s * scaled.x + c * scaled.y + ref.offset.y};
}

}  // namespace candela::truth
