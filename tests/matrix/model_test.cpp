// What of a profile is its model and no technique (fully rough materials, falloff) and what a light is (the
// cone of a disk): the same in the frame, in integrate and in the path tracer.
#include <gtest/gtest.h>

#include "local_lights.hpp"
#include "modes.hpp"
#include "probes.hpp"
#include "shading/lights/falloff_windows.glsl"

using namespace candela;
using namespace candela::test;

namespace {

constexpr std::uint32_t kIntegrateSamples = 32;
constexpr std::uint32_t kPathSamples = 128;
const std::vector<glm::vec3> kOrigin{glm::vec3(0.0f)};

realtime::Profile profile(const std::string& base, const char* slot, const char* technique) {
    realtime::Profile p = realtime::profile_by_name(base);
    realtime::set_technique(p, slot, technique, "test");
    return p;
}

void expect_near(const PatchMeans& a, const PatchMeans& b, double tolerance, const std::string& what) {
    for (std::size_t column = 0; column < kPatchesSide; ++column) {
        const double difference = relative_difference(a, b, column);
        std::printf("%-48s %-12s %.4f\n", what.c_str(), kPatchMaterials[column], difference);
        EXPECT_LE(difference, tolerance) << what << ", " << kPatchMaterials[column];
    }
}

/// Means of the grid over those of another run.
std::vector<double> ratios(const PatchMeans& a, const PatchMeans& b) {
    std::vector<double> out;
    for (std::size_t i = 0; i < a.size(); ++i) out.push_back(a[i] / b[i]);
    return out;
}

bool without_extent(const std::string& light) {
    return light == "point" || light == "spot" || light == "frustum" || light == "IES";
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
    add_patches(s, kOrigin[0], kTowards_rad, 410.0f / 4095.0f);
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
    const realtime::Profile p = profile("best", "fully-rough", "per-material");
    Places rough = local_lights();
    make_fully_rough(rough.scene);
    Places plain = local_lights();
    make_diffuse(plain.scene);
    const auto frame = rendered(rough.scene, rough.middles, p);
    const auto integral = rendered(rough.scene, rough.middles, p, kIntegrateSamples);
    const auto path = traced(rough.scene, rough.middles, p, kPathSamples);
    const auto of_plain = rendered(plain.scene, plain.middles, p);
    const auto with_lobes = rendered(rough.scene, rough.middles, realtime::profile_by_name("best"));
    for (std::size_t k = 0; k < rough.names.size(); ++k) {
        const std::string& light = rough.names[k];
        expect_near(frame[k], of_plain[k], 0.003, light + ", fully rough to diffuse");
        expect_near(frame[k], integral[k], without_extent(light) ? 0.002 : 0.02,
                    light + ", frame to integrate");
        expect_near(integral[k], path[k], 0.03, light + ", integrate to path");
        EXPECT_GT(relative_difference(with_lobes[k], frame[k], 1), 0.3) << "other profiles have no such rule";
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
    const Places places = local_lights();
    const auto physical = rendered(places.scene, places.middles, realtime::profile_by_name("best"));
    for (const char* technique : {"inverse-square-offset", "exponent-2", "exponent-8"}) {
        realtime::Profile p = profile("best", "falloff", technique);
        realtime::set_parameter(p, "falloff-offset-m2", 1.0, "test");
        const auto frame = rendered(places.scene, places.middles, p);
        const auto integral = rendered(places.scene, places.middles, p, kIntegrateSamples);
        const auto path = traced(places.scene, places.middles, p, kPathSamples);
        const shading::vec3 to_light(kDistance_m, 0.0f, 0.0f);
        const float range_m = 6.0f;
        const double expected =
            double(shading::distance_attenuation({static_cast<int>(p.falloff), 1.0f}, to_light, range_m) /
                   shading::distance_attenuation(to_light, range_m));
        EXPECT_GT(std::abs(expected - 1.0), 0.2) << technique;
        for (std::size_t k = 0; k < places.names.size(); ++k) {
            const std::string what = places.names[k] + ", " + technique;
            const bool affected = without_extent(places.names[k]);
            for (const double ratio : ratios(frame[k], physical[k])) {
                EXPECT_NEAR(ratio, affected ? expected : 1.0, affected ? 0.03 * expected : 1e-3) << what;
            }
            if (!affected) continue;
            expect_near(frame[k], integral[k], 0.005, what + ", frame to integrate");
            // Each draw of the path tracer picks one of 40 lights.
            expect_near(integral[k], path[k], 0.05, what + ", integrate to path");
        }
    }
}

// Frostbite listing 9; as the disk shrinks it goes over into the spot.
TEST(DiskCone, IsThatOfASpotBehindItInAllModes) {
    constexpr float kInner_rad = 0.2f;
    constexpr float kOuter_rad = 0.6f;
    constexpr float kTilt_rad = 0.4f;
    for (const float size : {1.0f, 0.02f}) {
        scene::Scene with;
        add_patches(with, kOrigin[0], kTowards_rad, 2457.0f / 4095.0f);
        std::vector<double> expected;
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
            with.lights.push_back(light);
            const glm::vec3 shines = light.two_sided ? -light.direction : light.direction;
            const glm::vec3 apex = light.position - shines * (light.radius_m / std::tan(kOuter_rad));
            const float cosine = glm::dot(glm::normalize(row_middle(row) - apex), shines);
            expected.push_back(
                double(shading::angle_attenuation(cosine, std::cos(kInner_rad), std::cos(kOuter_rad))));
            EXPECT_GT(expected.back(), 0.05);
            EXPECT_LT(expected.back(), 0.95);
            if (size < 0.1f) {
                EXPECT_NEAR(expected.back(),
                            double(shading::angle_attenuation(std::cos(kTilt_rad), std::cos(kInner_rad),
                                                              std::cos(kOuter_rad))),
                            0.02)
                    << "the spot in its place";
            }
        }
        scene::Scene without = with;
        for (scene::Light& light : without.lights) light.cone = false;
        for (const char* name : {"best", "frostbite"}) {
            const realtime::Profile p = realtime::profile_by_name(name);
            const auto expect_factor = [&](const PatchMeans& a, const PatchMeans& b, const char* mode) {
                const std::vector<double> factor = ratios(a, b);
                for (std::size_t i = 0; i < factor.size(); ++i) {
                    EXPECT_NEAR(factor[i], expected[i / kPatchesSide], 0.03 * expected[i / kPatchesSide])
                        << name << ", " << mode << ", size " << size;
                }
            };
            expect_factor(rendered(with, kOrigin, p)[0], rendered(without, kOrigin, p)[0], "frame");
            if (p.name != "best") continue;
            expect_factor(rendered(with, kOrigin, p, kIntegrateSamples)[0],
                          rendered(without, kOrigin, p, kIntegrateSamples)[0], "integrate");
            expect_factor(traced(with, kOrigin, p, kPathSamples)[0],
                          traced(without, kOrigin, p, kPathSamples)[0], "path");
        }
    }
}
