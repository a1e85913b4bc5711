// What of a profile is its model and no technique (fully rough materials, falloff) and what a light is (the
// cone of a disk): the same in the frame, in integrate and in the path tracer.
#include <gtest/gtest.h>

#include <array>

#include "local_lights.hpp"
#include "modes.hpp"
#include "probes.hpp"
#include "shading/lights/falloff_windows.glsl"

using namespace candela;
using namespace candela::test;

namespace {

constexpr std::uint32_t kIntegrateSamples = 64;
constexpr std::uint32_t kPathSamples = 1024;
const std::vector<glm::vec3> kOrigin{glm::vec3(0.0f)};

realtime::Profile profile(const std::string& base, const char* slot, const char* technique) {
    realtime::Profile p = realtime::profile_by_name(base);
    realtime::set_technique(p, slot, technique, "test");
    return p;
}

void expect_near(const PatchMeans& a, const PatchMeans& b, double tolerance, const std::string& what) {
    for (std::size_t column = 0; column < kPatchesSide; ++column) {
        const double difference = mean_magnitude(relative_differences(a, b, column));
        std::printf("%-48s %-12s %.4f\n", what.c_str(), kPatchMaterials[column], difference);
        EXPECT_LE(difference, tolerance) << what << ", " << kPatchMaterials[column];
    }
}

glm::vec3 patch_middle(std::size_t index) {
    const float column = static_cast<float>(index % kPatchesSide);
    return row_middle(static_cast<std::uint32_t>(index / kPatchesSide)) +
           glm::vec3(kPatch_m * (column + 0.5f - 0.5f * kPatchesSide), 0.0f, 0.0f);
}

/// Patches at the origin, a light of its own for each row.
scene::Scene one_light_a_row(const std::array<scene::LightType, kPatchesSide>& types) {
    scene::Scene s;
    add_patches(s, kOrigin[0], kTowards_rad, patch_materials(2457.0f / 4095.0f));
    for (std::uint32_t row = 0; row < kPatchesSide; ++row)
        s.lights.push_back(local_light(types[row], row_middle(row), towards_light(row), 1.0f));
    return s;
}

void make_fully_rough(scene::Scene& s) {
    for (scene::Material& m : s.materials) m.fully_rough = m.emissive_nit == glm::vec3(0.0f);
}

/// Diffuse materials of the colours that Karis 2014 gives fully rough ones.
void make_diffuse(scene::Scene& s) {
    for (scene::Material& m : s.materials) {
        if (m.emissive_nit != glm::vec3(0.0f)) continue;
        scene::Material plain;
        const glm::vec3 base(m.base_color);
        const glm::vec3 f0 = glm::mix(glm::vec3(0.04f), base, m.metallic);
        plain.base_color = glm::vec4(base * (1.0f - m.metallic) + 0.45f * f0, 1.0f);
        plain.metallic = 0.0f;
        plain.specular = 0.0f;
        m = plain;
    }
}

scene::Scene patches_under(float environment_nit) {
    scene::Scene s;
    add_patches(s, kOrigin[0], kTowards_rad, patch_materials(410.0f / 4095.0f));
    if (environment_nit > 0.0f) {
        s.environment = constant(environment_nit);
        s.environment->visible = false;
    }
    return s;
}

}  // namespace

// Karis 2014: roughness 1, 0.45 f0 goes to the diffuse colour, no specular. Exact techniques of the diffuse
// lobe, so that every type of light can be held to the integral.
TEST(FullyRough, IsOneDiffuseMaterialUnderLightsOfEveryTypeInAllModes) {
    using scene::LightType;
    const realtime::Profile p = profile("best", "fully-rough", "per-material");
    for (const auto& types :
         {std::array{LightType::point, LightType::spot, LightType::sphere, LightType::disk},
          std::array{LightType::rectangle, LightType::tube, LightType::line, LightType::frustum}}) {
        scene::Scene rough = one_light_a_row(types);
        scene::Scene plain = rough;
        const auto with_lobes = rendered(rough, kOrigin, p)[0];
        make_fully_rough(rough);
        make_diffuse(plain);
        const auto frame = rendered(rough, kOrigin, p)[0];
        const auto integral = rendered(rough, kOrigin, p, kIntegrateSamples)[0];
        const std::string what = std::string("from ") + scene::name_of(types[0]) + " on: ";
        expect_near(frame, rendered(plain, kOrigin, p)[0], 0.003, what + "fully rough to diffuse");
        expect_near(frame, integral, 0.005, what + "frame to integrate");
        expect_near(integral, traced(rough, kOrigin, p, kPathSamples)[0], 0.005, what + "integrate to path");
        EXPECT_GT(mean_magnitude(relative_differences(with_lobes, frame, 1)), 0.3)
            << "other materials keep their lobe";
    }
}

