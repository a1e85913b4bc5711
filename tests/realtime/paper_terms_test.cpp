// Terms of the profiles ue4, mobile and frostbite as their papers have them, on a plane, against the papers'
// formulas.
#include <gtest/gtest.h>

#include "render_scenes.hpp"
#include "shading/dfg.glsl"
#include "shading/lights/disk.glsl"
#include "shading/lights/isotropic_line.glsl"
#include "shading/lights/punctual.glsl"
#include "shading/lights/representative_point.glsl"
#include "shading/occlusion.glsl"
#include "shading/spherical_gaussian_lobe.glsl"
#include "shading/teaching_page.glsl"

using namespace candela;
using namespace candela::test;
using realtime::Aov;
using realtime::Profile;

namespace {

constexpr float kPi = 3.14159265f;
const glm::vec3 kUp(0.0f, 0.0f, 1.0f);

/// The middle of a plane that faces +Z, by lobe, cd/m^2.
struct Reading {
    glm::vec3 direct_diffuse, direct_specular, indirect_diffuse, indirect_specular;
    [[nodiscard]] glm::vec3 sum() const {
        return direct_diffuse + direct_specular + indirect_diffuse + indirect_specular;
    }
};

/// Seen under this angle to the normal, from -x. Validation is on and expected to be silent.
Reading read(const scene::Scene& scene, const Profile& profile, float view_deg, bool integrate = false) {
    const float t = view_deg * kPi / 180.0f;
    const scene::Camera camera =
        scene::look_at(3.0f * glm::vec3(-std::sin(t), 0.0f, std::cos(t)), {0, 0, 0}, 0.05f);
    realtime::RendererOptions o = options("best", 15, integrate ? 64 : 1);
    o.profile = profile;
    o.aovs = true;
    if (integrate) o.integrate.emplace();
    const gpu::Device device{validated()};
    realtime::Still still;
    {
        realtime::Renderer renderer(device, scene, o);
        still = renderer.render_still(camera, fixed_ev(8.0f));
    }
    EXPECT_TRUE(device.validation_messages().empty()) << device.validation_messages().front();
    const auto at = [&](Aov aov) {
        return glm::vec3(still.planes.aovs[std::size_t(aov)]
                                          [std::size_t{still.height / 2} * still.width + still.width / 2]);
    };
    return {at(Aov::direct_diffuse), at(Aov::direct_specular), at(Aov::indirect_diffuse),
            at(Aov::indirect_specular)};
}

Profile profile(const std::string& name, const std::string& slot = {}, const std::string& technique = {}) {
    Profile p = realtime::profile_by_name(name);
    if (!slot.empty()) realtime::set_technique(p, slot, technique, "test");
    return p;
}

scene::Material material(float metallic, float roughness, float base = 0.5f) {
    scene::Material m = grey(base);
    m.metallic = metallic;
    m.perceptual_roughness = roughness;
    m.specular = 1.0f;
    return m;
}

scene::Light sun_at(float angle_deg, scene::LightType type) {
    const float t = angle_deg * kPi / 180.0f;
    scene::Light light = sun(10000.0f);
    light.type = type;
    light.direction = -glm::vec3(std::sin(t), 0.0f, std::cos(t));
    light.right = {0.0f, 1.0f, 0.0f};
    light.visible = false;
    return light;
}

scene::Scene plane(const scene::Material& m) {
    return scene_of(square(0.5f), m);
}

}  // namespace

