#include "candela/bake/dfg_bake.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "shading/dfg.glsl"

namespace candela {
namespace {

/// What bilinear reading of a baked table of 128 x 128 gives, from the four entries that it needs.
glm::vec4 read_baked(bake::DfgVisibility visibility, float NoV, float perceptual_roughness) {
    constexpr float last = 127.0f;
    const float x = std::sqrt(NoV) * last;
    const float y = perceptual_roughness * last;
    const float left = std::min(std::floor(x), last - 1.0f);
    const float top = std::min(std::floor(y), last - 1.0f);
    const auto entry = [&](float i, float j) {
        return bake::dfg_entry(visibility, (i / last) * (i / last), j / last, 1024);
    };
    return glm::mix(glm::mix(entry(left, top), entry(left + 1.0f, top), x - left),
                    glm::mix(entry(left, top + 1.0f), entry(left + 1.0f, top + 1.0f), x - left), y - top);
}

TEST(DfgBake, TableOf128IsWithinOneThousandthOfAMillionSamples) {
    for (const auto visibility :
         {bake::DfgVisibility::smith_correlated, bake::DfgVisibility::smith_uncorrelated,
          bake::DfgVisibility::schlick_smith}) {
        for (const float roughness : {0.031f, 0.33f, 0.508f, 0.97f}) {
            for (const float NoV : {0.004f, 0.047f, 0.6f}) {
                const glm::vec4 truth = bake::dfg_entry(visibility, NoV, roughness, 1u << 20u);
                const glm::vec4 value = read_baked(visibility, NoV, roughness);
                for (int c = 0; c < 4; ++c)
                    EXPECT_NEAR(value[c], truth[c], 1.0e-3f) << roughness << " " << NoV << " " << c;
            }
        }
    }
}

TEST(DfgBake, TableHoldsItsEntries) {
    const bake::DfgTable table = bake::bake_dfg(bake::DfgVisibility::smith_correlated, 4, 64);
    for (std::uint32_t y = 0; y < 4; ++y) {
        for (std::uint32_t x = 0; x < 4; ++x) {
            const float root = static_cast<float>(x) / 3.0f;
            const float roughness = static_cast<float>(y) / 3.0f;
            EXPECT_NEAR(table.read(root * root, roughness).x,
                        bake::dfg_entry(bake::DfgVisibility::smith_correlated, root * root, roughness, 64).x,
                        1.0e-5f);
        }
    }
}

TEST(DfgBake, UncorrelatedMaskingTakesMoreLight) {
    for (const float roughness : {0.3f, 0.6f, 1.0f}) {
        const glm::vec2 apart = shading::integrate_ggx_albedo_uncorrelated(0.3f, roughness, 1024);
        const glm::vec2 together = shading::integrate_ggx_albedo(0.3f, roughness, 1024);
        EXPECT_LT(apart.x + apart.y, together.x + together.y);
    }
}

}  // namespace
}  // namespace candela
