#include "candela/realtime/emissive_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

#include "shading/transfer.glsl"

namespace candela::realtime {
namespace {

glm::vec2 transformed(const scene::TextureRef& ref, const glm::vec2& uv) {
    const float c = std::cos(ref.rotation_rad);
    const float s = std::sin(ref.rotation_rad);
    const glm::vec2 scaled = uv * ref.scale;
    return ref.offset + glm::vec2(c * scaled.x + s * scaled.y, c * scaled.y - s * scaled.x);
}

/// An emissive texture with its codes decoded through a table: a mesh has millions of taps.
class EmissiveTexture {
  public:
    EmissiveTexture(const scene::Scene& scene, const scene::TextureRef& ref) : ref_(ref) {
        if (!ref || ref.texture >= scene.textures.size()) return;
        const std::uint32_t index = scene.textures[ref.texture].image;
        if (index >= scene.images.size() || scene.images[index].rgba.empty()) return;
        image_ = &scene.images[index];
        for (std::size_t code = 0; code < linear_.size(); ++code)
            linear_[code] = shading::linear_from_srgb(glm::vec3(static_cast<float>(code) / 255.0f)).x;
    }
    [[nodiscard]] bool present() const noexcept { return image_ != nullptr; }

    /// Mean over a triangle, by points on a grid of its barycentric coordinates: one for each texel that it
    /// covers, up to 64.
    [[nodiscard]] glm::vec3 mean(const std::array<glm::vec2, 3>& corner_uv) const {
        std::array<glm::vec2, 3> uv;
        for (std::size_t c = 0; c < 3; ++c) uv[c] = transformed(ref_, corner_uv[c]);
        const glm::vec2 size(image_->width, image_->height);
        const glm::vec2 ab = (uv[1] - uv[0]) * size;
        const glm::vec2 ac = (uv[2] - uv[0]) * size;
        const float texels = 0.5f * std::abs(ab.x * ac.y - ab.y * ac.x) + glm::length(ab) + glm::length(ac);
        const int steps =
            texels > 0.0f ? std::clamp(static_cast<int>(std::ceil(std::sqrt(texels))), 2, 8) : 2;
        glm::vec3 sum(0.0f);
        for (int i = 0; i < steps * steps; ++i) {
            float b = (static_cast<float>(i % steps) + 0.5f) / static_cast<float>(steps);
            float c = (static_cast<float>(i / steps) + 0.5f) / static_cast<float>(steps);
            if (b + c > 1.0f) b = 1.0f - b, c = 1.0f - c;
            sum += texel((1.0f - b - c) * uv[0] + b * uv[1] + c * uv[2]);
        }
        return sum / static_cast<float>(steps * steps);
    }

  private:
    [[nodiscard]] glm::vec3 texel(const glm::vec2& uv) const {
        const auto at = [](float x, std::uint32_t size) {
            const float wrapped = x - std::floor(x);
            return std::min(static_cast<std::uint32_t>(wrapped * static_cast<float>(size)), size - 1);
        };
        const std::size_t first =
            (std::size_t{at(uv.y, image_->height)} * image_->width + at(uv.x, image_->width)) * 4;
        const auto code = [&](std::size_t c) { return linear_[image_->rgba[first + c]]; };
        return {code(0), code(1), code(2)};
    }

    scene::TextureRef ref_;
    const scene::Image* image_ = nullptr;
    std::array<float, 256> linear_{};
};

std::vector<EmissivePiece> pieces_of(const scene::Scene& scene, const scene::Primitive& p,
                                     const glm::mat4& world) {
    const scene::Material& material = scene.materials[p.material];
    const EmissiveTexture texture(scene, material.emissive_texture);
    const auto& uv = p.uv[material.emissive_texture.uv_set & 1u];
    const bool textured = texture.present() && !uv.empty();
    const bool mirrored = glm::determinant(glm::mat3(world)) < 0.0f;
    std::vector<EmissivePiece> pieces;
    for (std::size_t i = 0; i + 2 < p.indices.size(); i += 3) {
        EmissivePiece piece;
        piece.nit = material.emissive_nit;
        if (textured)
            piece.nit *= texture.mean({uv[p.indices[i]], uv[p.indices[i + 1]], uv[p.indices[i + 2]]});
        if (piece.nit == glm::vec3(0.0f)) continue;
        for (std::size_t c = 0; c < 3; ++c)
            piece.corners[c] = glm::vec3(world * glm::vec4(p.positions[p.indices[i + c]], 1.0f));
        if (mirrored) std::swap(piece.corners[1], piece.corners[2]);
        piece.two_sided = material.double_sided;
        if (glm::length(piece.vector_area()) > 0.0f) pieces.push_back(piece);
    }
    return pieces;
}

}  // namespace

std::vector<EmissivePart> emissive_parts(const scene::Scene& scene) {
    std::vector<EmissivePart> parts;
    for (std::uint32_t index = 0; index < scene.instances.size(); ++index) {
        const scene::Instance& instance = scene.instances[index];
        for (const scene::Primitive& p : scene.meshes[instance.mesh].primitives) {
            const scene::Material& material = scene.materials[p.material];
            if (material.unlit || material.emissive_nit == glm::vec3(0.0f)) continue;
            EmissivePart part{index, p.material, pieces_of(scene, p, instance.world)};
            if (!part.pieces.empty()) parts.push_back(std::move(part));
        }
    }
    return parts;
}

}  // namespace candela::realtime