// Karis 2014, "Directional Light": with the energy of a lobe, and 4 times that as printed.
TEST(PaperTerms, TheMobileSunIsTheLobeOfPrefilteredEnvironments) {
    const float NoV = std::cos(40.0f * kPi / 180.0f);
    for (const scene::LightType type : {scene::LightType::directional, scene::LightType::sun}) {
        for (const float roughness : {0.3f, 0.7f}) {
            scene::Scene s = plane(material(1.0f, roughness, 0.8f));
            s.lights = {sun_at(50.0f, type)};
            const float RoL = std::cos(10.0f * kPi / 180.0f);
            const float weight = shading::EnvBRDFApprox(glm::vec3(0.8f), roughness, NoV).x;
            const float expected =
                10000.0f * weight * shading::D_Approx(roughness * roughness, RoL) / (4.0f * kPi);
            const float normalized = read(s, profile("mobile"), 40.0f).direct_specular.x;
            EXPECT_NEAR(normalized, expected, 0.01f * expected) << scene::name_of(type) << roughness;
            const float printed =
                read(s, profile("mobile", "sun-specular", "d-approx-printed"), 40.0f).direct_specular.x;
            EXPECT_NEAR(printed, 4.0f * normalized, 0.01f * printed);
            // Not the whole BRDF, which the slot still has.
            const float full = read(s, profile("mobile", "sun-specular", "full"), 40.0f).direct_specular.x;
            EXPECT_GT(std::abs(full / normalized - 1.0f), 0.03f);
        }
        scene::Scene s = plane(material(1.0f, 1.0f));
        s.lights = {sun_at(95.0f, type)};
        EXPECT_EQ(read(s, profile("mobile"), 40.0f).sum().x, 0.0f) << "below the horizon";
    }
}

// The whole of direct and environment light of `mobile` under a sun: its truth is the BSDF, not the lobe.
TEST(PaperTerms, IntegrateHasTheWholeBrdfOfTheSun) {
    scene::Scene s = plane(material(1.0f, 0.4f, 0.8f));
    s.lights = {sun_at(50.0f, scene::LightType::directional)};
    const float full = read(s, profile("mobile", "sun-specular", "full"), 40.0f).direct_specular.x;
    EXPECT_NEAR(read(s, profile("mobile"), 40.0f, true).direct_specular.x, full, 0.01f * full);
}

// Karis 2014: "Metallic and Specular material outputs aren't connected".
TEST(PaperTerms, TheFoldedFormIsForMaterialsWithDefaults) {
    const float NoV = std::cos(40.0f * kPi / 180.0f);
    const auto specular = [&](const scene::Material& m) {
        scene::Scene s = plane(m);
        s.environment = constant(1000.0f);
        s.environment->visible = false;
        return read(s, profile("mobile"), 40.0f).indirect_specular.x;
    };
    scene::Material m = material(0.0f, 0.5f);
    const float folded = 1000.0f * shading::env_brdf_approx_nonmetal(0.5f, NoV);
    EXPECT_NEAR(specular(m), folded, 0.005f * folded);
    // The same f0 by another way is no default.
    m.specular_color = glm::vec3(0.5f);
    m.ior = (1.0f + std::sqrt(0.08f)) / (1.0f - std::sqrt(0.08f));
    const float whole = 1000.0f * shading::EnvBRDFApprox(glm::vec3(0.04f), 0.5f, NoV).x;
    EXPECT_NEAR(specular(m), whole, 0.01f * whole);
    EXPECT_GT(std::abs(folded / whole - 1.0f), 0.015f);
}

TEST(PaperTerms, NoProfileReflectsLessThanNothing) {
    scene::Material m = material(0.0f, 1.0f, 0.0f);
    m.ior = 1.0f;  // f0 = 0, where EnvBRDFApprox is -0.0024 at roughness 1
    scene::Scene s = plane(m);
    s.environment = constant(1000.0f);
    s.environment->visible = false;
    s.lights = {sun_at(50.0f, scene::LightType::directional)};
    EXPECT_LT(shading::EnvBRDFApprox(glm::vec3(0.0f), 1.0f, 1.0f).x, 0.0f);
    for (const char* name : {"best", "frostbite", "ue4", "mobile"}) {
        const Reading r = read(s, profile(name), 10.0f);
        EXPECT_GE(r.indirect_specular.x, 0.0f) << name;
        EXPECT_GE(r.direct_specular.x, 0.0f) << name;
    }
}

