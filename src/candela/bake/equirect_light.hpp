#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "candela/scene/scene.hpp"

namespace candela::bake {

/// What a texel has over its surroundings, as a source of its own: the hat that bilinear reading makes of it.
struct LightPeak {
    glm::vec3 power{0.0f};  ///< radiance times solid angle
    float azimuth_rad = 0.0f;
    float polar_rad = 0.0f;
    float azimuth_step_rad = 0.0f;  ///< of the map
    float polar_step_rad = 0.0f;

    /// Unit; `across` and `down` in texels from the centre.
    [[nodiscard]] glm::vec3 direction(float across = 0.0f, float down = 0.0f) const;
};

/// Calls visit(direction, share) for 16 x 16 points of a peak's hat; the shares add up to 1.
void for_hat(const LightPeak& peak, const std::function<void(const glm::vec3&, float)>& visit);

/// An equirectangular map ready to be filtered, in its own frame, read bilinearly as everything here reads
/// it.
struct EquirectLight {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<glm::vec4> texels;  ///< rgb; nowhere above `cap` in luminance
    std::vector<LightPeak> peaks;   ///< what the cap took away
    glm::vec4 lowest{0.0f};         ///< of the texels, by channel
    glm::vec4 highest{0.0f};
    float rotation_rad = 0.0f;  ///< of scene::Environment

    /// Of the bilinear reading, without the peaks; u wraps around, v ends at the poles.
    [[nodiscard]] glm::vec4 read(float u, float v) const;
    /// The same with x from 0 to width and y from 0 to height.
    [[nodiscard]] glm::vec4 read_texels(float x, float y) const;
    /// Sum over texels and peaks of radiance times solid angle.
    [[nodiscard]] glm::dvec3 energy() const;
};

/// A map of at most `largest_width`, halved with its energy kept where it is larger, times `scale`. The
/// brightest texels, where they stand out, become peaks.
[[nodiscard]] EquirectLight equirect_light(const scene::Environment& environment, float scale,
                                           std::uint32_t largest_width);

/// The same function of direction on a grid of `factor` times as many rows and columns.
[[nodiscard]] EquirectLight refined(const EquirectLight& light, std::uint32_t factor);

}  // namespace candela::bake
