#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "candela/bake/cube_texels.hpp"
#include "candela/bake/filter_harmonic.hpp"
#include "shading/basis.glsl"
#include "shading/cube.glsl"
#include "shading/environment_filter.glsl"

namespace candela::bake {
namespace {

constexpr std::uint32_t kRings = 8;
constexpr std::uint32_t kSpokes = 6;

struct Point {
    glm::vec3 local;
    float weight;
    float level;
};

/// Rings that part the lobe into equal shares of half-vectors, each reading texels as large as its points are
/// apart: means over the texels of the level itself or coarser.
std::vector<Point> lobe_points(float alpha, std::uint32_t source_size, std::uint32_t own_level) {
    std::vector<Point> points;
    float total = 0.0f;
    const float texel_sr = 4.0f * shading::PI / (6.0f * float(source_size) * float(source_size));
    for (std::uint32_t ring = 0; ring < kRings; ++ring) {
        const float end = 1.0f / (1.0f + alpha * alpha);  // the horizon
        const auto s_at = [&](float share) { return shading::ggx_half_sine2(share * end, alpha); };
        const float inner = s_at(float(ring) / kRings);
        const float outer = s_at(float(ring + 1) / kRings);
        const float s = s_at((float(ring) + 0.5f) / kRings);
        const float level = 0.5f * std::log2(4.0f * shading::PI * (outer - inner) / (kSpokes * texel_sr));
        const float cosine = 1.0f - 2.0f * s;
        const float sine = 2.0f * std::sqrt(s * (1.0f - s));
        for (std::uint32_t spoke = 0; spoke < kSpokes; ++spoke) {
            const float phi = shading::TWO_PI * (float(spoke) + 0.5f * float(ring % 2)) / kSpokes;
            points.push_back({{sine * std::cos(phi), sine * std::sin(phi), cosine},
                              cosine,
                              std::max(level, float(own_level))});
            total += cosine;
        }
    }
    for (Point& point : points) point.weight /= total;
    return points;
}

/// Mean of the lobe about a peak over a texel: in parts as small as the lobe where it is near.
float mean_weight(const std::vector<glm::vec3>& hat, const std::vector<float>& shares, int face,
                  const glm::vec2& corner, float step, float alpha) {
    const glm::vec3 center = glm::normalize(shading::cube_point(face, corner + 0.5f * step));
    const float away = 2.0f * std::sqrt(shading::half_sine2(center, hat[hat.size() / 2]));
    const float texel = 2.0f * step;  // its angle in the middle of a face
    if (away > 20.0f * texel)
        return shading::ld_weight(shading::half_sine2(center, hat[hat.size() / 2]), alpha);
    const float wanted = std::ceil(2.0f * texel / std::max(alpha, 0.25f * away));
    const int parts = static_cast<int>(std::clamp(wanted, 2.0f, 24.0f));
    const bool near = away < 4.0f * texel;
    float sum = 0.0f;
    for (int k = 0; k < parts * parts; ++k) {
        const glm::vec2 at((static_cast<float>(k % parts) + 0.5f) / static_cast<float>(parts),
                           (static_cast<float>(k / parts) + 0.5f) / static_cast<float>(parts));
        const glm::vec3 d = glm::normalize(shading::cube_point(face, corner + at * step));
        if (!near) {
            sum += shading::ld_weight(shading::half_sine2(d, hat[hat.size() / 2]), alpha);
            continue;
        }
        for (std::size_t i = 0; i < hat.size(); ++i)
            sum += shares[i] * shading::ld_weight(shading::half_sine2(d, hat[i]), alpha);
    }
    return sum / static_cast<float>(parts * parts);
}

/// Adds a peak, so that the level has its energy exactly.
void add_peak(scene::CubeMap& cube, const LightPeak& peak, float rotation_rad, float alpha) {
    constexpr int side = 7;
    std::vector<glm::vec3> hat;
    std::vector<float> shares;
    for (int k = 0; k < side * side; ++k) {
        const float across = 2.0f * (static_cast<float>(k % side) + 0.5f) / side - 1.0f;
        const float down = 2.0f * (static_cast<float>(k / side) + 0.5f) / side - 1.0f;
        hat.push_back(shading::rotate_about_y(peak.direction(across, down), rotation_rad));
        shares.push_back((1.0f - std::abs(across)) * (1.0f - std::abs(down)));
    }
    float total = 0.0f;
    for (const float share : shares) total += share;
    for (float& share : shares) share /= total;
    std::vector<float> weights(cube.texels.size());
    const float step = 1.0f / static_cast<float>(cube.size);
    tbb::parallel_for(0u, 6 * cube.size, [&](std::uint32_t row) {
        const std::uint32_t face = row / cube.size;
        const std::uint32_t y = row % cube.size;
        for (std::uint32_t x = 0; x < cube.size; ++x)
            weights[cube.index(face, x, y)] =
                mean_weight(hat, shares, static_cast<int>(face), glm::vec2(x, y) * step, step, alpha);
    });
    double energy = 0.0;
    for (std::uint32_t y = 0; y < cube.size; ++y) {
        for (std::uint32_t x = 0; x < cube.size; ++x) {
            for (std::uint32_t face = 0; face < 6; ++face)
                energy += double(weights[cube.index(face, x, y)]) * cube_texel_sr(x, y, cube.size);
        }
    }
    const auto scale = static_cast<float>(1.0 / energy);
    for (std::size_t i = 0; i < weights.size(); ++i) cube.texels[i] += peak.power * (weights[i] * scale);
}

}  // namespace

scene::CubeMap narrow_cube(const EquirectLight& light, const CubePyramid& smooth, float alpha,
                           std::uint32_t size) {
    std::uint32_t own_level = 0;
    while ((smooth.size() >> own_level) > size) ++own_level;
    const std::vector<Point> points = lobe_points(alpha, smooth.size(), own_level);
    scene::CubeMap cube = cube_of_directions(size, [&](const glm::vec3& n) {
        glm::vec3 t;
        glm::vec3 b;
        shading::orthonormal_basis(n, t, b);
        glm::vec4 sum(0.0f);
        for (const Point& point : points)
            sum += point.weight * smooth.read(shading::to_world(point.local, t, b, n), point.level);
        return glm::vec3(sum);
    });
    for (const LightPeak& peak : light.peaks) add_peak(cube, peak, light.rotation_rad, alpha);
    return cube;
}

}  // namespace candela::bake
