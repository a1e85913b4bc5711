// Every profile under light that comes from no light of the scene: frame, integrate and path are one model.
#include "candela/bake/environment.hpp"

#include <gtest/gtest.h>

#include "modes.hpp"

using namespace candela;
using namespace candela::test;

namespace {

const std::vector<glm::vec3> kHere{glm::vec3(0.0f)};

scene::Scene under(scene::Environment environment) {
    scene::Scene s;
    add_patches(s, kHere[0], 0.5f, 410.0f / 4095.0f);
    environment.visible = false;
    s.environment = std::move(environment);
    return s;
}

struct Difference {
    double truth;  ///< integrate against path
    double frame;  ///< against integrate
};

std::vector<Difference> compared(const scene::Scene& s, const realtime::Profile& profile, const char* what) {
    const PatchMeans frame = rendered(s, kHere, profile)[0];
    const PatchMeans integral = rendered(s, kHere, profile, 64)[0];
    const PatchMeans path = traced(s, kHere, profile, 256)[0];
    std::vector<Difference> out;
    for (std::size_t column = 0; column < kPatchesSide; ++column) {
        out.push_back(
            {relative_difference(integral, path, column), relative_difference(frame, integral, column)});
        std::printf("%-10s %-22s %-15s integrate %.4f frame %.4f\n", profile.name.c_str(), what,
                    kPatchMaterials[column], out.back().truth, out.back().frame);
        for (std::size_t i = column; i < path.size(); i += kPatchesSide) {
            std::printf("    NoV %.2f frame / integrate %.4f integrate / path %.4f\n",
                        double(kPatchNoV[i / 4]), frame[i] / integral[i], integral[i] / path[i]);
        }
    }
    return out;
}

class EnvironmentMatrix : public testing::TestWithParam<std::string> {};

}  // namespace

TEST_P(EnvironmentMatrix, Constant) {
    compared(under(constant(100.0f)), realtime::profile_by_name(GetParam()), "constant");
}

TEST_P(EnvironmentMatrix, Studio) {
    compared(under(bake::studio_environment()), realtime::profile_by_name(GetParam()), "studio");
}

INSTANTIATE_TEST_SUITE_P(Profiles, EnvironmentMatrix, testing::ValuesIn(realtime::profile_names()),
                         [](const auto& instance) { return instance.param; });
