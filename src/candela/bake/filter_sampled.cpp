#include "candela/bake/filter_sampled.hpp"

#include <algorithm>
#include <cmath>

#include "candela/bake/cube_texels.hpp"
#include "shading/basis.glsl"
#include "shading/cube.glsl"
#include "shading/environment_filter.glsl"
#include "shading/sampling.glsl"
#include "shading/sequence.glsl"

namespace candela::bake {
namespace {

/// A sample in the frame of the texel's direction.
struct Sample {
    glm::vec3 local;
    float weight;
    float level;
};

std::vector<Sample> ggx_samples(const CubePyramid& source, float alpha, std::uint32_t count, bool filtered) {
    const float texel_sr =
        4.0f * shading::PI / (6.0f * static_cast<float>(source.size()) * static_cast<float>(source.size()));
    std::vector<Sample> samples;
    float total = 0.0f;
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::vec3 h = shading::sample_ggx_ndf(shading::hammersley(i, count), alpha);
        const float NoL = 2.0f * h.z * h.z - 1.0f;
        if (NoL <= 0.0f) continue;
        const float pdf = shading::pdf_reflected(shading::pdf_ggx_ndf(h, alpha), h.z);
        // Frostbite 4.9.2, listing 19.
        const float level = 0.5f * std::log2(1.0f / (static_cast<float>(count) * pdf * texel_sr));
        samples.push_back(
            {{2.0f * h.z * h.x, 2.0f * h.z * h.y, NoL}, NoL, filtered ? std::max(level, 0.0f) : 0.0f});
        total += NoL;
    }
    for (Sample& sample : samples) sample.weight /= total;
    return samples;
}

}  // namespace

scene::CubeMap ggx_samples_cube(const CubePyramid& source, float alpha, std::uint32_t size,
                                std::uint32_t sample_count, bool filtered) {
    const std::vector<Sample> samples = ggx_samples(source, alpha, sample_count, filtered);
    return cube_of_directions(size, [&](const glm::vec3& n) {
        glm::vec3 t;
        glm::vec3 b;
        shading::orthonormal_basis(n, t, b);
        glm::vec4 sum(0.0f);
        for (const Sample& sample : samples)
            sum += sample.weight * source.read(shading::to_world(sample.local, t, b, n), sample.level);
        return glm::vec3(sum);
    });
}

namespace {

struct Beam {
    glm::vec3 direction;
    glm::vec3 light;
    float solid_angle;
};

/// Neighbouring texels within a cone, passed over as one where it is out of reach.
struct Bundle {
    glm::vec3 axis;
    float half_angle;
    std::vector<Beam> beams;
};

std::vector<Bundle> bundles_of(const scene::CubeMap& cube) {
    const std::uint32_t side = std::min(cube.size, 16u);
    const std::uint32_t across = cube.size / side;
    std::vector<Bundle> bundles;
    for (std::uint32_t bundle = 0; bundle < 6 * across * across; ++bundle) {
        const std::uint32_t face = bundle / (across * across);
        const glm::uvec2 corner = glm::uvec2(bundle % across, bundle / across % across) * side;
        const auto direction = [&](const glm::vec2& texel) {
            return glm::normalize(
                shading::cube_point(static_cast<int>(face), texel / static_cast<float>(cube.size)));
        };
        Bundle out{direction(glm::vec2(corner) + 0.5f * static_cast<float>(side)), 0.0f, {}};
        for (std::uint32_t k = 0; k < side * side; ++k) {
            const glm::uvec2 texel = corner + glm::uvec2(k % side, k / side);
            const auto sr = static_cast<float>(cube_texel_sr(texel.x, texel.y, cube.size));
            const glm::vec3 d = direction(glm::vec2(texel) + 0.5f);
            out.beams.push_back({d, cube.texels[cube.index(face, texel.x, texel.y)] * sr, sr});
            out.half_angle = std::max(out.half_angle, std::acos(std::min(glm::dot(d, out.axis), 1.0f)));
        }
        bundles.push_back(std::move(out));
    }
    return bundles;
}

}  // namespace

scene::CubeMap cosine_power_cube(const CubePyramid& source, float alpha, std::uint32_t size) {
    const std::vector<Bundle> bundles = bundles_of(source.level(0));
    const float power = shading::cosine_power_from_alpha(alpha);
    const float least_cosine = std::pow(1.0e-6f, 1.0f / power);
    std::vector<float> least_axis_cosines;
    for (const Bundle& bundle : bundles)
        least_axis_cosines.push_back(
            std::cos(std::min(std::acos(least_cosine) + bundle.half_angle, shading::PI)) - 1.0e-4f);
    return cube_of_directions(size, [&](const glm::vec3& n) {
        glm::vec3 sum(0.0f);
        float total = 0.0f;
        for (std::size_t i = 0; i < bundles.size(); ++i) {
            if (glm::dot(n, bundles[i].axis) < least_axis_cosines[i]) continue;
            for (const Beam& beam : bundles[i].beams) {
                const float cosine = glm::dot(n, beam.direction);
                if (cosine <= least_cosine) continue;
                const float weight = std::exp2(power * std::log2(cosine));
                sum += weight * beam.light;
                total += weight * beam.solid_angle;
            }
        }
        // A lobe between the centres of two texels is the nearest texel.
        return total > 0.0f ? sum / total : glm::vec3(source.read(n, 0u));
    });
}

}  // namespace candela::bake
