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

constexpr std::uint32_t kIntegrateSamples = 16;
/// All directions at once are harder to draw from than one light.
constexpr std::uint32_t kEnvironmentSamples = 64;
constexpr std::uint32_t kPathSamples = 4096;

const std::vector<glm::vec3> kOrigin{glm::vec3(0.0f)};

scene::Scene patches_alone() {
    scene::Scene s;
    add_patches(s, kOrigin[0], kTowards_rad, patch_materials(410.0f / 4095.0f));
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
    add_patches(s, kOrigin[0], kTowards_rad, patch_materials(2457.0f / 4095.0f));
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
        const auto differences = relative_differences(seen, truth, column);
        const double difference = mean_magnitude(differences);
        std::printf("%-44s %-12s %.4f (%+.4f %+.4f %+.4f %+.4f)\n", what.c_str(), kPatchMaterials[column],
                    difference, differences[0], differences[1], differences[2], differences[3]);
        EXPECT_LE(difference, bounds[column]) << what << ", " << kPatchMaterials[column];
    }
}

/// Roughness from where a light of a few hundredths of a mrad is still small to the lobe up to 1, with and
/// without a coat.
std::vector<scene::Material> limit_materials() {
    std::vector<scene::Material> out = patch_materials(410.0f / 4095.0f);
    out[2].perceptual_roughness = 2457.0f / 4095.0f;
    out[3].perceptual_roughness = 1.0f;
    return out;
}

class Matrix : public testing::TestWithParam<std::string> {
  protected:
    const realtime::Profile profile_ = realtime::profile_by_name(GetParam());

    [[nodiscard]] std::string cell(const std::string& light, const char* modes) const {
        return profile_.name + ", " + light + ", " + modes;
    }

    /// Returns what integrate finds.
    PatchMeans expect_one_model(const scene::Scene& s, const Bounds& bounds, const std::string& light,
                                const Bounds& truths = kTruths,
                                std::uint32_t samples = kEnvironmentSamples) const {
        const PatchMeans integral = rendered(s, kOrigin, profile_, samples)[0];
        expect_within(integral, traced(s, kOrigin, profile_, kPathSamples)[0], truths,
                      cell(light, "integrate to path"));
        expect_within(rendered(s, kOrigin, profile_)[0], integral, bounds, cell(light, "frame to integrate"));
        return integral;
    }

    static constexpr Bounds kTruths{0.005, 0.005, 0.005, 0.005};
    static constexpr Bounds kStudioTruths{0.005, 0.005, 0.01, 0.008};
    static constexpr Bounds kEmissiveTruths{0.005, 0.005, 0.0075, 0.005};
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
    expect_one_model(under_suns(), sun_bounds(profile_), "sun", kTruths, kIntegrateSamples);
}

TEST_P(Matrix, LightsThatHaveAPlace) {
    for (const Places& places : all_local_lights()) {
        const auto frame = rendered(places.scene, places.middles, profile_);
        // Of the eight emissive triangles a sample picks one: more noise, and more samples.
        const std::uint32_t more = places.names[0] == "emissive" ? 4 : 1;
        const auto integral = rendered(places.scene, places.middles, profile_, more * kIntegrateSamples);
        const auto path = traced(places.scene, places.middles, profile_, more * kPathSamples);
        for (std::size_t k = 0; k < places.names.size(); ++k) {
            expect_within(integral[k], path[k], more > 1 ? kEmissiveTruths : kTruths,
                          cell(places.names[k], "integrate to path"));
            expect_within(frame[k], integral[k], local_light_bounds(profile_, places.names[k]),
                          cell(places.names[k], "frame to integrate"));
        }
    }
}

// The limit: a light of a size tends to the point light of the same intensity as its size goes to zero (Karis
// 2013, "Area Lights").
TEST_P(Matrix, SmallLightsArePoints) {
    // 0.008 to 0.012 mrad in radius. A representative point is off the light's middle by as much, which a
    // lobe of alpha 0.01 notices.
    LocalLightOptions o;
    o.size = 2.0e-4f;
    o.off_mirror = 0.02f;
    o.row_depth_m = 0.0f;  // the lights of all rows light each, and all is near the origin
    o.materials = limit_materials();
    o.place_m = 30.0f;  // emissive squares have no range
    std::vector<scene::LightType> types = kShapes;
    types.push_back(scene::LightType::line);
    const Places shapes = local_lights(types, o, emissive_squares(o));
    o.points = true;
    const Places points = local_lights(types, o, emissive_squares(o));
    const auto nit_of_shapes = rendered(shapes.scene, shapes.middles, profile_);
    const auto nit_of_points = rendered(points.scene, points.middles, profile_);
    for (std::size_t k = 0; k < shapes.names.size(); ++k) {
        for (std::size_t column = 0; column < kPatchesSide; ++column) {
            const auto differences = relative_differences(nit_of_shapes[k], nit_of_points[k], column);
            const double largest = std::abs(*std::ranges::max_element(
                differences, [](double a, double b) { return std::abs(a) < std::abs(b); }));
            std::printf("%-44s %zu %.4f\n", cell(shapes.names[k], "small to point").c_str(), column, largest);
            EXPECT_LE(largest, 0.01) << cell(shapes.names[k], "small to point") << ", column " << column;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Profiles, Matrix, testing::ValuesIn(realtime::profile_names()),
                         [](const auto& instance) {
                             std::string name = instance.param;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });
