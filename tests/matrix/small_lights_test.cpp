// A light of a size tends to the point light of the same lumens as its size goes to zero, in every profile:
// Karis 2013, "Area Lights".
#include <gtest/gtest.h>

#include "local_lights.hpp"
#include "modes.hpp"

using namespace candela;
using namespace candela::test;
using scene::LightType;

namespace {

class SmallLights : public testing::TestWithParam<std::string> {};

}  // namespace

TEST_P(SmallLights, AreThePointLightsOfTheSameLumens) {
    Places places = local_lights(5.0e-3f);
    const realtime::Profile profile = realtime::profile_by_name(GetParam());
    const std::vector<PatchMeans> frame = rendered(places.scene, places.middles, profile);
    const std::vector<PatchMeans> point = traced(places.scene, places.middles, profile, 16);
    for (std::size_t k = 0; k < places.names.size(); ++k) {
        for (std::size_t i = 0; i < point[k].size(); ++i) {
            std::printf("%s%.4f", i % 4 == 0 ? "  " : " ", frame[k][i] / point[k][i]);
        }
        std::printf("  %s %s\n", GetParam().c_str(), places.names[k].c_str());
    }
    for (std::size_t k = 0; k < places.names.size(); ++k) {
        for (std::size_t i = 0; i < point[k].size(); ++i) {
            EXPECT_NEAR(frame[k][i] / point[k][i], 1.0, 0.01)
                << GetParam() << ", " << places.names[k] << ", " << kPatchMaterials[i % kPatchesSide]
                << ", NoV " << kPatchNoV[i / kPatchesSide];
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Profiles, SmallLights, testing::ValuesIn(realtime::profile_names()),
                         [](const auto& instance) { return instance.param; });
