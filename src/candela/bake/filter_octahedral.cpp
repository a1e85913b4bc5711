#include "candela/bake/filter_octahedral.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "candela/bake/filter_harmonic.hpp"
#include "shading/microfacet.glsl"
#include "shading/octahedral.glsl"
#include "shading/specular_levels.glsl"

namespace candela::bake {
namespace {

/// The point of the octahedron |x| + |y| + |z| = 1 at e in [-1,1]^2. An area of e covers that area over its
/// length cubed in solid angle.
glm::vec3 octahedron_point(const glm::vec2& e) {
    const glm::vec3 d = shading::octahedral_decode(e);
    return d / (std::abs(d.x) + std::abs(d.y) + std::abs(d.z));
}

/// The mean of a function over the solid angle of each texel.
OctahedralMap octahedral_of(std::uint32_t size, const TexelNodes& nodes,
                            const std::function<void(Directions&)>& evaluate) {
    OctahedralMap map;
    map.size = size;
    map.texels.resize(std::size_t{size} * size, glm::vec4(0.0f));
    const std::size_t side = nodes.at.size();
    const std::size_t count = side * side;
    const std::uint32_t interior = map.interior();
    const float scale = 2.0f / static_cast<float>(interior);
    tbb::parallel_for(0u, interior, [&](std::uint32_t y) {
        Directions directions(interior * count);
        std::vector<float> weights(directions.size());
        for (std::size_t k = 0; k < directions.size(); ++k) {
            const std::size_t i = k % side;
            const std::size_t j = k / side % side;
            const glm::vec3 p =
                octahedron_point({(static_cast<float>(k / count) + nodes.at[i]) * scale - 1.0f,
                                  (static_cast<float>(y) + nodes.at[j]) * scale - 1.0f});
            const float length2 = glm::dot(p, p);
            directions.set(k, p);
            weights[k] = nodes.weight[i] * nodes.weight[j] / (length2 * std::sqrt(length2));
        }
        evaluate(directions);
        for (std::size_t x = 0; x < interior; ++x) {
            glm::vec3 sum(0.0f);
            float total = 0.0f;
            for (std::size_t k = x * count; k < (x + 1) * count; ++k) {
                sum += weights[k] * directions.color(k);
                total += weights[k];
            }
            map.texels[(y + std::size_t{1}) * size + x + 1] = glm::vec4(sum / total, 1.0f);
        }
    });
    return map;
}

void add_peak(OctahedralMap& map, const LightPeak& peak) {
    const auto interior = static_cast<float>(map.interior());
    for_hat(peak, [&](const glm::vec3& direction, float share) {
        const glm::vec2 at = (shading::octahedral_encode(direction) * 0.5f + 0.5f) * interior;
        const auto x = static_cast<std::size_t>(std::clamp(at.x, 0.0f, interior - 1.0f));
        const auto y = static_cast<std::size_t>(std::clamp(at.y, 0.0f, interior - 1.0f));
        const glm::vec3 p = octahedron_point(
            (glm::vec2(static_cast<float>(x), static_cast<float>(y)) + 0.5f) * (2.0f / interior) - 1.0f);
        const float solid_angle = 4.0f / (interior * interior * std::pow(glm::dot(p, p), 1.5f));
        map.texels[(y + 1) * map.size + x + 1] += glm::vec4(peak.power * (share / solid_angle), 0.0f);
    });
}

OctahedralMap mirror(const EquirectLight& light, std::uint32_t size) {
    OctahedralMap map = octahedral_of(size, TexelNodes::gauss(1),
                                      [&](Directions& directions) { read_map(light, directions); });
    for (const LightPeak& peak : light.peaks) add_peak(map, peak);
    fill_gutters(map);
    return map;
}

OctahedralMap blurred(const EquirectLight& light, const Harmonics& harmonics, float alpha,
                      std::uint32_t size) {
    const LobeField field(light, harmonics, alpha);
    OctahedralMap map = octahedral_of(size, TexelNodes::center(),
                                      [&](Directions& directions) { field.evaluate(directions); });
    fill_gutters(map);
    return map;
}

}  // namespace

OctahedralLight filter_octahedral(const scene::Environment& environment, float scale,
                                  std::uint32_t irradiance_size) {
    // Two texels of the octahedron to one of the map along the equator.
    const EquirectLight light = equirect_light(environment, scale, 4 * shading::kSpecularSize);
    const auto alpha = [&](int level) {
        return shading::alpha_from_perceptual_roughness(shading::specular_level_roughness(level));
    };
    const Harmonics harmonics = analyze_for(light, alpha(1));
    OctahedralLight out;
    out.specular.push_back(mirror(light, shading::kSpecularSize));
    for (int level = 1; level < shading::kSpecularLevels; ++level)
        out.specular.push_back(blurred(light, harmonics, alpha(level),
                                       static_cast<std::uint32_t>(shading::specular_level_size(level))));
    out.irradiance = blurred(light, harmonics, 1.0f, irradiance_size);
    return out;
}

}  // namespace candela::bake
