#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
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

/// A distant light as others take it: filtered for glossy and matt surfaces. A value times nit_per_unit is
/// cd/m^2.
struct FilteredEnvironment {
    std::vector<CubeMap> specular;  ///< the LD term, finest level first; level 0 is the mirror's
    RoughnessMapping mapping = RoughnessMapping::linear;
    CubeMap irradiance;  ///< divided by pi: what a white Lambert surface shows
    /// Of irradiance / pi, real spherical harmonics of bands 0 to 2 in the order l (l + 1) + m, without the
    /// Condon-Shortley phase: the value in a direction is the plain sum of coefficient times basis.
    std::array<glm::vec3, 9> irradiance_sh{};
    /// Lambda of shading/spherical_harmonics.glsl's sh_window that was applied to them, so that no direction
    /// is negative; 0: none was.
    float irradiance_sh_window = 0.0f;
    float nit_per_unit = 1.0f;
};

}  // namespace candela::scene
