#include <gtest/gtest.h>

#include "local_lights.hpp"
#include "modes.hpp"

using namespace candela;
using namespace candela::test;

namespace {

class LightMatrix : public testing::TestWithParam<std::string> {};

}  // namespace

TEST_P(LightMatrix, Local) {
    const Places places = local_lights();
    const realtime::Profile profile = realtime::profile_by_name(GetParam());
    const std::vector<PatchMeans> frame = rendered(places.scene, places.middles, profile);
    const std::vector<PatchMeans> integral = rendered(places.scene, places.middles, profile, 32);
    const std::vector<PatchMeans> path = traced(places.scene, places.middles, profile, 64);
    for (std::size_t k = 0; k < places.names.size(); ++k) {
        for (std::size_t column = 0; column < kPatchesSide; ++column) {
            std::printf("%-10s %-12s %-15s integrate %.4f frame %.4f\n", profile.name.c_str(),
                        places.names[k].c_str(), kPatchMaterials[column],
                        relative_difference(integral[k], path[k], column),
                        relative_difference(frame[k], integral[k], column));
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Profiles, LightMatrix, testing::ValuesIn(realtime::profile_names()),
                         [](const auto& instance) { return instance.param; });
