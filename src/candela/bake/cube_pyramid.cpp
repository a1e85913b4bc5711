#include "candela/bake/cube_pyramid.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "candela/bake/directions.hpp"
#include "shading/cube.glsl"
#include "shading/environment_filter.glsl"

namespace candela::bake {
namespace {

double corner_sr(double x, double y) {
    return std::atan2(x * y, std::sqrt(x * x + y * y + 1.0));
}

}  // namespace

double cube_texel_sr(std::uint32_t x, std::uint32_t y, std::uint32_t size) {
    const double step = 2.0 / double(size);
    const double left = double(x) * step - 1.0;
    const double top = double(y) * step - 1.0;
    if (size < 16) {
        return corner_sr(left + step, top + step) - corner_sr(left, top + step) -
               corner_sr(left + step, top) + corner_sr(left, top);
    }
    // Gauss's two nodes each way.
    double sum = 0.0;
    for (const double v : {0.2113248654051871, 0.7886751345948129}) {
        for (const double u : {0.2113248654051871, 0.7886751345948129}) {
            const double a = left + u * step;
            const double b = top + v * step;
            const double length2 = 1.0 + a * a + b * b;
            sum += 1.0 / (length2 * std::sqrt(length2));
        }
    }
    return 0.25 * step * step * sum;
}

glm::dvec3 cube_energy(const scene::CubeMap& cube) {
    glm::dvec3 sum(0.0);
    for (std::uint32_t y = 0; y < cube.size; ++y) {
        for (std::uint32_t x = 0; x < cube.size; ++x) {
            glm::dvec3 faces(0.0);
            for (std::uint32_t face = 0; face < 6; ++face)
                faces += glm::dvec3(cube.texels[cube.index(face, x, y)]);
            sum += faces * cube_texel_sr(x, y, cube.size);
        }
    }
    return sum;
}

namespace {

/// What of a peak falls into each texel.
void add_peak(scene::CubeMap& cube, const LightPeak& peak, float rotation_rad) {
    const auto size = static_cast<float>(cube.size);
    for_hat(peak, [&](const glm::vec3& direction, float share) {
        const glm::vec3 at = shading::cube_uv_face(shading::rotate_about_y(direction, rotation_rad));
        const auto x = static_cast<std::uint32_t>(std::clamp(at.x * size, 0.0f, size - 1.0f));
        const auto y = static_cast<std::uint32_t>(std::clamp(at.y * size, 0.0f, size - 1.0f));
        const auto solid_angle = static_cast<float>(cube_texel_sr(x, y, cube.size));
        cube.texels[cube.index(static_cast<std::uint32_t>(at.z), x, y)] += peak.power * (share / solid_angle);
    });
}

}  // namespace

scene::CubeMap mean_cube(const EquirectLight& light, std::uint32_t size) {
    // Parts of a texel no wider than two texels of the map, each with two nodes.
    const float texels = 2.0f * static_cast<float>(light.height) / (static_cast<float>(size) * shading::PI);
    const auto cells = static_cast<std::uint32_t>(std::clamp(std::ceil(0.5f * texels), 1.0f, 16.0f));
    scene::CubeMap cube = cube_of(size, TexelNodes::gauss(cells), light.rotation_rad,
                                  [&](Directions& directions) { read_map(light, directions); });
    for (const LightPeak& peak : light.peaks) add_peak(cube, peak, light.rotation_rad);
    return cube;
}

CubePyramid::CubePyramid(const scene::CubeMap& finest) {
    Level base(finest.size);
    for (int face = 0; face < 6; ++face) {
        for (int y = 0; y < static_cast<int>(finest.size); ++y) {
            for (int x = 0; x < static_cast<int>(finest.size); ++x)
                base.texels[base.index(face, x, y)] = glm::vec4(
                    finest.texels[finest.index(static_cast<std::uint32_t>(face),
                                               static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y))],
                    0.0f);
        }
    }
    base.fill_margins();
    levels_.push_back(std::move(base));
    while (levels_.back().size > 1 && levels_.back().size % 2 == 0) levels_.push_back(halve(levels_.back()));
}

