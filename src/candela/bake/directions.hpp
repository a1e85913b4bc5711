#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "candela/bake/equirect_light.hpp"
#include "candela/scene/cube_map.hpp"

namespace candela::bake {

/// Directions in the frame of a map, not necessarily unit, and what is seen there.
struct Directions {
    std::vector<float> x, y, z;
    std::vector<float> r, g, b;

    explicit Directions(std::size_t count) : x(count), y(count), z(count), r(count), g(count), b(count) {}
    [[nodiscard]] std::size_t size() const noexcept { return x.size(); }
    void set(std::size_t i, const glm::vec3& direction) {
        x[i] = direction.x;
        y[i] = direction.y;
        z[i] = direction.z;
    }
    [[nodiscard]] glm::vec3 color(std::size_t i) const { return {r[i], g[i], b[i]}; }
    void make_unit();
    /// Where the directions are in an equirectangular map of width x height, in texels: into r and g.
    void find_places(float width, float height);
};

/// Places within a texel along one side, and weights that add up to 1.
struct TexelNodes {
    std::vector<float> at;
    std::vector<float> weight;

    [[nodiscard]] static TexelNodes center() { return {{0.5f}, {1.0f}}; }
    /// Gauss's two in each of `cells` parts.
    [[nodiscard]] static TexelNodes gauss(std::uint32_t cells);
};

/// A cube in world directions, each texel the mean over its solid angle, of a function in the frame of a map
/// that is turned by rotation_rad. `evaluate` fills in colours, on several threads at a time.
[[nodiscard]] scene::CubeMap cube_of(std::uint32_t size, const TexelNodes& nodes, float rotation_rad,
                                     const std::function<void(Directions&)>& evaluate);

/// What a map shows in each direction, without its peaks.
void read_map(const EquirectLight& light, Directions& directions);

}  // namespace candela::bake
