// The integrator and the path tracer light the same scene by every type of light.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "candela/realtime/renderer.hpp"
#include "candela/truth/render_path.hpp"
#include "common/scenes.hpp"

using namespace candela;
using namespace candela::test;
using scene::LightType;

namespace {

constexpr std::uint32_t kWidth = 96;
constexpr std::uint32_t kHeight = 64;
constexpr std::uint32_t kBlock = 16;

void place(scene::Scene& s, scene::Primitive p, const scene::Material& m, const glm::mat4& world) {
    const auto index = static_cast<std::uint32_t>(s.meshes.size());
    p.material = index;
    s.materials.push_back(m);
    s.meshes.push_back({"mesh", {std::move(p)}});
    s.instances.push_back({"instance", index, world});
}

scene::Material glossy(float metallic, float roughness) {
    scene::Material m = grey(std::pow(800.0f / 1023.0f, 2.0f));
    m.metallic = metallic;
    m.perceptual_roughness = roughness;
    m.specular = 1.0f;
    return m;
}

/// A glossy and a rough ball on a floor, z up, under a screen that hides a part.
scene::Scene balls() {
    scene::Scene s;
    const glm::mat4 one(1.0f);
    place(s, square(6.0f), glossy(0.0f, 2048.0f / 4095.0f), one);
    place(s, sphere(0.5f), glossy(1.0f, 1229.0f / 4095.0f), glm::translate(one, {-0.6f, 0.0f, 0.5f}));
    place(s, sphere(0.5f), grey(0.5f), glm::translate(one, {0.6f, 0.0f, 0.5f}));
    scene::Material screen = grey(0.0f);
    screen.double_sided = true;
    place(s, square(0.3f), screen, glm::translate(one, {0.5f, -0.2f, 1.3f}));
    return s;
}

scene::Camera viewer() {
    return scene::look_at({0.0f, -4.0f, 2.4f}, {0.0f, 0.0f, 0.4f}, 0.5f);
}

using Blocks = std::vector<glm::dvec3>;

template <class PixelNit>
Blocks blocks(PixelNit&& nit) {
    Blocks out(std::size_t{kWidth / kBlock} * (kHeight / kBlock), glm::dvec3(0.0));
    for (std::uint32_t y = 0; y < kHeight; ++y) {
        for (std::uint32_t x = 0; x < kWidth; ++x) {
            out[std::size_t{y / kBlock} * (kWidth / kBlock) + x / kBlock] += glm::dvec3(nit(x, y));
        }
    }
    return out;
}

Blocks integrated(const scene::Scene& s, bool rays) {
    gpu::DeviceOptions validated;
    validated.validation = true;
    const gpu::Device device{validated};
    realtime::RendererOptions o;
    o.width = kWidth;
    o.height = kHeight;
    o.samples = 32;
    o.profile = realtime::profile_by_name("best");
    o.integrate.emplace();
    o.integrate->ray_shadows = rays;
    scene::Exposure exposure;
    exposure.ev100 = 10.0f;
    realtime::Still still;
    {
        realtime::Renderer renderer(device, s, o);
        still = renderer.render_still(viewer(), exposure);
    }
    EXPECT_TRUE(device.validation_messages().empty()) << device.validation_messages().front();
    return blocks([&](std::uint32_t x, std::uint32_t y) {
        return glm::dvec3(glm::vec3(still.planes.light_nit[std::size_t{y} * kWidth + x]));
    });
}

Blocks traced(const scene::Scene& s, bool rays) {
    truth::PathRenderOptions o;
    o.path.techniques = shading::techniques_best();
    o.path.direct_only = true;
    o.path.shadows = rays;
    o.width = kWidth;
    o.height = kHeight;
    o.samples = 256;
    const auto team = truth::join_team();
    const truth::PathRender render = truth::render_path(s, viewer(), o, *team);
    return blocks([&](std::uint32_t x, std::uint32_t y) {
        const double* p = render.film.pixel(x, y);
        return glm::dvec3(p[0], p[1], p[2]) / static_cast<double>(o.samples);
    });
}

/// Mean of |a - b| over mean of b.
double relative_difference(const Blocks& a, const Blocks& b) {
    double difference = 0.0;
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            difference += std::abs(a[i][c] - b[i][c]);
            sum += b[i][c];
        }
    }
    return difference / sum;
}

