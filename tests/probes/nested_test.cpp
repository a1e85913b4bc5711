// Irradiance volumes within and beside one another.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "candela/truth/irradiance_bake.hpp"
#include "common/contact_scenes.hpp"
#include "realtime/render_scenes.hpp"
#include "shading/probes/volume.glsl"
#include "volume_scenes.hpp"

using namespace candela;
using namespace candela::test;

namespace {

constexpr float kQuarter_rad = 1.57079633f;
constexpr std::uint32_t kSize = 96;

/// With the same light from everywhere, and nothing in the way.
scene::IrradianceVolume uniform(float half_m, float fade_m, float nit) {
    scene::IrradianceVolume v = volume(glm::vec3(0.0f), glm::vec3(half_m), glm::ivec3(4), fade_m);
    scene::IrradianceProbe probe;
    probe.irradiance_sh[0] = glm::vec3(nit / 0.282094792f);
    const float far_m = 100.0f;
    probe.distances.assign(std::size_t(shading::kDistanceSize) * shading::kDistanceSize,
                           glm::vec2(far_m, far_m * far_m));
    probe.valid = true;
    v.probes.assign(v.probe_count(), probe);
    return v;
}

void fill(scene::Scene& s) {
    truth::IrradianceBakeOptions o;
    o.path.techniques = shading::techniques_best();
    o.samples = 256;
    s.irradiance_volumes = truth::bake_irradiance(s, o);
}

/// Red along the middle of a picture.
std::vector<float> middle_row(const scene::Scene& s, const scene::Camera& camera) {
    const gpu::Device device{validated()};
    std::vector<float> row;
    {
        realtime::Renderer renderer(device, s, options("best", kSize));
        const realtime::Still still = renderer.render_still(camera, fixed_ev(6.0f));
        for (std::uint32_t x = 0; x < kSize; ++x)
            row.push_back(still.planes.light_nit[std::size_t{kSize / 2} * kSize + x].x);
    }
    EXPECT_TRUE(device.validation_messages().empty()) << device.validation_messages().front();
    return row;
}

scene::Camera from_above(float width_m) {
    const float height_m = 3.0f;
    return scene::look_at({0, height_m, 0.001f}, {0, 0, 0}, 2.0f * std::atan(0.5f * width_m / height_m));
}

}  // namespace

// The smaller volume has all within its box, the larger one all beyond the fade, whatever their order in the
// scene; between there is a ramp and no step, and where the larger one ends another.
TEST(NestedVolumes, TheSmallerOneWinsWithinAndEndsSoftly) {
    scene::Scene s = ground(8.0f);
    s.environment = constant(50.0f);
    constexpr float width_m = 6.0f, fade_m = 0.5f, small_m = 0.75f, large_m = 1.75f;
    s.irradiance_volumes = {uniform(large_m, fade_m, 100.0f), uniform(small_m, fade_m, 300.0f)};
    const std::vector<float> row = middle_row(s, from_above(width_m));
    std::swap(s.irradiance_volumes[0], s.irradiance_volumes[1]);
    EXPECT_EQ(row, middle_row(s, from_above(width_m)));
    // What a uniform surrounding of 1 cd/m^2 shows on this floor.
    const float unit = row[1] / 50.0f;
    const float pixel_m = width_m / kSize;
    const auto x_m = [&](std::size_t i) { return std::abs((float(i) + 0.5f) * pixel_m - 0.5f * width_m); };
    for (std::size_t i = 0; i < row.size(); ++i) {
        const float seen = row[i] / unit;
        if (x_m(i) < small_m - pixel_m) {
            EXPECT_NEAR(seen, 300.0f, 9.0f) << x_m(i);
        } else if (x_m(i) > small_m + fade_m + pixel_m && x_m(i) < large_m - pixel_m) {
            EXPECT_NEAR(seen, 100.0f, 3.0f) << x_m(i);
        } else if (x_m(i) > large_m + fade_m + pixel_m) {
            EXPECT_NEAR(seen, 50.0f, 1.5f) << x_m(i);
        }
        // The steepest of a smoothstep over the fade.
        const float steepest = 1.5f * 200.0f * pixel_m / fade_m;
        if (i == 0) continue;
        EXPECT_LT(std::abs(row[i] - row[i - 1]) / unit, 1.1f * steepest) << x_m(i);
    }
}

// Both hold the light of the same room, baked: where one gives way to the other there is no line.
TEST(NestedVolumes, BakedInOneRoomTheyAgreeAtTheirBorder) {
    scene::Scene s;
    s.materials.push_back(grey(0.7f));
    for (const float side : {-1.0f, 1.0f}) {
        place(s, box({2.2f, 0.1f, 2.2f}), at({0, side * 1.6f, 0}));
        place(s, box({2.2f, 1.7f, 0.1f}), at({0, 0, side * 2.1f}));
        place(s, box({0.1f, 1.7f, 2.2f}), at({side * 2.1f, 0, 0}));
    }
    scene::Light lamp;
    lamp.position = {-0.8f, 0.6f, 0.4f};
    lamp.intensity = 100.0f;
    s.lights.push_back(lamp);
    const auto large = volume(glm::vec3(0.0f), {2.0f, 1.5f, 2.0f}, {5, 4, 5}, 0.25f);
    const auto small = volume({0.5f, -0.75f, 0.0f}, {0.7f, 0.75f, 0.7f}, {4, 4, 4}, 0.25f);
    const scene::Camera camera = scene::look_at({0, 1.3f, 0.001f}, {0, -1.5f, 0}, 1.1f);
    s.irradiance_volumes = {large};
    fill(s);
    const std::vector<float> alone = middle_row(s, camera);
    s.irradiance_volumes = {small, large};
    fill(s);
    const std::vector<float> nested = middle_row(s, camera);
    for (std::size_t i = 0; i < alone.size(); ++i) {
        // The finer one is nearer to the truth, by this at most.
        EXPECT_NEAR(nested[i] / alone[i], 1.0f, 0.2f) << i;
        if (i == 0) continue;
        const float ratio = (nested[i] / alone[i]) / (nested[i - 1] / alone[i - 1]);
        EXPECT_NEAR(ratio, 1.0f, 0.025f) << i;
    }
}

// A volume fades beyond its box, but not through the wall at which the box ends: a dark room beside a lit one
// has its own, and the lit room's is the smaller one, which is asked first.
TEST(NestedVolumes, ALitRoomsVolumeDoesNotFadeIntoTheDarkOneBesideIt) {
    scene::Scene s = bright_and_dark_room();
    s.irradiance_volumes = {volume({-1.015f, 0, 0}, {0.985f, 0.99f, 0.99f}, {4, 4, 4}, 0.25f),
                            volume({1.015f, 0, 0}, {0.985f, 1.0f, 1.0f}, {4, 4, 4}, 0.25f)};
    fill(s);
    const std::vector<float> lit = middle_row(s, scene::look_at({-1.8f, 0, 0}, {0, 0, 0}, 1.2f));
    const std::vector<float> dark = middle_row(s, scene::look_at({1.8f, 0, 0}, {0, 0, 0}, 1.2f));
    EXPECT_LT(dark[kSize / 2], 0.003f * lit[kSize / 2]);
}
