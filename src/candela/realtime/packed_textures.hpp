#pragma once

#include <map>
#include <vector>

#include "candela/realtime/table_writer.hpp"
#include "candela/scene/scene.hpp"

namespace candela::realtime {

/// Pictures as words of a buffer, for shaders that must read a texture whose number only they know: the
/// devices that Candela runs on at least need not have arrays of textures indexed at will. Level 0 only.
class PackedTextures {
  public:
    explicit PackedTextures(const scene::Scene& scene) : scene_(&scene) {}

    /// Number of the record of a texture; kNoRecord where there is no picture, which reads as white.
    [[nodiscard]] std::uint32_t record_of(const scene::TextureRef& ref);
    /// The same of a picture without a sampler: filtered, clamped to its edges.
    [[nodiscard]] std::uint32_t record_of_image(std::uint32_t image);

    /// One a texture: first word of its texels, width, height, how it wraps and filters
    /// (shaders/tables.glsl).
    [[nodiscard]] const std::vector<Quad>& records() const noexcept { return records_; }
    /// RGBA8, red in the low byte.
    [[nodiscard]] const std::vector<std::uint32_t>& texels() const noexcept { return texels_; }

  private:
    std::uint32_t first_texel(std::uint32_t image);
    std::uint32_t add_record(std::uint32_t image, const scene::Sampler& sampler);

    const scene::Scene* scene_;
    std::vector<Quad> records_;
    std::vector<std::uint32_t> texels_;
    std::map<std::uint32_t, std::uint32_t> record_of_texture_;
    std::map<std::uint32_t, std::uint32_t> texel_of_image_;
};

/// KHR_texture_transform: translation * rotation * scale.
[[nodiscard]] glm::vec2 transformed_uv(const scene::TextureRef& ref, const glm::vec2& uv);

}  // namespace candela::realtime
