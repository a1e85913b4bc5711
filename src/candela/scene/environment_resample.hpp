#pragma once

#include "candela/scene/cube_map.hpp"
#include "candela/scene/scene.hpp"

/// Pictures of all directions from one shape into another, with the light kept: the sum of luminance times
/// solid angle, of the whole and of every texel that is brighter than what surrounds it.
namespace candela::scene {

/// Which direction of a cube is ahead.
enum class CubeSpace : std::uint8_t {
    direct,   ///< a direction of the world is looked up as it is (shading/cube.glsl)
    picture,  ///< the faces are pictures seen from inside in the APIs' left-handed space, where +X is to the
              ///< right of +Z; +Z is ahead, which is -Z in the world
};

/// Width and height of the equirectangular picture that keeps what a cube of this size resolves.
struct PictureSize {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
};
[[nodiscard]] PictureSize equirect_size_of_cube(std::uint32_t face_size) noexcept;
[[nodiscard]] PictureSize equirect_size_of_octahedral(std::uint32_t size) noexcept;

/// Luminance_nit of the result is the cube's values. `size` may be anything that is not empty.
[[nodiscard]] Environment equirect_from_cube(const CubeMap& cube, CubeSpace space, PictureSize size);

/// A square picture by shading/octahedral.glsl of a direction's (x, -z, y): +Y in the middle, +X to the
/// right, -Z on top (as on a map of the ground, with north ahead), -Y in the corners. `texels`: size * size.
[[nodiscard]] Environment equirect_from_octahedral(const std::vector<glm::vec3>& texels,
                                                   std::uint32_t texels_a_side, PictureSize size);

/// Pictures of all directions in the circle of a square, +Y up and +X to the right; corners show nothing.
enum class CircleProjection : std::uint8_t {
    /// Light probes of Debevec's: ahead (-Z) in the middle, the distance from it is the angle, behind on the
    /// rim.
    angular,
    /// A mirroring sphere as a far camera shows it that looks ahead: what is behind the camera in the middle,
    /// the distance is the sine of half the angle, ahead on the rim.
    mirror_ball,
};
[[nodiscard]] PictureSize equirect_size_of_circle(CircleProjection projection, std::uint32_t size) noexcept;
[[nodiscard]] Environment equirect_from_circle(const std::vector<glm::vec3>& texels,
                                               std::uint32_t texels_a_side, CircleProjection projection,
                                               PictureSize size);

}  // namespace candela::scene
