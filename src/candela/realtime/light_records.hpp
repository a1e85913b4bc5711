#pragma once

#include <vector>

#include "candela/realtime/light_block.hpp"
#include "candela/realtime/packed_textures.hpp"

namespace candela::realtime {

/// Scene::lights as the mode `integrate` reads them, in the order of the scene. In LightBlock::links the
/// fourth number is the record of a profile (point, spot, frustum) or of an image (rectangle), or -1; a
/// disk's cone stays as light_block() has it; suns too small to have a disc are directional.
struct LightRecords {
    std::vector<LightBlock> lights;
    std::vector<Quad> profiles;     ///< first entry of `profile_cd`, width, height
    std::vector<float> profile_cd;  ///< layout: shading/lights/photometric.glsl
};
[[nodiscard]] LightRecords light_records(const scene::Scene& scene, PackedTextures& textures);

}  // namespace candela::realtime
