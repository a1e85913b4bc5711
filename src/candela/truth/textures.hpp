#pragma once

#include <array>
#include <glm/vec4.hpp>
#include <vector>

#include "candela/scene/scene.hpp"

namespace candela::truth {

/// Whether a texture's RGB is stored with the sRGB transfer function; alpha never is.
enum class Transfer : std::uint8_t { linear, srgb };

/// Reads a scene's textures as the device does at their largest level: decode, then filter. There are no mip
/// levels: the average over a pixel is what its samples are for.
class Textures {
  public:
    /// The scene must outlive this.
    explicit Textures(const scene::Scene& scene);

    /// uv before the texture transform of `ref`; white where the texture has no picture.
    [[nodiscard]] glm::vec4 read(const scene::TextureRef& ref, const glm::vec2& uv, Transfer transfer) const;
    /// The same of a picture by itself, clamped to its edge. image: index into Scene::images.
    [[nodiscard]] glm::vec3 read_srgb_image(std::uint32_t image, const glm::vec2& uv) const;
    /// Linear mean of a picture; white where there is none.
    [[nodiscard]] glm::vec3 mean_of_srgb_image(std::uint32_t image) const;

  private:
    [[nodiscard]] glm::vec4 filtered(const scene::Image& image, const scene::Sampler& sampler,
                                     const glm::vec2& uv, Transfer transfer) const;
    [[nodiscard]] glm::vec4 texel(const scene::Image& image, int x, int y, Transfer transfer) const;

    const scene::Scene* scene_;
    std::array<float, 256> linear_from_srgb_{};
};

/// KHR_texture_transform: translation * rotation * scale.
[[nodiscard]] glm::vec2 transformed_uv(const scene::TextureRef& ref, const glm::vec2& uv);

}  // namespace candela::truth
