// Every profile in every mode under every kind of light: integrate is the direct light of the path tracer,
// and the frame is within what its techniques err. A new profile is in here by its name alone.
#include <gtest/gtest.h>

#include <algorithm>

#include "bounds.hpp"
#include "candela/bake/environment.hpp"
#include "local_lights.hpp"
#include "modes.hpp"
#include "probes.hpp"

using namespace candela;
using namespace candela::test;

namespace {

constexpr std::uint32_t kIntegrateSamples = 32;
constexpr std::uint32_t kPathSamples = 128;

const std::vector<glm::vec3> kOrigin{glm::vec3(0.0f)};

scene::Scene patches_alone() {
    scene::Scene s;
    add_patches(s, kOrigin[0], kTowards_rad, 410.0f / 4095.0f);
    return s;
}

scene::Scene under(scene::Environment environment) {
    scene::Scene s = patches_alone();
    environment.visible = false;
    s.environment = std::move(environment);
    return s;
}

/// A sun in the highlight of each row.
scene::Scene under_suns() {
    scene::Scene s;
    add_patches(s, kOrigin[0], kTowards_rad, 2457.0f / 4095.0f);
    for (std::uint32_t row = 0; row < kPatchesSide; ++row) {
        scene::Light light;
        light.type = scene::LightType::sun;
        light.direction = -towards_light(row);
        light.intensity = 1000.0f;
        light.visible = light.casts_shadow = false;
        s.lights.push_back(light);
    }
    return s;
}

/// Probes that see the same everywhere.
scene::Scene among_probes(float nit) {
    scene::Scene s = patches_alone();
    add_constant_probes(s, nit);
    return s;
}

void expect_within(const PatchMeans& seen, const PatchMeans& truth, const Bounds& bounds,
                   const std::string& what) {
    for (std::size_t column = 0; column < kPatchesSide; ++column) {
        const double difference = relative_difference(seen, truth, column);
        std::printf("%-44s %-12s %.4f\n", what.c_str(), kPatchMaterials[column], difference);
        EXPECT_LE(difference, bounds[column]) << what << ", " << kPatchMaterials[column];
    }
}

class Matrix : public testing::TestWithParam<std::string> {
  protected:
    const realtime::Profile profile_ = realtime::profile_by_name(GetParam());

    [[nodiscard]] std::string cell(const std::string& light, const char* modes) const {
        return profile_.name + ", " + light + ", " + modes;
    }

    /// Returns what integrate finds.
    PatchMeans expect_one_model(const scene::Scene& s, const Bounds& bounds, const std::string& light,
                                const Bounds& truths = kTruths) const {
        const PatchMeans integral = rendered(s, kOrigin, profile_, kIntegrateSamples)[0];
        expect_within(integral, traced(s, kOrigin, profile_, kPathSamples)[0], truths,
                      cell(light, "integrate to path"));
        expect_within(rendered(s, kOrigin, profile_)[0], integral, bounds, cell(light, "frame to integrate"));
        return integral;
    }

    static constexpr Bounds kTruths{0.005, 0.005, 0.005, 0.005};
    static constexpr Bounds kStudioTruths{0.005, 0.005, 0.01, 0.008};
    /// Each draw picks one of 40 lights; LightAgreement.* holds each type alone to 0.5 %.
    static constexpr Bounds kNoisyTruths{0.1, 0.1, 0.1, 0.1};
};

}  // namespace

TEST_P(Matrix, ConstantEnvironmentAndProbes) {
    const PatchMeans integral = expect_one_model(
        under(constant(100.0f)), constant_environment_bounds(profile_), "constant environment");
    expect_within(rendered(among_probes(100.0f), kOrigin, profile_)[0], integral,
                  constant_environment_bounds(profile_), cell("probes", "frame to integrate"));
}

TEST_P(Matrix, Studio) {
    // The dielectric's grazing angles have noise of 0.6 %.
    expect_one_model(under(bake::studio_environment()), studio_bounds(profile_), "studio", kStudioTruths);
}

TEST_P(Matrix, Suns) {
    expect_one_model(under_suns(), sun_bounds(profile_), "sun");
}

TEST_P(Matrix, LightsThatHaveAPlace) {
    const Places places = local_lights();
    const auto frame = rendered(places.scene, places.middles, profile_);
    const auto integral = rendered(places.scene, places.middles, profile_, kIntegrateSamples);
    const auto path = traced(places.scene, places.middles, profile_, kPathSamples);
    for (std::size_t k = 0; k < places.names.size(); ++k) {
        expect_within(integral[k], path[k], kNoisyTruths, cell(places.names[k], "integrate to path"));
        expect_within(frame[k], integral[k], local_light_bounds(profile_, places.names[k]),
                      cell(places.names[k], "frame to integrate"));
    }
}

// The limit: a light of a size tends to the point light of the same intensity as its size goes to zero (Karis
// 2013, "Area Lights").
TEST_P(Matrix, SmallLightsArePoints) {
    constexpr float kSize = 5.0e-3f;
    // A representative point is off the light's middle by up to its angular radius, 1 mrad here, which is
    // what a grazing lobe of alpha 0.09 notices. A lobe that is not the point light's is off by a factor.
    const double of_technique = profile_.area_specular == realtime::AreaSpecularTechnique::ltc ? 0.01 : 0.035;
    const Places shapes = local_lights(kSize);
    const Places points = local_lights(kSize, true);
    const auto of_shapes = rendered(shapes.scene, shapes.middles, profile_);
    const auto of_points = rendered(points.scene, points.middles, profile_);
    for (std::size_t k = 0; k < shapes.names.size(); ++k) {
        // Emissive surfaces have no range: those of other rows add a little.
        const double tolerance = shapes.names[k] == "emissive" ? of_technique + 0.005 : of_technique;
        for (std::size_t i = 0; i < of_points[k].size(); ++i) {
            EXPECT_NEAR(of_shapes[k][i] / of_points[k][i], 1.0, tolerance)
                << GetParam() << ", " << shapes.names[k] << ", " << kPatchMaterials[i % kPatchesSide]
                << ", NoV " << kPatchNoV[i / kPatchesSide];
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Profiles, Matrix, testing::ValuesIn(realtime::profile_names()),
                         [](const auto& instance) {
                             std::string name = instance.param;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });
