// Real time, integrator and path tracer on the same scenes.
#include <gtest/gtest.h>

#include <fstream>
#include <glm/gtc/matrix_transform.hpp>

#include "candela/bake/environment.hpp"
#include "candela/io/environment_read.hpp"
#include "candela/io/gltf.hpp"
#include "candela/io/stage.hpp"
#include "candela/measure/comparison.hpp"
#include "candela/realtime/renderer.hpp"
#include "candela/truth/render_path.hpp"
#include "common/files.hpp"
#include "demo_scenes.hpp"

using namespace candela;
using namespace candela::test;

namespace {

struct Staged {
    scene::Scene scene;
    scene::Camera camera;
    scene::Exposure exposure;
};

Staged demo(void (*write)(const std::filesystem::path&), const std::string& name) {
    const TemporaryFolder folder;
    write(folder.path());
    Diagnostics diagnostics;
    Staged out;
    out.scene = io::load_gltf(folder / (name + ".glb"), {}, diagnostics);
    const io::Stage stage = io::load_stage(folder / (name + ".stage.json"));
    if (stage.environment && !stage.environment->none) {
        out.scene.environment = stage.environment->file.empty()
                                    ? bake::studio_environment()
                                    : io::read_environment(stage.environment->file, diagnostics);
    }
    out.camera = out.scene.cameras.front();
    out.exposure = stage.exposure;
    return out;
}

struct Rendered {
    measure::Picture picture;
    float exposure = 0.0f;
};

enum class Means : std::uint8_t { techniques, integrals, integrals_with_rays };

Rendered on_device(const Staged& s, Means means, std::uint32_t samples, glm::uvec2 size,
                   const realtime::Profile& profile = realtime::profile_by_name("best")) {
    const gpu::Device device{gpu::DeviceOptions{}};
    realtime::RendererOptions o;
    o.width = size.x;
    o.height = size.y;
    o.samples = samples;
    o.profile = profile;
    if (means != Means::techniques) o.integrate.emplace().ray_shadows = means == Means::integrals_with_rays;
    realtime::Renderer renderer(device, s.scene, o);
    const realtime::Still still = renderer.render_still(s.camera, s.exposure);
    Rendered out{{size.x, size.y, {}}, still.exposure};
    for (const glm::vec4& nit : still.planes.light_nit) out.picture.pixels.emplace_back(nit);
    return out;
}

measure::Picture by_path(const Staged& s, const truth::PathOptions& path, std::uint32_t samples,
                         glm::uvec2 size) {
    truth::PathRenderOptions o;
    o.path = path;
    o.path.techniques = shading::techniques_best();
    o.width = size.x;
    o.height = size.y;
    o.samples = samples;
    const auto team = truth::join_team();
    const truth::PathRender render = truth::render_path(s.scene, s.camera, o, *team);
    measure::Picture out{size.x, size.y, {}};
    for (std::uint32_t y = 0; y < size.y; ++y) {
        for (std::uint32_t x = 0; x < size.x; ++x) {
            const double* p = render.film.pixel(x, y);
            out.pixels.emplace_back(glm::vec3(p[0], p[1], p[2]) / static_cast<float>(samples));
        }
    }
    return out;
}

/// Mean of |a - b| over mean of b.
double relative_difference(const measure::Picture& a, const measure::Picture& b) {
    double difference = 0.0;
    double sum = 0.0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            difference += std::abs(static_cast<double>(a.pixels[i][c]) - static_cast<double>(b.pixels[i][c]));
            sum += static_cast<double>(b.pixels[i][c]);
        }
    }
    return difference / sum;
}

/// Means over blocks of 8 x 8 pixels: noise goes down, a wrong integral stays.
measure::Picture blocks(const measure::Picture& p) {
    measure::Picture out{p.width / 8, p.height / 8, {}};
    for (std::uint32_t by = 0; by < out.height; ++by) {
        for (std::uint32_t bx = 0; bx < out.width; ++bx) {
            glm::vec3 sum(0.0f);
            for (std::uint32_t i = 0; i < 64; ++i) {
                sum += p.pixels[std::size_t{by * 8 + i / 8} * p.width + bx * 8 + i % 8];
            }
            out.pixels.push_back(sum / 64.0f);
        }
    }
    return out;
}

truth::PathOptions without_shadows() {
    truth::PathOptions o;
    o.shadows = false;
    return o;
}

