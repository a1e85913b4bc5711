#pragma once

#include <cstdint>
#include <functional>

#include "candela/bake/probe_filter.hpp"
#include "candela/realtime/renderer.hpp"

namespace candela::realtime {

struct ProbeCaptureOptions {
    Profile profile;
    ShadowOptions shadows;
    std::uint32_t passes = 3;  ///< light that a probe sees has met this many surfaces at most
    std::uint32_t face_texels = 128;
    std::function<void(double fraction)> progress;
};

/// Takes the pictures of a scene's reflection probes with the frame's own passes (Frostbite 4.9.1.2): without
/// specular light, metals diffuse with their f0 as albedo. In each pass every probe sees its surroundings in
/// the light that all probes gave after the pass before, so that their order is nothing; in the first, in
/// direct light and that of the irradiance volumes alone.
[[nodiscard]] std::vector<scene::ReflectionProbe> capture_reflection_probes(
    const gpu::Device& device, const scene::Scene& scene, const ProbeCaptureOptions& options);

/// The same without the filter: the pictures of the last pass. For figures and tests.
[[nodiscard]] std::vector<bake::ProbeFaces> capture_probe_faces(const gpu::Device& device,
                                                                const scene::Scene& scene,
                                                                const ProbeCaptureOptions& options);

}  // namespace candela::realtime
