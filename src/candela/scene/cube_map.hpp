#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace candela::scene {

/// A picture of all directions on six faces, +X -X +Y -Y +Z -Z, row 0 on top, as shading/cube.glsl maps
/// directions to them.
struct CubeMap {
    std::uint32_t size = 0;         ///< texels a side
    std::vector<glm::vec3> texels;  ///< 6 * size * size, linear Rec.709

    [[nodiscard]] std::size_t index(std::uint32_t face, std::uint32_t x, std::uint32_t y) const noexcept {
        return (std::size_t{face} * size + y) * size + x;
    }
};

/// How the levels of a specular map stand for roughness.
enum class RoughnessMapping : std::uint8_t {
    linear,     ///< level / (levels - 1) is the perceptual roughness
    frostbite,  ///< level / (levels - 1) is its square root: Frostbite 4.9.2, equation 63
    filament,   ///< level / (levels - 1) is r (2 - r): Filament's shaders, whose bakes this is for
};

/// Perceptual roughness that level `level` of `levels` stands for.
[[nodiscard]] inline float perceptual_roughness_of_level(RoughnessMapping mapping, std::uint32_t level,
                                                         std::uint32_t levels) noexcept {
    const float t = levels > 1 ? static_cast<float>(level) / static_cast<float>(levels - 1) : 0.0f;
    switch (mapping) {
        case RoughnessMapping::frostbite:
            return t * t;
        case RoughnessMapping::filament:
            return 1.0f - std::sqrt(1.0f - t);
        default:
            return t;
    }
}

/// What keeps nine harmonics of irradiance from being negative (bake::window_negative), by channel.
struct HarmonicsWindow {
    std::array<glm::vec2, 3> bands{glm::vec2(1.0f), glm::vec2(1.0f), glm::vec2(1.0f)};  ///< 1 and 2; 1: as is
    glm::vec3 least_over_mean{0.0f};  ///< before, over all directions; 0 for a black channel
    /// Root of the mean square of (harmonics - irradiance) over that of irradiance, all channels.
    double error_without = 0.0;
    double error = 0.0;
    [[nodiscard]] bool any() const noexcept {
        for (const glm::vec2& b : bands) {
            if (b != glm::vec2(1.0f)) return true;
        }
        return false;
    }
};

/// A distant light as others take it: filtered for glossy and matt surfaces. A value times nit_per_unit is
/// cd/m^2.
struct FilteredEnvironment {
    std::vector<CubeMap> specular;  ///< the LD term, finest level first; level 0 is the mirror's
    RoughnessMapping mapping = RoughnessMapping::linear;
    CubeMap irradiance;  ///< divided by pi: what a white Lambert surface shows
    /// Of irradiance / pi, real spherical harmonics of bands 0 to 2 in the order l (l + 1) + m, without the
    /// Condon-Shortley phase: the value in a direction is the plain sum of coefficient times basis.
    std::array<glm::vec3, 9> irradiance_sh{};
    HarmonicsWindow irradiance_sh_window;  ///< was applied to them
    /// Of the radiance, in the same basis and order, never windowed: irradiance over pi is these times
    /// shading::sh_cosine_over_pi.
    std::array<glm::vec3, 9> radiance_sh{};
    float nit_per_unit = 1.0f;
};

}  // namespace candela::scene