/// CI shows these lines; CTest hides what a test that passes prints.
void show(const std::string& scene, const std::string& line) {
    std::printf("%s\n", line.c_str());
    std::ofstream(std::string(FLIP_FOLDER) + "/flip_" + scene + ".txt") << line << "\n";
}

struct FlipCase {
    const char* name;
    void (*write)(const std::filesystem::path&);
    double integrate_bound;  ///< the integrator against path --direct-only
    double frame_bound;      ///< the real-time frame, `best`, against path --direct-only
};

/// Without it a test's name would have the bytes of its pointers.
void PrintTo(const FlipCase& c, std::ostream* out) {
    *out << c.name;
}

class SceneFlip : public testing::TestWithParam<FlipCase> {};

}  // namespace

// The same integral, drawn from the same densities, on the device and on the CPU. Lights: lights_test.cpp.
TEST(Agreement, IntegratorAndPathTracerFindTheSameLightOfAnEnvironment) {
    const Staged s = demo(scenes::write_sphere_grid, "sphere_grid");
    const glm::uvec2 size(160, 88);
    const measure::Picture device = blocks(on_device(s, Means::integrals, 64, size).picture);
    const measure::Picture path = blocks(by_path(s, without_shadows(), 256, size));
    const double difference = relative_difference(device, path);
    std::printf("difference %.4f\n", difference);
    EXPECT_LT(difference, 0.005);
}

// FLIP sees what a person sees at 67 pixels a degree. The bounds are what is known to be missing, plus a
// little: noise of the integrator, and of the frame no shadows of the environment and a split sum that does
// not stretch reflections.
TEST_P(SceneFlip, StaysWithinItsBound) {
    const FlipCase& c = GetParam();
    const Staged s = demo(c.write, c.name);
    const glm::uvec2 size(120, 68);
    truth::PathOptions direct;
    direct.direct_only = true;
    const measure::Picture path = by_path(s, direct, 128, size);
    const Rendered integrate = on_device(s, Means::integrals_with_rays, 32, size);
    const Rendered frame = on_device(s, Means::techniques, 4, size);
    measure::ComparisonOptions o;
    o.exposure = frame.exposure;
    const double integrate_flip = measure::compare(integrate.picture, path, o).metrics.flip;
    const double frame_flip = measure::compare(frame.picture, path, o).metrics.flip;
    char line[200];
    std::snprintf(
        line, sizeof(line),
        "FLIP against path --direct-only, %-12s integrate %.4f (bound %.3f), real time %.4f (bound %.3f)",
        c.name, integrate_flip, c.integrate_bound, frame_flip, c.frame_bound);
    show(c.name, line);
    EXPECT_LT(integrate_flip, c.integrate_bound);
    EXPECT_LT(frame_flip, c.frame_bound);
    EXPECT_GT(frame_flip, 0.0);
}

// Against the integrals without visibility, which is no matter of how the environment is read. What is left
// of the profile's error is that of its prefiltered maps.
TEST(Agreement, BestSeesTheEnvironmentBetterThanTheSplitSum) {
    const Staged s = demo(scenes::write_sphere_grid, "sphere_grid");
    const glm::uvec2 size(160, 90);
    const Rendered truth = on_device(s, Means::integrals, 64, size);
    measure::ComparisonOptions o;
    o.exposure = truth.exposure;
    const auto flip = [&](const char* reflection) {
        realtime::Profile profile = realtime::profile_by_name("best");
        if (reflection) realtime::set_technique(profile, "reflection", reflection, "test");
        return measure::compare(on_device(s, Means::techniques, 8, size, profile).picture, truth.picture, o)
            .metrics.flip;
    };
    const double best = flip(nullptr);
    const double karis = flip("mirror-direction");
    const double frostbite = flip("dominant-direction");
    std::printf("FLIP: best %.4f, listing 22 %.4f, mirror direction %.4f\n", best, frostbite, karis);
    EXPECT_LT(best, 0.8 * karis);
    EXPECT_LT(best, frostbite);
}

INSTANTIATE_TEST_SUITE_P(Demo, SceneFlip,
                         testing::Values(FlipCase{"sphere_grid", scenes::write_sphere_grid, 0.0155, 0.091},
                                         FlipCase{"still_life", scenes::write_still_life, 0.036, 0.158},
                                         FlipCase{"grey_card", scenes::write_grey_card, 0.017, 0.079}),
                         [](const auto& instance) { return std::string(instance.param.name); });
