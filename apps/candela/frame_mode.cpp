#include "frame_mode.hpp"

#include <chrono>

#include "local_light.hpp"
#include "progress_line.hpp"

namespace candela::app {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

std::uint32_t default_samples(bool integrate) {
    return integrate ? 64 : 4;
}

FrameModeStill render_on_device(const gpu::Device& device, Job& job, const FrameModeOptions& options) {
    realtime::RendererOptions o;
    o.width = job.width;
    o.height = job.height;
    o.samples = options.samples;
    o.seed = options.seed;
    o.profile = job.profile;
    o.tone_curve = job.tone_curve;
    o.aovs = options.aovs;
    o.shadows = {options.shadows == Shadows::map, options.shadow_atlas_texels};
    if (options.integrate) o.integrate.emplace().ray_shadows = options.shadows == Shadows::ray;
    FrameModeStill out;
    const auto setup = Clock::now();
    if (!options.integrate) fill_local_light(device, job, o.shadows);
    ProgressLine line(options.label);
    o.progress = line.function();
    realtime::Renderer renderer(device, job.scene, o);
    out.setup_s = seconds_since(setup);
    const auto draw = Clock::now();
    out.still = renderer.render_still(job.camera, job.exposure);
    out.render_s = seconds_since(draw);
    out.unshadowed_lights = renderer.unshadowed_lights();
    return out;
}

}  // namespace candela::app