void CubePyramid::Level::fill_margins() {
    const int last = static_cast<int>(size) - 1;
    const auto across_edge = [&](int face, int x, int y) {
        const glm::vec2 uv = (glm::vec2(x, y) + 0.5f) / static_cast<float>(size);
        const glm::vec3 at = shading::cube_uv_face(shading::cube_point(face, uv));
        const int i = std::clamp(static_cast<int>(at.x * static_cast<float>(size)), 0, last);
        const int j = std::clamp(static_cast<int>(at.y * static_cast<float>(size)), 0, last);
        return texels[index(static_cast<int>(at.z), i, j)];
    };
    for (int face = 0; face < 6; ++face) {
        for (int i = 0; i <= last; ++i) {
            texels[index(face, i, -1)] = across_edge(face, i, -1);
            texels[index(face, i, last + 1)] = across_edge(face, i, last + 1);
            texels[index(face, -1, i)] = across_edge(face, -1, i);
            texels[index(face, last + 1, i)] = across_edge(face, last + 1, i);
        }
        // Three texels meet at a corner.
        for (const int y : {0, last}) {
            for (const int x : {0, last}) {
                const int out_x = x == 0 ? -1 : last + 1;
                const int out_y = y == 0 ? -1 : last + 1;
                if (last == 0) continue;
                texels[index(face, out_x, out_y)] =
                    (texels[index(face, x, y)] + texels[index(face, out_x, y)] +
                     texels[index(face, x, out_y)]) /
                    3.0f;
            }
        }
        if (last == 0) {
            for (const int y : {-1, 1}) {
                for (const int x : {-1, 1})
                    texels[index(face, x, y)] =
                        (texels[index(face, 0, 0)] + texels[index(face, x, 0)] + texels[index(face, 0, y)]) /
                        3.0f;
            }
        }
    }
}

CubePyramid::Level CubePyramid::halve(const Level& from) {
    Level to(from.size / 2);
    tbb::parallel_for(0u, 6 * to.size, [&](std::uint32_t row) {
        const int face = static_cast<int>(row / to.size);
        const std::uint32_t y = row % to.size;
        for (std::uint32_t x = 0; x < to.size; ++x) {
            glm::vec4 sum(0.0f);
            float weight = 0.0f;
            for (std::uint32_t part = 0; part < 4; ++part) {
                const std::uint32_t i = 2 * x + part % 2;
                const std::uint32_t j = 2 * y + part / 2;
                const auto w = static_cast<float>(cube_texel_sr(i, j, from.size));
                sum += w * from.texels[from.index(face, static_cast<int>(i), static_cast<int>(j))];
                weight += w;
            }
            to.texels[to.index(face, static_cast<int>(x), static_cast<int>(y))] = sum / weight;
        }
    });
    to.fill_margins();
    return to;
}

scene::CubeMap CubePyramid::level(std::uint32_t index) const {
    const Level& from = levels_[index];
    scene::CubeMap cube;
    cube.size = from.size;
    cube.texels.resize(std::size_t{6} * from.size * from.size);
    for (std::uint32_t face = 0; face < 6; ++face) {
        for (std::uint32_t y = 0; y < from.size; ++y) {
            const glm::vec4* texels =
                from.texels.data() + from.index(static_cast<int>(face), 0, static_cast<int>(y));
            std::copy_n(texels, from.size, cube.texels.data() + cube.index(face, 0, y));
        }
    }
    return cube;
}

glm::vec4 CubePyramid::read(const glm::vec3& direction, std::uint32_t level) const {
    const Level& from = levels_[level];
    const glm::vec3 at = shading::cube_uv_face(direction);
    const float x = at.x * static_cast<float>(from.size) + 0.5f;
    const float y = at.y * static_cast<float>(from.size) + 0.5f;
    const int limit = static_cast<int>(from.size);
    const int left = std::clamp(static_cast<int>(x), 0, limit);
    const int top = std::clamp(static_cast<int>(y), 0, limit);
    const float fx = x - static_cast<float>(left);
    const float fy = y - static_cast<float>(top);
    const glm::vec4* upper = from.texels.data() + from.index(static_cast<int>(at.z), left - 1, top - 1);
    const glm::vec4* lower = upper + from.size + 2;
    return glm::mix(glm::mix(upper[0], upper[1], fx), glm::mix(lower[0], lower[1], fx), fy);
}

glm::vec4 CubePyramid::read(const glm::vec3& direction, float level) const {
    const float clamped = std::clamp(level, 0.0f, static_cast<float>(levels_.size() - 1));
    const auto finer = static_cast<std::uint32_t>(clamped);
    const glm::vec4 a = read(direction, finer);
    const float fraction = clamped - static_cast<float>(finer);
    return fraction == 0.0f ? a : glm::mix(a, read(direction, finer + 1), fraction);
}

}  // namespace candela::bake
