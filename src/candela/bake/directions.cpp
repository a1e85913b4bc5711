#include "candela/bake/directions.hpp"

#include <tbb/parallel_for.h>

#include <cmath>

#include "candela/bake/wide.hpp"
#include "shading/cube.glsl"
#include "shading/environment_filter.glsl"

namespace candela::bake {
namespace {

CANDELA_WIDE void places(std::size_t count, const float* x, const float* y, const float* z, float width,
                         float height, float* across, float* down) {
    for (std::size_t i = 0; i < count; ++i) {
        const shading::vec2 uv = shading::equirect_uv_close({x[i], y[i], z[i]});
        across[i] = uv.x * width;
        down[i] = uv.y * height;
    }
}

CANDELA_WIDE void to_unit(std::size_t count, float* x, float* y, float* z) {
    for (std::size_t i = 0; i < count; ++i) {
        const float scale = 1.0f / std::sqrt(x[i] * x[i] + y[i] * y[i] + z[i] * z[i]);
        x[i] *= scale;
        y[i] *= scale;
        z[i] *= scale;
    }
}

}  // namespace

void Directions::make_unit() {
    to_unit(size(), x.data(), y.data(), z.data());
}

void Directions::find_places(float width, float height) {
    places(size(), x.data(), y.data(), z.data(), width, height, r.data(), g.data());
}

TexelNodes TexelNodes::gauss(std::uint32_t cells) {
    TexelNodes nodes;
    for (std::uint32_t i = 0; i < 2 * cells; ++i) {
        const float within = i % 2 == 0 ? 0.2113248654f : 0.7886751346f;
        nodes.at.push_back((static_cast<float>(i / 2) + within) / static_cast<float>(cells));
        nodes.weight.push_back(0.5f / static_cast<float>(cells));
    }
    return nodes;
}

scene::CubeMap cube_of(std::uint32_t size, const TexelNodes& nodes, float rotation_rad,
                       const std::function<void(Directions&)>& evaluate) {
    scene::CubeMap cube;
    cube.size = size;
    cube.texels.resize(std::size_t{6} * size * size);
    const std::size_t side = nodes.at.size();
    const std::size_t count = side * side;
    const float scale = 1.0f / static_cast<float>(size);
    const float c = std::cos(rotation_rad);
    const float s = std::sin(rotation_rad);
    tbb::parallel_for(0u, 6 * size, [&](std::uint32_t row) {
        const auto face = static_cast<int>(row / size);
        const auto y = static_cast<float>(row % size);
        Directions directions(size * count);
        std::vector<float> weights(directions.size());
        for (std::size_t k = 0; k < directions.size(); ++k) {
            const std::size_t i = k % side;
            const std::size_t j = k / side % side;
            const glm::vec3 p = shading::cube_point(
                face, {(static_cast<float>(k / count) + nodes.at[i]) * scale, (y + nodes.at[j]) * scale});
            const float length2 = glm::dot(p, p);
            directions.set(k, {c * p.x - s * p.z, p.y, c * p.z + s * p.x});
            weights[k] = nodes.weight[i] * nodes.weight[j] / (length2 * std::sqrt(length2));
        }
        evaluate(directions);
        for (std::size_t x = 0; x < size; ++x) {
            glm::vec3 sum(0.0f);
            float total = 0.0f;
            for (std::size_t k = x * count; k < (x + 1) * count; ++k) {
                sum += weights[k] * directions.color(k);
                total += weights[k];
            }
            cube.texels[std::size_t{row} * size + x] = sum / total;
        }
    });
    return cube;
}

void read_map(const EquirectLight& light, Directions& d) {
    d.find_places(static_cast<float>(light.width), static_cast<float>(light.height));
    for (std::size_t i = 0; i < d.size(); ++i) {
        const glm::vec4 value = light.read_texels(d.r[i], d.g[i]);
        d.r[i] = value.x;
        d.g[i] = value.y;
        d.b[i] = value.z;
    }
}

}  // namespace candela::bake