TEST(FullyRough, IsOneDiffuseMaterialUnderSurroundingsSunsAndProbesInAllModes) {
    const realtime::Profile p = realtime::profile_by_name("mobile");
    scene::Scene sun = patches_under(0.0f);
    for (const auto type : {scene::LightType::sun, scene::LightType::directional}) {
        scene::Light light;
        light.type = type;
        light.direction = -patch_normal(1, kTowards_rad);
        light.intensity = 1000.0f;
        light.visible = light.casts_shadow = false;
        sun.lights.push_back(light);
    }
    for (auto& [what, s] : std::vector<std::pair<std::string, scene::Scene>>{
             {"environment", patches_under(100.0f)}, {"sun", std::move(sun)}}) {
        scene::Scene plain = s;
        make_fully_rough(s);
        make_diffuse(plain);
        const auto frame = rendered(s, kOrigin, p)[0];
        const auto integral = rendered(s, kOrigin, p, kIntegrateSamples)[0];
        expect_near(frame, rendered(plain, kOrigin, p)[0], 0.003, what + ", fully rough to diffuse");
        expect_near(frame, integral, 0.005, what + ", frame to integrate");
        expect_near(integral, traced(s, kOrigin, p, kPathSamples)[0], 0.005, what + ", integrate to path");
    }
    scene::Scene probes = patches_under(0.0f);
    add_constant_probes(probes, 100.0f);
    scene::Scene plain = probes;
    make_fully_rough(probes);
    make_diffuse(plain);
    expect_near(rendered(probes, kOrigin, p)[0], rendered(plain, kOrigin, p)[0], 0.003, "probes");
}

TEST(FullyRough, RulesSayWhichMaterials) {
    scene::Material m;
    m.perceptual_roughness = 1.0f;
    using scene::FullyRoughRule;
    EXPECT_FALSE(is_fully_rough(m, FullyRoughRule::none));
    EXPECT_FALSE(is_fully_rough(m, FullyRoughRule::flagged));
    EXPECT_TRUE(is_fully_rough(m, FullyRoughRule::roughness_1));
    m.metallic_roughness_texture.texture = 0;
    EXPECT_FALSE(is_fully_rough(m, FullyRoughRule::roughness_1)) << "a texture may make it smooth";
    EXPECT_TRUE(is_fully_rough(m, FullyRoughRule::all));
    m.fully_rough = true;
    EXPECT_TRUE(is_fully_rough(m, FullyRoughRule::flagged));
    EXPECT_FALSE(is_fully_rough(m, FullyRoughRule::none));
    m.unlit = true;
    EXPECT_FALSE(is_fully_rough(m, FullyRoughRule::all));
}

// Karis 2013, equation 9 and Figure 9.
TEST(Falloff, IsThatOfTheProfileInAllModes) {
    using scene::LightType;
    scene::Scene s =
        one_light_a_row({LightType::point, LightType::spot, LightType::frustum, LightType::point});
    s.profiles.push_back(web());
    s.lights[3].profile = 0;
    s.lights[3].intensity = 1.0f;
    const auto physical = rendered(s, kOrigin, realtime::profile_by_name("best"))[0];
    for (const char* technique : {"inverse-square-offset", "exponent-2", "exponent-8"}) {
        realtime::Profile p = profile("best", "falloff", technique);
        realtime::set_parameter(p, "falloff-offset-m2", 1.0, "test");
        const auto frame = rendered(s, kOrigin, p)[0];
        for (std::size_t i = 0; i < frame.size(); ++i) {
            const scene::Light& light = s.lights[i / kPatchesSide];
            const glm::vec3 to_light = light.position - patch_middle(i);
            const double expected = double(
                shading::distance_attenuation({static_cast<int>(p.falloff), 1.0f}, to_light, light.range_m) /
                shading::distance_attenuation(to_light, light.range_m));
            EXPECT_GT(std::abs(expected - 1.0), 0.2) << technique;
            EXPECT_NEAR(frame[i] / physical[i], expected, 0.02 * expected) << technique << ", patch " << i;
        }
        const auto integral = rendered(s, kOrigin, p, 4)[0];
        expect_near(frame, integral, 0.003, std::string(technique) + ", frame to integrate");
        expect_near(integral, traced(s, kOrigin, p, kPathSamples)[0], 0.003,
                    std::string(technique) + ", integrate to path");
    }
}

