#pragma once

#include <cstdint>
#include <optional>

#include "candela/gpu/commands.hpp"
#include "candela/realtime/profile.hpp"
#include "candela/scene/scene.hpp"
#include "candela/scene/shared_primitives.hpp"

/// The mode `integrate`: the lighting and the forward pass run shaders/integrate.glsl instead of the
/// profile's techniques. Here is what they need beside the frame.
namespace candela::realtime {

/// Which of the two ways to draw directions towards lights with extent are used. Each alone converges to the
/// same integral, slower. The numbers are those of shaders/integrate.glsl.
enum class Strategy : std::uint8_t { both, light, bsdf };

struct IntegrateOptions {
    Strategy strategy = Strategy::both;
    std::uint32_t draws = 4;   ///< of each strategy in a sample of a pixel
    bool ray_shadows = false;  ///< light is what reaches the surface, past the triangles of the scene
    /// Beyond so many triangles of copies, instances share trees (scene/shared_primitives.hpp).
    std::size_t max_copied_triangles = scene::kMaxCopiedTriangles;
};

/// Draws for the one frame that the exposure is metered from: the mean of logarithms is lower than the
/// logarithm of the mean, so the frame must not be noisy.
inline constexpr std::uint32_t kMeterDraws = 16;

/// The integrand of a profile: its BSDF without the techniques that only approximate integrals. The DFG table
/// stays, for energy compensation, and pixels' footprints are supersampled.
[[nodiscard]] Profile integrand(Profile profile);

/// What shaders/tables.glsl reads: the environment's distribution, the emitters and, for ray shadows, the
/// scene's triangles.
struct IntegrateTables {
    gpu::Buffer buffer;
    std::uint32_t variant =
        0;  ///< kIntegrate of shaders/integrate.glsl: the strategy and what there is to find
};
/// Throws Error (Fault::machine) when the tables are more than the device can bind. Without options: an empty
/// header.
[[nodiscard]] IntegrateTables upload_integrate_tables(const gpu::Device& device, gpu::Commands& commands,
                                                      const scene::Scene& scene,
                                                      const std::optional<IntegrateOptions>& options);

}  // namespace candela::realtime
