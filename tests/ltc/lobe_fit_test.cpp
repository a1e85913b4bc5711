#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "candela/bake/layer_fit.hpp"

namespace candela::bake {
namespace {

using shading::LobeRead;

std::vector<LobeRead> mirror(const glm::vec3& n, const glm::vec3& v, float perceptual_roughness, float) {
    return {{2.0f * glm::dot(n, v) * n - v, perceptual_roughness, 1.0f}};
}
// The kernel itself, seen from above where it is nearly the lobe: what the measure calls an error must be
// small.
TEST(LobeFit, FindsTheKernelInTheLobeSeenFromAbove) {
    EXPECT_LT(lobe_error(mirror, 1.0f, 0.2f, 1.0f), 0.01);
    EXPECT_GT(lobe_error(mirror, 0.1f, 0.2f, 1.0f), 0.2);
}

// What shading/ holds has the errors that it says.
TEST(LobeFit, OfTheShadersIsAsGoodAsTheySay) {
    EXPECT_NEAR(lobe_errors(mirror).mean, 0.183, 0.002);
    EXPECT_LT(committed_lobe_errors(1).mean, 0.063);
    EXPECT_LT(committed_lobe_errors(2).mean, 0.0325);
    EXPECT_LT(committed_lobe_errors(3).mean, 0.0225);
    EXPECT_LT(committed_lobe_errors(3).largest, 0.09);
}

TEST(LobeFit, FindsAgainWhatTheShadersHold) {
    const LobeFit fit = fit_lobe_reads(1);
    ASSERT_EQ(fit.coefficients.size(), 2u);
    EXPECT_NEAR(fit.errors.mean, committed_lobe_errors(1).mean, 2e-4);
}

// The constants of layers are near the best that the fit finds from afar, and better than what they are
// instead of.
TEST(LayerFit, FindsAgainWhatTheShadersHold) {
    const LayerFit metal = fit_anisotropic_reads();
    EXPECT_LT(metal.committed.mean, 1.02 * metal.found.mean);
    EXPECT_LT(metal.committed.mean, 0.26 * metal.instead.mean);
    for (const FittedConstant& c : metal.constants) EXPECT_NEAR(c.found, c.committed, 0.1) << c.name;
    const LayerFit sheen = fit_sheen_read();
    EXPECT_LT(sheen.committed.mean, 1.01 * sheen.found.mean);
    EXPECT_LT(sheen.committed.mean, 0.55 * sheen.instead.mean);
}

}  // namespace
}  // namespace candela::bake
