#include "candela/bake/filter_harmonic.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "shading/cube.glsl"
#include "shading/environment.glsl"

namespace candela::bake {
namespace {

/// Where the work of harmonics, which grows with the square, passes that of points.
constexpr float kNarrowAlpha = 0.01f;

/// Points of a texel along one side, and their weights.
struct Nodes {
    std::vector<float> at;
    std::vector<float> weight;
};

/// Gauss's two nodes in each of `cells`.
Nodes gauss_nodes(std::uint32_t cells) {
    Nodes nodes;
    for (std::uint32_t i = 0; i < 2 * cells; ++i) {
        const float within = i % 2 == 0 ? 0.2113248654f : 0.7886751346f;
        nodes.at.push_back((static_cast<float>(i / 2) + within) / static_cast<float>(cells));
        nodes.weight.push_back(0.5f / static_cast<float>(cells));
    }
    return nodes;
}

Nodes texel_nodes(float alpha, std::uint32_t size, TexelValue texel) {
    if (texel == TexelValue::center) return {{0.5f}, {1.0f}};
    // A texel that spans the sphere sees the horizon of the lobe, too.
    if (size <= 8) return gauss_nodes(32 / size);
    const float texels_in_lobe = alpha * static_cast<float>(size);
    return gauss_nodes(static_cast<std::uint32_t>(std::ceil(std::max(1.8f / texels_in_lobe, 1.0f))));
}

}  // namespace

Harmonics analyze_for(const EquirectLight& light, float least_alpha) {
    const std::uint32_t degree = ld_degree(least_alpha);
    // A degree needs rows: where the map has too few, of the same bilinear function.
    const std::uint32_t factor = (degree * 5 / 4 + light.height - 1) / light.height;
    return factor > 1 ? analyze(refined(light, factor), degree) : analyze(light, degree);
}

bool is_narrow(float alpha) {
    return alpha < kNarrowAlpha;
}

scene::CubeMap sample_cube(const LobeField& field, float rotation_rad, float alpha, std::uint32_t size,
                           TexelValue texel) {
    scene::CubeMap cube;
    cube.size = size;
    cube.texels.resize(std::size_t{6} * size * size);
    const Nodes nodes = texel_nodes(alpha, size, texel);
    const std::size_t side = nodes.at.size();
    const float scale = 1.0f / static_cast<float>(size);
    const float c = std::cos(rotation_rad);
    const float s = std::sin(rotation_rad);
    tbb::parallel_for(0u, 6 * size, [&](std::uint32_t row) {
        const std::uint32_t face = row / size;
        const std::uint32_t y = row % size;
        Directions directions;
        std::vector<float> weights;
        for (std::uint32_t x = 0; x < size; ++x) {
            for (std::size_t j = 0; j < side; ++j) {
                for (std::size_t i = 0; i < side; ++i) {
                    const glm::vec3 p = shading::cube_point(static_cast<int>(face),
                                                            {(static_cast<float>(x) + nodes.at[i]) * scale,
                                                             (static_cast<float>(y) + nodes.at[j]) * scale});
                    const float length2 = glm::dot(p, p);
                    directions.add({c * p.x - s * p.z, p.y, c * p.z + s * p.x});
                    weights.push_back(nodes.weight[i] * nodes.weight[j] / (length2 * std::sqrt(length2)));
                }
            }
        }
        field.evaluate(directions);
        for (std::uint32_t x = 0; x < size; ++x) {
            glm::vec3 sum(0.0f);
            float total = 0.0f;
            for (std::size_t k = x * side * side; k < (x + 1) * side * side; ++k) {
                sum += weights[k] * glm::vec3(directions.r[k], directions.g[k], directions.b[k]);
                total += weights[k];
            }
            cube.texels[cube.index(face, x, y)] = sum / total;
        }
    });
    return cube;
}

}  // namespace candela::bake
