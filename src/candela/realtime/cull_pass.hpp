#pragma once

#include <optional>

#include "candela/realtime/frame.hpp"

namespace candela::realtime {

/// Lights that lists can be made of: what fits the shared memory of shaders/cull_lights.comp.glsl. With more,
/// every point asks every light.
inline constexpr std::uint32_t kMostCulledLights = 65536;
/// Under this going through all of them costs less than the lists.
inline constexpr std::uint32_t kLeastCulledLights = 4;
/// Lights a list is expected to hold on average; when the lists of a picture hold more, those that find no
/// room are the list of all lights.
inline constexpr std::uint32_t kRoomForLights = 128;

/// Makes FrameResources::light_lists: the list of all lights, and room for those of the tiles and cells.
/// `wanted`: false leaves it at the list of all.
void create_light_lists(const gpu::Device& device, gpu::Commands& commands, const GpuScene& scene,
                        bool wanted, FrameResources& frame);

/// Between classify and lighting: which lights reach each tile of opaque surfaces and, where there are
/// blended surfaces, each cell of the space before the camera. No pass when no lists are made.
class CullPass {
  public:
    CullPass(const gpu::Device& device, const FrameResources& frame);
    /// The lists of lights.
    [[nodiscard]] gpu::BufferRef add(const FrameBuild& build, const Tiles& tiles) const;

  private:
    std::optional<gpu::ComputePipeline> tiles_;
    std::optional<gpu::ComputePipeline> cells_;
    mutable gpu::Buffer zero_;
};

}  // namespace candela::realtime
