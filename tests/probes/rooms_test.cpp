#include <gtest/gtest.h>

#include "candela/io/gltf.hpp"
#include "candela/io/stage.hpp"
#include "candela/measure/comparison.hpp"
#include "candela/realtime/probe_capture.hpp"
#include "candela/truth/irradiance_bake.hpp"
#include "candela/truth/render_path.hpp"
#include "common/files.hpp"
#include "demo_scenes.hpp"
#include "realtime/render_scenes.hpp"
#include "shading/exposure.glsl"

using namespace candela;
using namespace candela::test;

namespace {

constexpr float kEv100 = 4.88f;

scene::Scene read_demo(void (*write)(const std::filesystem::path&), const std::string& name) {
    const TemporaryFolder folder;
    write(folder.path());
    Diagnostics diagnostics;
    scene::Scene s = io::load_gltf(folder / (name + ".glb"), {}, diagnostics);
    io::place_stage_probes(io::load_stage(folder / (name + ".stage.json")).probes, s);
    return s;
}

measure::Picture truth_of(const scene::Scene& s, std::uint32_t width, std::uint32_t height) {
    truth::PathRenderOptions o;
    o.path.techniques = shading::techniques_best();
    o.width = width;
    o.height = height;
    o.samples = 64;
    const auto team = truth::join_team();
    const truth::Film film = truth::render_path(s, s.cameras.front(), o, *team).film;
    measure::Picture out{width, height, {}};
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            const double* p = film.pixel(x, y);
            const double n = film.tile_of(x, y).samples;
            out.pixels.emplace_back(p[0] / n, p[1] / n, p[2] / n);
        }
    }
    return out;
}

measure::Picture frame_of(const gpu::Device& device, const scene::Scene& s, std::uint32_t width,
                          std::uint32_t height) {
    realtime::RendererOptions o = options("best", width, 4);
    o.height = height;
    realtime::Renderer renderer(device, s, o);
    const realtime::Still still = renderer.render_still(s.cameras.front(), fixed_ev(kEv100));
    measure::Picture out{width, height, {}};
    for (const glm::vec4& t : still.planes.light_nit) out.pixels.emplace_back(t);
    return out;
}

double flip(const measure::Picture& frame, const measure::Picture& truth) {
    measure::ComparisonOptions o;
    o.exposure = shading::exposure_from_ev100(kEv100);
    return measure::compare(frame, truth, o).metrics.flip;
}

void fill(scene::Scene& s) {
    truth::IrradianceBakeOptions o;
    o.path.techniques = shading::techniques_best();
    o.samples = 256;
    s.irradiance_volumes = truth::bake_irradiance(s, o);
}

}  // namespace

// With an irradiance volume a Cornell room stays within FLIP 0.08 of the path tracer's, whose noise
// is in it.
TEST(Rooms, ACornellRoomIsNearTheTruth) {
    scene::Scene s = read_demo(scenes::write_room, "cornell_room");
    const gpu::Device device{gpu::DeviceOptions{}};
    const measure::Picture truth = truth_of(s, 96, 96);
    EXPECT_GT(flip(frame_of(device, s, 96, 96), truth), 0.15) << "without the volume";
    fill(s);
    EXPECT_LT(flip(frame_of(device, s, 96, 96), truth), 0.1);
}

TEST(Rooms, TwoRoomsWithAPolishedFloorAreNearTheTruth) {
    scene::Scene s = read_demo(scenes::write_two_rooms, "two_rooms");
    const gpu::Device device{gpu::DeviceOptions{}};
    const measure::Picture truth = truth_of(s, 128, 72);
    fill(s);
    const double without = flip(frame_of(device, s, 128, 72), truth);
    realtime::ProbeCaptureOptions capture;
    capture.profile = realtime::profile_by_name("best");
    s.reflection_probes = realtime::capture_reflection_probes(device, s, capture);
    const double with = flip(frame_of(device, s, 128, 72), truth);
    EXPECT_LT(with, without);
    EXPECT_LT(with, 0.12);
}
