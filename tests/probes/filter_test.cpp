#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "candela/bake/lobe_field.hpp"
#include "candela/bake/probe_filter.hpp"
#include "shading/octahedral.glsl"
#include "shading/spherical_harmonics.glsl"

using namespace candela;

namespace {

/// Light that rises with height and surroundings that thicken along x: functions of degree 1, which every
/// round lobe scales by one number about their mean.
glm::vec4 around(const glm::vec3& d, float gain) {
    return {glm::vec3(100.0f * (1.0f + 0.8f * gain * d.y)), 0.5f * (1.0f + 0.9f * gain * d.x)};
}

bake::ProbeFaces faces_of(std::uint32_t size) {
    bake::ProbeFaces out;
    out.size = size;
    for (std::size_t f = 0; f < out.faces.size(); ++f) {
        const glm::mat4 world = bake::probe_camera(f, glm::vec3(0.0f)).world;
        for (std::uint32_t y = 0; y < size; ++y) {
            for (std::uint32_t x = 0; x < size; ++x) {
                const float right = (2.0f * float(x) + 1.0f) / float(size) - 1.0f;
                const float up = 1.0f - (2.0f * float(y) + 1.0f) / float(size);
                const glm::vec3 d(right * world[0] + up * world[1] - world[2]);
                out.faces[f].push_back(around(glm::normalize(d), 1.0f));
            }
        }
    }
    return out;
}

}  // namespace

// Level i is the picture blurred by the lobe of perceptual roughness (i / 5)^2, seen and visible parts alike.
TEST(ProbeFilter, EachLevelIsTheLobeOfItsRoughness) {
    const gpu::Device device{gpu::DeviceOptions{}};
    gpu::Commands commands(device);
    const scene::ProbeCapture capture = bake::filter_probe(device, commands, faces_of(32));
    ASSERT_EQ(capture.levels.size(), 6u);
    for (std::size_t level = 0; level < capture.levels.size(); ++level) {
        const auto size = int(capture.size >> level);
        const float step = float(level) / 5.0f;
        const float alpha = step * step * step * step;
        const float gain = level == 0 ? 1.0f : float(bake::ld_zonal_coefficients(alpha, 1)[1]);
        float worst = 0.0f;
        for (int y = 1; y + 1 < size; ++y) {
            for (int x = 1; x + 1 < size; ++x) {
                const glm::vec2 e = (glm::vec2(x, y) - 0.5f) / float(size - 2) * 2.0f - 1.0f;
                const glm::vec4 expected = around(shading::octahedral_decode(e), gain);
                const glm::vec4 seen = capture.levels[level][std::size_t(y * size + x)];
                worst = std::max(worst, std::abs(seen.x - expected.x) / 100.0f);
                worst = std::max(worst, 2.0f * std::abs(seen.w - expected.w));
            }
        }
        EXPECT_LT(worst, 0.02f) << "level " << level;
    }
}

TEST(ProbeFilter, ItsHarmonicsAreTheIrradianceOverPi) {
    const std::array<glm::vec4, 9> sh = bake::probe_irradiance_sh(faces_of(32));
    for (const glm::vec3& n : {glm::vec3(0, 1, 0), glm::vec3(0, -1, 0), glm::vec3(0.6f, 0.0f, 0.8f),
                               glm::vec3(-0.48f, 0.6f, -0.64f)}) {
        glm::vec4 sum(0.0f);
        for (int k = 0; k < shading::kShCoefficients; ++k)
            sum += sh[std::size_t(k)] * shading::sh_basis(k, n);
        const glm::vec4 expected = around(n, 2.0f / 3.0f);
        EXPECT_NEAR(sum.x / expected.x, 1.0f, 2e-3f);
        EXPECT_NEAR(sum.w / expected.w, 1.0f, 2e-3f);
    }
}
