#pragma once

#include <tbb/parallel_for.h>

#include <cstdint>
#include <glm/geometric.hpp>

#include "candela/scene/cube_map.hpp"
#include "shading/cube.glsl"

namespace candela::bake {

/// A cube whose texels are value(direction of their centre), computed in parallel.
template <class Value>
[[nodiscard]] scene::CubeMap cube_of_directions(std::uint32_t size, const Value& value) {
    scene::CubeMap cube;
    cube.size = size;
    cube.texels.resize(std::size_t{6} * size * size);
    tbb::parallel_for(0u, 6 * size, [&](std::uint32_t row) {
        for (std::uint32_t x = 0; x < size; ++x) {
            const std::uint32_t face = row / size;
            const glm::vec2 uv = (glm::vec2(x, row % size) + 0.5f) / static_cast<float>(size);
            cube.texels[cube.index(face, x, row % size)] =
                value(glm::normalize(shading::cube_point(static_cast<int>(face), uv)));
        }
    });
    return cube;
}

}  // namespace candela::bake
