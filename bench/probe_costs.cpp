// What local light costs a frame: two_rooms and cornell_room without it, with irradiance volumes, with
// reflection probes, and with both. Frames of the four are drawn in turn, so that what else the machine does
// falls on all alike.
//
//     cmake --preset release -Wno-dev -DCANDELA_BUILD_BENCH=ON
//     ninja -C build/release candela_probe_costs && build/release/bin/candela_probe_costs [FRAMES] [WIDTH
//     HEIGHT]
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "candela/io/gltf.hpp"
#include "candela/io/stage.hpp"
#include "candela/realtime/probe_capture.hpp"
#include "candela/truth/irradiance_bake.hpp"
#include "demo_scenes.hpp"

using namespace candela;

namespace {

/// What is in the probes changes nothing in what it takes to read them.
constexpr std::uint32_t kPaths = 16;
constexpr std::uint32_t kFaceTexels = 32;

double processor_ms() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto ms = [](const timeval& t) { return 1e3 * double(t.tv_sec) + 1e-3 * double(t.tv_usec); };
    return ms(usage.ru_utime) + ms(usage.ru_stime);
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

scene::Scene read_scene(void (*write)(const std::filesystem::path&), const std::string& name) {
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("candela_probe_costs_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    write(folder);
    Diagnostics diagnostics;
    scene::Scene s = io::load_gltf(folder / (name + ".glb"), {}, diagnostics);
    const io::Stage stage = io::load_stage(folder / (name + ".stage.json"));
    io::place_stage_probes(stage.probes, s);
    std::filesystem::remove_all(folder);
    return s;
}

/// A scene without reflection probes gets one that is its first volume's box.
void fill(const gpu::Device& device, scene::Scene& s, const realtime::Profile& profile) {
    if (s.reflection_probes.empty()) {
        const scene::IrradianceVolume& v = s.irradiance_volumes.front();
        scene::ReflectionProbe probe;
        probe.world = v.world;
        probe.half_size_m = v.half_size_m;
        probe.margin_m = 0.4f;
        probe.fade_m = 0.2f;
        s.reflection_probes.push_back(probe);
    }
    truth::IrradianceBakeOptions volumes;
    volumes.path.techniques = shading::techniques_best();
    volumes.samples = kPaths;
    s.irradiance_volumes = truth::bake_irradiance(s, volumes);
    realtime::ProbeCaptureOptions capture;
    capture.profile = profile;
    capture.face_texels = kFaceTexels;
    capture.passes = 1;
    s.reflection_probes = realtime::capture_reflection_probes(device, s, capture);
}

struct Mode {
    const char* name;
    bool volumes;
    bool probes;
    std::unique_ptr<realtime::Renderer> renderer;
    std::vector<double> frame_ms, lighting_ms, processor_ms;
};

void measure(const gpu::Device& device, const char* name, void (*write)(const std::filesystem::path&),
             int frames, const realtime::RendererOptions& options) {
    scene::Exposure exposure;
    exposure.ev100 = 4.88f;
    scene::Scene all = read_scene(write, name);
    fill(device, all, options.profile);
    std::vector<Mode> modes;
    for (const auto& [title, volumes, probes] :
         {std::tuple("none", false, false), std::tuple("volumes", true, false),
          std::tuple("reflection probes", false, true), std::tuple("both", true, true)}) {
        scene::Scene s = all;
        if (!volumes) s.irradiance_volumes.clear();
        if (!probes) s.reflection_probes.clear();
        modes.push_back(
            {title, volumes, probes, std::make_unique<realtime::Renderer>(device, s, options), {}, {}, {}});
    }
    for (int i = -1; i < frames; ++i) {
        for (Mode& m : modes) {
            const double processor = processor_ms();
            const auto start = std::chrono::steady_clock::now();
            const auto passes = m.renderer->render_frame(all.cameras.front(), exposure);
            const std::chrono::duration<double, std::milli> frame = std::chrono::steady_clock::now() - start;
            if (i < 0) continue;  // shadows are drawn once
            double lighting = 0.0;
            for (const gpu::PassTime& pass : passes)
                if (pass.name.starts_with("lighting")) lighting += pass.milliseconds;
            m.frame_ms.push_back(frame.count());
            m.lighting_ms.push_back(lighting);
            m.processor_ms.push_back(processor_ms() - processor);
        }
    }
    std::printf("%s, %ux%u, %zu volumes, %zu reflection probes, medians of %d frames\n", name, options.width,
                options.height, all.irradiance_volumes.size(), all.reflection_probes.size(), frames);
    std::printf("  %-18s %9s %12s %14s %10s\n", "local light", "frame ms", "lighting ms", "processor ms",
                "of none");
    const double none = median(modes.front().processor_ms);
    for (const Mode& m : modes)
        std::printf("  %-18s %9.1f %12.1f %14.1f %10.2f\n", m.name, median(m.frame_ms), median(m.lighting_ms),
                    median(m.processor_ms), median(m.processor_ms) / none);
}

}  // namespace

int main(int argc, char** argv) {
    const int frames = argc > 1 ? std::max(std::atoi(argv[1]), 1) : 15;
    realtime::RendererOptions options;
    options.profile = realtime::profile_by_name("best");
    options.half_light = true;
    if (argc > 3) {
        options.width = static_cast<std::uint32_t>(std::max(std::atoi(argv[2]), 16));
        options.height = static_cast<std::uint32_t>(std::max(std::atoi(argv[3]), 16));
    }
    const gpu::Device device{gpu::DeviceOptions{}};
    measure(device, "two_rooms", scenes::write_two_rooms, frames, options);
    measure(device, "cornell_room", scenes::write_room, frames, options);
    return 0;
}
