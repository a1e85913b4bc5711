#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "candela/gpu/frame_graph/frame_graph.hpp"
#include "candela/realtime/frame_resources.hpp"

namespace candela::realtime {

class ShadowPass;
class GBufferPass;
class ShapePass;
class ClassifyPass;
class CullPass;
class LightingPass;
class ForwardPass;
class MeteringPass;
class PicturePass;
class PresentPass;

/// What changes from one execution of a frame's graph to the next, beside the frame block.
struct FrameView {
    const scene::Camera* camera = nullptr;
    float nit_per_unit = 1.0f;  ///< of the light buffer, in a still
    bool first_sample = true;   ///< of a still
    float exposure_change =
        1.0f;  ///< from the light buffer's exposure to the picture's, in a frame that is shown
};

/// What a frame reads that lives longer than it.
struct FrameInputs {
    gpu::BufferRef vertices;
    gpu::BufferRef indices;
    gpu::BufferRef lights;
    gpu::BufferRef light_reaches;
    gpu::BufferRef light_tables;
    gpu::BufferRef light_lists;
    gpu::BufferRef integrate_tables;
    gpu::BufferRef local_light;
    gpu::ImageRef local_atlas;
    gpu::ImageRef dfg;
    gpu::ImageRef ltc;
    gpu::ImageRef environment_specular;
    gpu::ImageRef environment_irradiance;
    gpu::ImageRef environment_background;
    gpu::BufferRef shadow_records;
    gpu::ImageRef shadow_atlas;  ///< reversed depth, one tile a view of a light
    gpu::BufferRef
        visibilities;  ///< a byte a pixel and light: tiles of 64 bytes, of one light after the other
    gpu::ImageRef no_layers;
    gpu::ImageRef no_normals;
};

/// What a pass is declared with. All of it outlives the graph.
struct FrameBuild {
    gpu::FrameGraph& graph;
    FrameResources& frame;
    GpuScene& scene;
    const FrameView& view;
    FrameInputs in;

    [[nodiscard]] gpu::ImageDesc image(VkFormat format) const { return {frame.width, frame.height, format}; }
};
[[nodiscard]] FrameInputs import_inputs(gpu::FrameGraph& graph, FrameResources& frame, GpuScene& scene);
/// Declares that a pass reads what shading_bindings() names.
void read_shading_inputs(gpu::PassBuilder& pass, const FrameInputs& in);

/// The G-buffer, and what its pass and that of the lights' shapes give to the light buffer at once.
struct Surfaces {
    gpu::ImageRef gbuffer;
    gpu::ImageRef layers;  ///< FrameInputs::no_layers without FrameResources::all_targets
    gpu::ImageRef ids;     ///< version 0: none
    gpu::ImageRef
        normals;  ///< octahedral, of the vertices alone; FrameInputs::no_normals without normal maps
    gpu::ImageRef depth;
    gpu::ImageRef
        light;  ///< pre-exposed; alpha: the fraction of a pixel that unlit surfaces leave; version 0: not yet
    gpu::ImageRef
        unlit;  ///< their colours, display-linear, times the rest; 1 x 1 without unlit and blended draws
};

struct Tiles {
    gpu::BufferRef lists;  ///< of each shading class, with the arguments of its dispatch
    gpu::BufferRef
        bounds;  ///< lowest and highest corner of what is in each tile; a word when nothing is culled
};

/// Surfaces that are lit.
struct Lit {
    gpu::ImageRef light;
    gpu::ImageRef unlit;
    std::array<gpu::ImageRef, kAovCount> aovs;  ///< 1 x 1 without AOVs; the first kLightingAovs are written
};

/// The passes of all frames of a renderer; picture and present are made when they are needed.
struct FramePasses {
    ShadowPass& shadows;
    const GBufferPass& gbuffer;
    const ShapePass& shapes;
    const ClassifyPass& classify;
    const CullPass& cull;
    const LightingPass& lighting;
    ForwardPass& forward;
};

/// From the scene to the light of each pixel, as every frame begins. `capture`: as a probe sees it, without
/// the shapes of lights.
struct LitSurfaces {
    Surfaces surfaces;
    Lit lit;
};
[[nodiscard]] LitSurfaces add_lit_surfaces(const FrameBuild& build, const FramePasses& passes, bool capture);

/// The frame that is metered: its histogram (exposure_meter.hpp).
void build_metered_frame(const FrameBuild& build, const FramePasses& passes, const MeteringPass& metering);
/// A sample of a still, added to its sums.
void build_still_sample(const FrameBuild& build, const FramePasses& passes, PicturePass& picture);
/// A frame that is shown: lit, metered for the next one, tone mapped.
void build_shown_frame(const FrameBuild& build, const FramePasses& passes, const MeteringPass* metering,
                       PresentPass& present);
/// What a probe sees through its camera; the light buffer is kept.
[[nodiscard]] gpu::ImageRef build_captured_view(const FrameBuild& build, const FramePasses& passes);

}  // namespace candela::realtime
