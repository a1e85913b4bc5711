#pragma once

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "candela/scene/light.hpp"
#include "candela/scene/material.hpp"
#include "candela/scene/photometric.hpp"
#include "candela/scene/probe.hpp"
#include "candela/scene/world_frame.hpp"

/// What is shown: plain data in physical units. 1 unit = 1 m, right-handed, +Y up, cameras look down -Z (as
/// glTF).
namespace candela::scene {

struct Aabb {
    glm::vec3 min{std::numeric_limits<float>::infinity()};
    glm::vec3 max{-std::numeric_limits<float>::infinity()};
    [[nodiscard]] bool empty() const noexcept { return !(min.x <= max.x); }
    void extend(const glm::vec3& p);
    void extend(const Aabb& other);
};

/// Triangles. Every attribute is either empty or has one entry per position; normals are always there after
/// loading.
struct Primitive {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;   ///< unit length
    std::vector<glm::vec4> tangents;  ///< xyz unit length, w = +-1 handedness (bitangent = w * cross(n, t))
    std::array<std::vector<glm::vec2>, 2> uv;
    std::vector<glm::vec4> colors;       ///< linear RGBA
    std::vector<std::uint32_t> indices;  ///< triangle list, each < positions.size()
    std::uint32_t material = no_index;   ///< index into Scene::materials, always valid after loading
    Aabb bounds;
};

enum class StrokeKind : std::uint8_t { points, lines };

/// Points or lines of a file: they have no width of their own. widen_strokes() (strokes.hpp) makes triangles
/// of them for one camera; until then nothing draws them.
struct Stroke {
    StrokeKind kind = StrokeKind::lines;
    Primitive geometry;  ///< its indices: a point each, or two ends of a segment each
};

struct Mesh {
    std::string name;
    std::vector<Primitive> primitives;
    std::vector<Stroke> strokes;
};

struct Instance {
    std::string name;               ///< of the node
    std::uint32_t mesh = no_index;  ///< index into Scene::meshes
    glm::mat4 world{1.0f};          ///< may mirror (negative determinant): winding then flips
};

/// Where a named node is: what a stage can attach a light to.
struct Node {
    std::string name;
    glm::mat4 world{1.0f};
};

enum class Projection : std::uint8_t { perspective, orthographic };

struct Camera {
    std::string name;
    glm::mat4 world{1.0f};  ///< camera to world, no scale
    Projection projection = Projection::perspective;
    float yfov_rad =
        0.6911f;  ///< vertical; 35 mm lens on a 24 mm high sensor is 0.6503, glTF viewers use about 0.7
    float aspect = 0.0f;  ///< width / height of the author's viewport; 0 = whatever the picture has
    float ymag_m = 1.0f;  ///< orthographic half height
    float xmag_m = 1.0f;
    float znear_m = 0.01f;
    float zfar_m = std::numeric_limits<float>::infinity();
};

/// Distant light as luminance: equirectangular, linear Rec.709, cd/m^2 per channel, row 0 at the zenith (+Y).
/// The image centre looks down -Z, the left quarter down -X (shading/environment.glsl: equirect_uv).
struct Environment {
    std::string name;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<glm::vec3> luminance_nit;  ///< width * height
    float scale = 1.0f;                    ///< multiplies luminance_nit
    float rotation_rad = 0.0f;             ///< about +Y, counter-clockwise seen from above
    bool visible = true;                   ///< drawn as background
};

/// How the picture is exposed; exactly one way applies, in this order: ev100, the three of the camera,
/// automatic.
struct Exposure {
    std::optional<float> ev100;
    std::optional<float> aperture_f;  ///< N of f/N
    std::optional<float> shutter_s;
    std::optional<float> iso;
    float compensation_ev = 0.0f;  ///< Frostbite equation 68: positive brightens
    [[nodiscard]] bool automatic() const noexcept { return !ev100 && !(aperture_f && shutter_s && iso); }
};

struct Scene {
    std::string name;
    WorldFrame frame;  ///< of every position and length below
    std::vector<Image> images;
    std::vector<Texture> textures;
    std::vector<Material> materials;
    std::vector<Mesh> meshes;
    std::vector<Instance> instances;
    std::vector<Light> lights;
    std::vector<PhotometricProfile> profiles;  ///< Light::profile points here
    std::vector<Camera> cameras;
    std::vector<Node> nodes;  ///< those that have a name
    std::optional<Environment> environment;
    std::vector<ReflectionProbe> reflection_probes;    ///< the smallest first
    std::vector<IrradianceVolume> irradiance_volumes;  ///< the smallest first
    Exposure exposure;
};

/// Bounds of a box whose corners were transformed.
[[nodiscard]] Aabb transformed(const Aabb& bounds, const glm::mat4& matrix);

/// World-space bounds of every instance; empty() when nothing is drawn.
[[nodiscard]] Aabb world_bounds(const Scene& scene);

[[nodiscard]] std::size_t triangle_count(const Scene& scene);

/// A camera that sees all of `bounds` from the front right, a little from above; 50 mm lens on 36x24 mm.
[[nodiscard]] Camera frame_bounds(const Aabb& bounds, float aspect);

/// Rotation and place of a node without its scale and without mirroring: how lights and cameras stand.
[[nodiscard]] glm::mat4 rigid_part(const glm::mat4& world);

/// Camera at `from`, looking at `at`, +Y up (+Z where the view is along Y). yfov_rad in (0, pi).
[[nodiscard]] Camera look_at(const glm::vec3& from, const glm::vec3& at, float yfov_rad);

/// Vertical field of view in rad of a lens of focal_mm on a sensor 24 mm high.
[[nodiscard]] float yfov_from_focal_mm(float focal_mm);

/// World to clip: Vulkan clip space, reversed depth (near 1, far 0), y down. `aspect` = width / height of the
/// picture.
[[nodiscard]] glm::mat4 view_projection(const Camera& camera, float aspect);

}  // namespace candela::scene
