#pragma once

#include <vector>

#include "candela/realtime/ray_scene.hpp"

namespace candela::realtime {

/// What the mode `integrate` draws light from besides the environment. Lights without extent are few in most
/// scenes and exact when each is asked; when there are more than this, they are drawn from as the others are.
inline constexpr std::size_t kMostAskedLights = 16;

/// Lights and emissive triangles as shaders/emitters.glsl reads them.
struct Emitters {
    /// Lights that every sample asks: suns, directional lights and few lights without extent. One quad each:
    /// index into Scene::lights, 1 when it casts shadows.
    std::vector<Quad> asked;
    /// The tree over the others: three quads a node, one item a leaf.
    std::vector<Quad> nodes;
    /// One quad an item, in the order of the leaves: 0 for a light or 1 for a triangle, its index, 1 when it
    /// casts shadows.
    std::vector<Quad> items;
    std::vector<Quad> triangles;  ///< six quads each
};
[[nodiscard]] Emitters collect_emitters(const scene::Scene& scene, AlphaRecords& alphas,
                                        PackedTextures& textures);

}  // namespace candela::realtime