// Only lights without extent: a sphere has the falloff of its solid angle.
TEST(Falloff, IsNotThatOfLightsWithASize) {
    using scene::LightType;
    const scene::Scene s =
        one_light_a_row({LightType::sphere, LightType::disk, LightType::rectangle, LightType::tube});
    expect_near(rendered(s, kOrigin, profile("best", "falloff", "exponent-8"))[0],
                rendered(s, kOrigin, realtime::profile_by_name("best"))[0], 1e-4, "shapes");
}

namespace {

constexpr float kInner_rad = 0.2f;
constexpr float kOuter_rad = 0.6f;
constexpr float kTilt_rad = 0.4f;

/// A disk a row whose cone's soft edge lies on the patches; that of the second row shines backwards, both
/// ways.
scene::Scene tilted_disks(float size) {
    scene::Scene s;
    add_patches(s, kOrigin[0], kTowards_rad, patch_materials(2457.0f / 4095.0f));
    for (std::uint32_t row = 0; row < kPatchesSide; ++row) {
        scene::Light light =
            local_light(scene::LightType::disk, row_middle(row), towards_light(row), 2.0f * size);
        light.direction = std::cos(kTilt_rad) * light.direction + std::sin(kTilt_rad) * light.up();
        light.two_sided = row == 1;
        if (light.two_sided) light.direction = -light.direction;
        light.right = glm::normalize(glm::cross(light.direction, glm::vec3(0.3f, 1.0f, 0.2f)));
        light.inner_cone_rad = kInner_rad;
        light.outer_cone_rad = kOuter_rad;
        light.cone = true;
        s.lights.push_back(light);
    }
    return s;
}

/// What the spot in the disk's apex leaves at a point.
double cone_factor(const scene::Light& light, const glm::vec3& point) {
    const glm::vec3 shines = light.two_sided ? -light.direction : light.direction;
    const glm::vec3 apex = light.position - shines * (light.radius_m / std::tan(kOuter_rad));
    return double(shading::angle_attenuation(glm::dot(glm::normalize(point - apex), shines),
                                             std::cos(kInner_rad), std::cos(kOuter_rad)));
}

void expect_cones(const scene::Scene& with, const PatchMeans& a, const PatchMeans& b, const char* mode) {
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double expected = cone_factor(with.lights[i / kPatchesSide], patch_middle(i));
        EXPECT_GT(expected, 0.05);
        EXPECT_LT(expected, 0.95);
        EXPECT_NEAR(a[i] / b[i], expected, 0.04 * expected) << mode << ", patch " << i;
    }
}

scene::Scene without_cones(scene::Scene s) {
    for (scene::Light& light : s.lights) light.cone = false;
    return s;
}

}  // namespace

// Frostbite listing 9: the attenuation of a spot whose cone has the disk's rim.
TEST(DiskCone, IsThatOfASpotBehindItInAllModes) {
    const realtime::Profile p = realtime::profile_by_name("best");
    const scene::Scene with = tilted_disks(1.0f);
    const scene::Scene without = without_cones(with);
    const auto frame = rendered(with, kOrigin, p)[0];
    expect_cones(with, frame, rendered(without, kOrigin, p)[0], "frame");
    const auto integral = rendered(with, kOrigin, p, kIntegrateSamples)[0];
    expect_cones(with, integral, rendered(without, kOrigin, p, kIntegrateSamples)[0], "integrate");
    expect_near(integral, traced(with, kOrigin, p, kPathSamples)[0], 0.015, "integrate to path");
}

TEST(DiskCone, IsThatOfTheSpotInItsPlaceWhenItIsSmall) {
    const scene::Scene with = tilted_disks(0.02f);
    const realtime::Profile p = realtime::profile_by_name("frostbite");
    expect_cones(with, rendered(with, kOrigin, p)[0], rendered(without_cones(with), kOrigin, p)[0], "frame");
    for (std::uint32_t row = 0; row < kPatchesSide; ++row) {
        const double spot = double(
            shading::angle_attenuation(std::cos(kTilt_rad), std::cos(kInner_rad), std::cos(kOuter_rad)));
        EXPECT_NEAR(cone_factor(with.lights[row], row_middle(row)), spot, 0.03);
    }
}