// Karis 2013, equations 15 and 16, corrected: a line whose points shine alike in all directions, times
// what a lamp sends towards the middle of it.
TEST(PaperTerms, LinesAndTubesOfUe4AreKarissLines) {
    scene::Light light;
    light.type = scene::LightType::line;
    light.position = {0.9f, 0.2f, 0.5f};
    light.right = glm::normalize(glm::vec3(0.5f, 0.1f, 0.8f));
    light.direction = glm::normalize(glm::cross(light.right, glm::vec3(0, 1, 0)));
    light.half_width_m = 0.9f;  // an end below the horizon
    light.radius_m = 0.05f;
    light.intensity = 1000.0f;
    light.visible = false;
    scene::Scene s = plane(grey(0.5f));
    const glm::vec3 half = light.half_width_m * light.right;
    const float attenuation =
        shading::isotropic_line_attenuation(kUp, light.position - half, light.position + half, 1.0e-4f);
    s.lights = {light};
    const float sine = glm::length(glm::cross(light.right, glm::normalize(light.position)));
    const float line = 1000.0f * sine * attenuation * 0.5f / kPi;
    EXPECT_NEAR(read(s, profile("ue4"), 20.0f).direct_diffuse.x, line, 0.01f * line);
    s.lights[0].type = scene::LightType::tube;
    const float area_m2 = 0.05f * (4.0f * 0.9f * sine + kPi * 0.05f);
    const float tube = 1000.0f * area_m2 * attenuation * 0.5f / kPi;
    EXPECT_NEAR(read(s, profile("ue4"), 20.0f).direct_diffuse.x, tube, 0.01f * tube);
}

namespace {

scene::Light disk_light() {
    scene::Light light;
    light.type = scene::LightType::disk;
    light.position = {0.9f, 0.3f, 0.7f};
    light.direction = glm::normalize(-light.position);
    light.right = glm::normalize(glm::cross(light.direction, glm::vec3(0, 1, 0)));
    light.radius_m = 0.4f;
    light.intensity = 1000.0f;
    light.visible = false;
    return light;
}

}  // namespace

// Frostbite 4.7.4: "we use the light position as input for Disney's diffuse term".
TEST(PaperTerms, FrostbiteTakesDisneysDiffuseTowardsTheLightsPosition) {
    const scene::Light light = disk_light();
    scene::Scene s = plane(material(0.0f, 0.9f));
    s.lights = {light};
    const float t = 60.0f * kPi / 180.0f;
    const glm::vec3 v(-std::sin(t), 0.0f, std::cos(t));
    const glm::vec3 l = glm::normalize(light.position);
    const float LoH = glm::dot(l, glm::normalize(v + l));
    const float lx =
        1000.0f * shading::disk_projected_solid_angle_frostbite(kUp, light.position, light.direction, 0.4f);
    const float expected = lx * 0.5f * shading::Fd_DisneyRenormalized(v.z, l.z, LoH, 0.9f);
    EXPECT_NEAR(read(s, profile("frostbite"), 60.0f).direct_diffuse.x, expected, 0.003f * expected);
    const float other =
        read(s, profile("frostbite", "area-direction", "representative-point"), 60.0f).direct_diffuse.x;
    EXPECT_GT(std::abs(other / expected - 1.0f), 0.005f);
}

// Frostbite 4.7.5 has no normalization for disks and rectangles; the own one has its own name.
TEST(PaperTerms, FrostbitesFlatLightsHaveNoNormalization) {
    const float alpha = 0.09f;
    scene::Light light = disk_light();
    scene::Scene s = plane(material(1.0f, 0.3f, 0.8f));
    const auto own_over_printed = [&] {
        s.lights = {light};
        return read(s, profile("frostbite", "area-specular", "dominant-direction-normalized"), 50.0f)
                   .direct_specular.x /
               read(s, profile("frostbite"), 50.0f).direct_specular.x;
    };
    const float distance_m = glm::length(light.position);
    const float disk = shading::representative_point_sphere_normalization(alpha, 0.4f, distance_m);
    EXPECT_NEAR(own_over_printed(), disk, 0.02f * disk);
    light.type = scene::LightType::rectangle;
    light.half_width_m = 0.3f;
    light.half_height_m = 0.2f;
    const float flat = shading::representative_point_rectangle_normalization(alpha, 0.3f, 0.2f, distance_m);
    EXPECT_NEAR(own_over_printed(), flat, 0.02f * flat);
    light.type = scene::LightType::sphere;
    EXPECT_NEAR(own_over_printed(), 1.0f, 1e-3f) << "Karis's, with both";
}

