#include "candela/bake/lobe_fit.hpp"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace candela::bake {
namespace {

using shading::LobeRead;

std::vector<LobeRead> mirror(const glm::vec3& n, const glm::vec3& v, float perceptual_roughness, float) {
    return {{2.0f * glm::dot(n, v) * n - v, perceptual_roughness, 1.0f}};
}
std::vector<LobeRead> one(const glm::vec3& n, const glm::vec3& v, float perceptual_roughness, float share) {
    return {shading::fitted_reflection(n, v, v.z, perceptual_roughness, share)};
}
std::vector<LobeRead> two(const glm::vec3& n, const glm::vec3& v, float perceptual_roughness, float share) {
    std::vector<LobeRead> out(2);
    shading::stretched_reflection_2(n, v, v.z, perceptual_roughness, share, out[0], out[1]);
    return out;
}
std::vector<LobeRead> three(const glm::vec3& n, const glm::vec3& v, float perceptual_roughness, float share) {
    std::vector<LobeRead> out(3);
    shading::stretched_reflection_3(n, v, v.z, perceptual_roughness, share, out[0], out[1], out[2]);
    return out;
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
    EXPECT_LT(lobe_errors(one).mean, 0.063);
    EXPECT_LT(lobe_errors(two).mean, 0.0325);
    EXPECT_LT(lobe_errors(three).mean, 0.0225);
    EXPECT_LT(lobe_errors(three).largest, 0.09);
}

TEST(LobeFit, FindsAgainWhatTheShadersHold) {
    const LobeFit fit = fit_lobe_reads(1);
    ASSERT_EQ(fit.coefficients.size(), 2u);
    EXPECT_NEAR(fit.errors.mean, lobe_errors(one).mean, 2e-4);
}

}  // namespace
}  // namespace candela::bake
