#include "candela/realtime/frame.hpp"

#include "candela/realtime/classify_pass.hpp"
#include "candela/realtime/cull_pass.hpp"
#include "candela/realtime/forward_pass.hpp"
#include "candela/realtime/gbuffer_pass.hpp"
#include "candela/realtime/lighting_pass.hpp"
#include "candela/realtime/metering.hpp"
#include "candela/realtime/picture_pass.hpp"
#include "candela/realtime/shadow_pass.hpp"
#include "candela/realtime/shape_pass.hpp"

namespace candela::realtime {

LitSurfaces add_lit_surfaces(const FrameBuild& build, const FramePasses& passes, bool capture) {
    const gpu::ImageRef shadow_maps = passes.shadows.add_maps(build);
    Surfaces surfaces = passes.gbuffer.add(build);
    if (!capture) surfaces = passes.shapes.add(build, surfaces);
    const Tiles tiles = passes.classify.add(build, surfaces);
    const gpu::BufferRef light_lists = passes.cull.add(build, tiles);
    const gpu::BufferRef visibilities = passes.shadows.add_visibility(build, shadow_maps, surfaces);

    FrameBuild lighting = build;
    lighting.in.shadow_atlas = shadow_maps;
    lighting.in.light_lists = light_lists;
    lighting.in.visibilities = visibilities;
    Lit lit = passes.lighting.add(lighting, surfaces, tiles);
    lit = passes.forward.add(lighting, surfaces, lit);
    return {surfaces, lit};
}

void build_metered_frame(const FrameBuild& build, const FramePasses& passes, const MeteringPass& metering) {
    metering.add(build, add_lit_surfaces(build, passes, false).lit);
}

void build_still_sample(const FrameBuild& build, const FramePasses& passes, PicturePass& picture) {
    const LitSurfaces l = add_lit_surfaces(build, passes, false);
    picture.add(build, l.surfaces, l.lit);
}

void build_shown_frame(const FrameBuild& build, const FramePasses& passes, const MeteringPass* metering,
                       PresentPass& present) {
    const Lit lit = add_lit_surfaces(build, passes, false).lit;
    if (metering) metering->add(build, lit);
    present.add(build, lit);
}

gpu::ImageRef build_captured_view(const FrameBuild& build, const FramePasses& passes) {
    const gpu::ImageRef light = add_lit_surfaces(build, passes, true).lit.light;
    build.graph.keep(light);
    return light;
}

}  // namespace candela::realtime