// Frostbite listing 26, by the coat's own normal and width.
TEST(PaperTerms, ACoatIsOccludedByItsOwnRoughness) {
    scene::Material m = material(0.0f, 0.1f, 0.0f);
    m.specular = 0.0f;
    m.clearcoat.factor = 1.0f;
    m.clearcoat.perceptual_roughness = 0.5f;
    m.occlusion_texture.texture = 0;
    scene::Scene s = plane(m);
    s.images.push_back({"half", 1, 1, {128, 128, 128, 255}});
    s.textures.push_back({0, {}});
    s.environment = constant(1000.0f);
    s.environment->visible = false;
    const float over_smooth = read(s, profile("frostbite"), 75.0f).indirect_specular.x;
    s.materials[0].perceptual_roughness = 1.0f;
    EXPECT_NEAR(read(s, profile("frostbite"), 75.0f).indirect_specular.x, over_smooth, 0.002f * over_smooth);
    s.materials[0].occlusion_texture = {};
    const float open = read(s, profile("frostbite"), 75.0f).indirect_specular.x;
    EXPECT_NEAR(over_smooth / open, shading::specular_occlusion(0.2588f, 128.0f / 255.0f, 0.25f), 0.01f);
}

// The teaching page, section 3, items 2 and 5, word by word; corrected it is Karis 2013.
TEST(PaperTerms, LessonLiteralIsThePageAndLessonIsKaris) {
    constexpr float kRoughness = 0.4f;
    constexpr float kAlpha = kRoughness * kRoughness;
    const float t = 40.0f * kPi / 180.0f;
    const glm::vec3 v(-std::sin(t), 0.0f, std::cos(t));
    const glm::vec3 mirror(std::sin(t), 0.0f, std::cos(t));
    scene::Light light;
    light.type = scene::LightType::sphere;
    light.position = {0.9f, 0.3f, 0.8f};
    light.radius_m = 0.3f;
    light.intensity = 1000.0f;
    light.visible = false;
    const float distance_m = glm::length(light.position);
    const glm::vec3 to_light = light.position / distance_m;
    /// Specular light from l per lx.
    const auto lobe = [&](const glm::vec3& l) {
        const glm::vec3 h = glm::normalize(v + l);
        return shading::D_GGX(kUp, h, kAlpha) *
               shading::V_TeachingPage(v.z, shading::k_analytic(kRoughness)) *
               shading::F_SphericalGaussian(glm::vec3(0.8f), glm::dot(l, h)).x;
    };
    scene::Scene s = plane(material(1.0f, kRoughness, 0.8f));
    s.lights = {light};
    const float lx = 1000.0f * shading::sphere_projected_solid_angle_no_horizon(kUp, light.position, 0.3f);
    const float sphere =
        lx * lobe(shading::representative_direction_TeachingPage(to_light, v, mirror, 0.3f / distance_m));
    EXPECT_NEAR(read(s, profile("lesson-literal"), 40.0f).direct_specular.x, sphere, 0.01f * sphere);
    const float corrected = read(s, profile("lesson"), 40.0f).direct_specular.x;
    EXPECT_EQ(corrected, read(s, profile("ue4"), 40.0f).direct_specular.x);
    EXPECT_GT(std::abs(corrected / sphere - 1.0f), 0.1f);
    s.lights[0].type = scene::LightType::point;
    const float point = 1000.0f / (distance_m * distance_m + 1.0e-4f) * to_light.z * lobe(to_light);
    EXPECT_NEAR(read(s, profile("lesson-literal"), 40.0f).direct_specular.x, point, 0.01f * point);
    EXPECT_NEAR(read(s, profile("lesson-literal"), 40.0f, true).direct_specular.x, point, 0.01f * point);
}