scene::Light light_of(LightType type, const glm::vec3& at = {0.9f, -0.9f, 2.2f}) {
    scene::Light light;
    light.type = type;
    light.position = at;
    light.direction = glm::normalize(glm::vec3(0.0f, 0.0f, 0.3f) - at);
    light.right = glm::normalize(glm::cross(light.direction, glm::vec3(0.3f, 1.0f, 0.0f)));
    light.color = {1.0f, 0.8f, 0.6f};
    light.intensity = 1000.0f;
    light.range_m = 6.0f;
    light.inner_cone_rad = 0.2f;
    light.outer_cone_rad = 0.5f;
    light.horizontal_angle_rad = 0.8f;
    light.vertical_angle_rad = 0.4f;
    light.angular_diameter_rad = 0.2f;
    light.limb_darkening = true;
    light.radius_m = 0.25f;
    light.half_width_m = 0.4f;
    light.half_height_m = 0.2f;
    light.visible = false;
    return light;
}

void expect_agreement(const scene::Scene& s, const std::string& what) {
    for (const bool rays : {false, true}) {
        const double difference = relative_difference(integrated(s, rays), traced(s, rays));
        std::printf("%-28s %s %.4f\n", what.c_str(), rays ? "ray " : "none", difference);
        EXPECT_LT(difference, 0.005) << what << (rays ? " with" : " without") << " shadows";
    }
}

class LightAgreement : public testing::TestWithParam<LightType> {};

}  // namespace

TEST_P(LightAgreement, OnGlossyAndRoughSurfaces) {
    scene::Scene s = balls();
    s.lights = {light_of(GetParam())};
    expect_agreement(s, scene::name_of(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Each, LightAgreement,
                         testing::Values(LightType::point, LightType::spot, LightType::directional,
                                         LightType::frustum, LightType::line, LightType::sun,
                                         LightType::sphere, LightType::disk, LightType::rectangle,
                                         LightType::tube),
                         [](const auto& instance) { return std::string(scene::name_of(instance.param)); });

namespace {

/// 8 x 8 squares, of alpha 255 and 0 in turn, bright and dim.
scene::Image chequers() {
    scene::Image image{"chequers", 8, 8, {}};
    for (std::uint32_t i = 0; i < 64; ++i) {
        const bool on = (i % 8 + i / 8) % 2 == 0;
        for (int c = 0; c < 3; ++c) image.rgba.push_back(on ? 255 : 60);
        image.rgba.push_back(on ? 255 : 0);
    }
    return image;
}

}  // namespace

// A lamp with a picture, a mask and a pane in the light of the sky: whatever shadows can be made of.
TEST(LightAgreement, OfEmissiveMeshesMasksAndPanes) {
    scene::Scene s = balls();
    s.images.push_back(chequers());
    s.textures.push_back({0, {}});
    scene::Material lamp = grey(0.0f);
    lamp.emissive_nit = {3000.0f, 2000.0f, 1000.0f};
    lamp.emissive_texture.texture = 0;
    const glm::mat4 hung = glm::translate(glm::mat4(1.0f), {1.2f, -0.6f, 2.0f});
    place(s, square(0.4f), lamp, glm::rotate(hung, 2.7f, glm::vec3(0.3f, 1.0f, 0.0f)));
    scene::Material leaves = grey(0.3f);
    leaves.double_sided = true;
    leaves.alpha_mode = scene::AlphaMode::mask;
    leaves.base_color_texture.texture = 0;
    s.materials[3] = leaves;
    scene::Material pane = grey(0.2f);
    pane.double_sided = true;
    pane.alpha_mode = scene::AlphaMode::blend;
    pane.base_color.a = 0.6f;
    place(s, square(0.4f), pane, glm::translate(glm::mat4(1.0f), {-0.7f, 0.1f, 1.4f}));
    s.environment = constant(20.0f);
    s.environment->visible = false;
    expect_agreement(s, "emissive, mask, pane, sky");
}
