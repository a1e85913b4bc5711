#pragma once

#include <cstdint>
#include <span>

#include "candela/gpu/commands.hpp"
#include "candela/scene/scene.hpp"

namespace candela::realtime {

/// What a pipeline has to know of local light; kLocalLight of shaders/local_light.glsl.
enum LocalLightBit : std::uint32_t {
    local_probes = 1u << 0,
    local_volumes = 1u << 1,
    local_capture = 1u << 2,  ///< the picture is one that a probe takes
};

/// What shaders/local_light.glsl reads.
struct LocalLight {
    std::uint32_t bits = 0;  ///< LocalLightBit
    gpu::Buffer buffer;      ///< records of probes and volumes, harmonics, distances
    gpu::Image atlas;        ///< the probes' maps side by side; 1 x 1 without
};

/// Bits for a scene: probes count when they have their pictures, or are about to take them.
[[nodiscard]] std::uint32_t local_light_bits(const scene::Scene& scene, bool capture);

/// Fills `out.buffer` and `out.atlas`. Only probes with a capture are taken, and volumes with baked probes;
/// with local_capture no maps are uploaded, for such pictures show no reflections. Submits.
void upload_local_light(const gpu::Device& device, gpu::Commands& commands,
                        std::span<const scene::ReflectionProbe> probes,
                        std::span<const scene::IrradianceVolume> volumes, LocalLight& out);

}  // namespace candela::realtime
