#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <set>
#include <vector>

#include "candela/realtime/packed_textures.hpp"
#include "candela/realtime/table_writer.hpp"
#include "candela/scene/scene.hpp"

/// The scene's triangles in world space: what the mode `integrate` traces rays through and draws light from.
namespace candela::realtime {

struct WorldTriangle {
    std::array<glm::vec3, 3> corners{};    ///< counter-clockwise seen from the front
    std::array<glm::vec3, 3> normals{};    ///< unit
    std::array<std::uint32_t, 3> index{};  ///< of the corners in the primitive
    const scene::Primitive* primitive = nullptr;
};

/// Every triangle of every instance whose material passes `wanted`.
[[nodiscard]] std::vector<WorldTriangle> world_triangles(const scene::Scene& scene,
                                                         bool (*wanted)(const scene::Material&));

/// Records of how much of a triangle light passes through; shared by occluders and emitters.
class AlphaRecords {
  public:
    AlphaRecords(const scene::Scene& scene, PackedTextures& textures)
        : scene_(&scene), textures_(&textures) {}

    /// kNoRecord for opaque triangles.
    [[nodiscard]] std::uint32_t record_of(const WorldTriangle& triangle);
    /// Three quads a record (shaders/tables.glsl: Alpha).
    [[nodiscard]] const std::vector<Quad>& quads() const noexcept { return quads_; }

  private:
    const scene::Scene* scene_;
    PackedTextures* textures_;
    std::vector<Quad> quads_;
};

/// Texture coordinates of the corners for this use of a texture.
[[nodiscard]] std::array<glm::vec2, 3> corner_uv(const WorldTriangle& triangle, const scene::TextureRef& ref);

/// Bounding volume hierarchies of all triangles (shaders/ray_scene.glsl): first that of the copied triangles
/// and that of the instances of shared primitives, then one a shared primitive.
struct RayScene {
    std::vector<Quad> nodes;      ///< two a node
    std::uint32_t top_nodes = 0;  ///< those of the first two
    std::vector<Quad> triangles;  ///< four a triangle, leaf by leaf
    std::vector<Quad> instances;  ///< kInstanceQuads each
};
inline constexpr std::size_t kInstanceQuads = 7;

/// `shared`: what scene::shared_primitives finds.
[[nodiscard]] RayScene build_ray_scene(const scene::Scene& scene, AlphaRecords& alphas,
                                       const std::set<const scene::Primitive*>& shared);

}  // namespace candela::realtime
