#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
#include <vector>

#include "candela/bake/equirect_light.hpp"
#include "candela/scene/cube_map.hpp"

namespace candela::bake {

/// Solid angle in sr of a texel of a cube, to six digits: shading::cube_texel_solid_angle is a difference of
/// single-precision numbers of order 1.
[[nodiscard]] double cube_texel_sr(std::uint32_t x, std::uint32_t y, std::uint32_t size);

/// Sum over the texels of radiance times solid angle.
[[nodiscard]] glm::dvec3 cube_energy(const scene::CubeMap& cube);

/// A map as a cube in world directions, each texel the mean of what is in it.
[[nodiscard]] scene::CubeMap mean_cube(const EquirectLight& light, std::uint32_t size);

/// A cube and all its halvings; every level has the same energy.
class CubePyramid {
  public:
    explicit CubePyramid(const scene::CubeMap& finest);

    [[nodiscard]] std::uint32_t size() const noexcept { return levels_.front().size; }
    [[nodiscard]] std::uint32_t levels() const noexcept { return static_cast<std::uint32_t>(levels_.size()); }
    [[nodiscard]] scene::CubeMap level(std::uint32_t index) const;
    /// Bilinear, across edges too.
    [[nodiscard]] glm::vec4 read(const glm::vec3& direction, std::uint32_t level) const;
    /// Between two levels as well.
    [[nodiscard]] glm::vec4 read(const glm::vec3& direction, float level) const;

  private:
    struct Level {
        std::uint32_t size = 0;
        std::vector<glm::vec4> texels;  // six faces with a margin of one texel

        explicit Level(std::uint32_t side) : size(side), texels(std::size_t{6} * (side + 2) * (side + 2)) {}
        [[nodiscard]] std::size_t index(int face, int x, int y) const noexcept {
            const auto pitch = static_cast<std::ptrdiff_t>(size) + 2;
            return static_cast<std::size_t>((face * pitch + y + 1) * pitch + x + 1);
        }
        void fill_margins();
    };
    static Level halve(const Level& from);

    std::vector<Level> levels_;
};

}  // namespace candela::bake
