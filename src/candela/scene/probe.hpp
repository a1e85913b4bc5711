#pragma once

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

/// Light of a place instead of the whole world: what surfaces near a probe reflect, and what lights them from
/// other surfaces (Frostbite 4.9). Placed by people, filled by a capture or a bake.
namespace candela::scene {

/// What stands for the surroundings of a reflection probe. The numbers are those of
/// shading/probes/parallax.glsl.
enum class ProbeShape : std::uint8_t { sphere, box };

/// The picture of a probe, filtered, in the world's axes: octahedral maps with gutters of one texel. Level i
/// stands for perceptual roughness (i / (levels - 1))^2 (Frostbite 4.9.2, equation 63). rgb: luminance times
/// visibility in cd/m^2; a: the part of the lobe that meets surroundings and not the sky.
struct ProbeCapture {
    std::uint32_t size = 0;  ///< texels a side of level 0; each level is half of the one before
    std::vector<std::vector<glm::vec4>> levels;
    /// The same, cosine-weighted about the normal over pi, as spherical harmonics
    /// (shading/spherical_harmonics.glsl).
    std::array<glm::vec4, 9> irradiance_sh{};
    [[nodiscard]] bool empty() const noexcept { return levels.empty(); }
};

struct ReflectionProbe {
    std::string name;
    ProbeShape shape = ProbeShape::box;
    glm::mat4 world{1.0f};             ///< of the proxy's middle and axes, without scale
    glm::vec3 half_size_m{1.0f};       ///< of a sphere: its radius, three times
    glm::vec3 capture_offset_m{0.0f};  ///< from the middle, in the proxy's own frame
    float margin_m = 0.0f;             ///< how far beyond the proxy the influence reaches
    float fade_m = 0.0f;               ///< over which the influence ends, inwards from there
    ProbeCapture capture;              ///< empty until captured

    /// By which probes are in order: smaller ones first (Frostbite 4.9.5).
    [[nodiscard]] float volume_m3() const noexcept {
        const float box = 8.0f * half_size_m.x * half_size_m.y * half_size_m.z;
        return shape == ProbeShape::box ? box : box * 0.523598776f;
    }
    [[nodiscard]] glm::vec3 capture_position() const noexcept {
        return glm::vec3(world * glm::vec4(capture_offset_m, 1.0f));
    }
};

/// One probe of a grid.
struct IrradianceProbe {
    /// Irradiance / pi in cd/m^2 in the world's axes, without light that comes straight from a light.
    std::array<glm::vec3, 9> irradiance_sh{};
    /// Farness of what it sees: mean (x, m) and mean square (y, m^2) a texel of an octahedral picture, row by
    /// row.
    std::vector<glm::vec2> distances;
    bool valid = false;  ///< not inside of something
};

/// A box of light: probes at the middles of its cells.
struct IrradianceVolume {
    std::string name;
    glm::mat4 world{1.0f};  ///< of the box's middle and axes, without scale
    glm::vec3 half_size_m{1.0f};
    glm::ivec3 cells{4};
    float fade_m = 0.0f;  ///< outside of the box, over which its light gives way to the distant one
    std::vector<IrradianceProbe> probes;  ///< x fastest, then y; empty until baked

    [[nodiscard]] glm::vec3 spacing_m() const noexcept { return 2.0f * half_size_m / glm::vec3(cells); }
    /// World position of the probe in a cell.
    [[nodiscard]] glm::vec3 position(const glm::ivec3& cell) const noexcept {
        const glm::vec3 local = (glm::vec3(cell) + 0.5f) * spacing_m() - half_size_m;
        return glm::vec3(world * glm::vec4(local, 1.0f));
    }
    [[nodiscard]] std::size_t probe_count() const noexcept {
        return std::size_t(cells.x) * std::size_t(cells.y) * std::size_t(cells.z);
    }
};

}  // namespace candela::scene
