#include "candela/realtime/shadow_views.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "candela/scene/camera.hpp"
#include "shading/basis.glsl"

namespace candela::realtime {
namespace {

/// Frostbite's smallest light, section 4.4.
constexpr float kPunctualNear_m = 0.01f;

/// Tangent of the half opening of the tile of a disk or a rectangle: 71.6 degrees. What shines flatter is a
/// tenth of its power.
constexpr float kAreaOpening = 3.0f;

glm::vec4 row(const glm::vec3& axis, const glm::vec3& origin) {
    return {axis, -glm::dot(axis, origin)};
}

glm::mat4 matrix_of_rows(const glm::vec4& x, const glm::vec4& y, const glm::vec4& z, const glm::vec4& w) {
    return {{x.x, y.x, z.x, w.x}, {x.y, y.y, z.y, w.y}, {x.z, y.z, z.z, w.z}, {x.w, y.w, z.w, w.w}};
}

glm::vec2 tile_center(const AtlasTile& tile) {
    const float half = 0.5f * static_cast<float>(tile.size);
    return {static_cast<float>(tile.x) + half, static_cast<float>(tile.y) + half};
}

glm::vec4 extent_of(const scene::Light& light) {
    glm::vec2 half_m(0.0f);
    switch (light.type) {
        case scene::LightType::sun:
            half_m = glm::vec2(std::tan(0.5f * light.angular_diameter_rad));
            break;
        case scene::LightType::sphere:
        case scene::LightType::disk:
            half_m = glm::vec2(light.radius_m);
            break;
        case scene::LightType::rectangle:
            half_m = {light.half_width_m, light.half_height_m};
            break;
        case scene::LightType::line:
            half_m = {light.half_width_m, 0.0f};
            break;
        case scene::LightType::tube:
            // The rectangle with the capsule's own outline area: half circles of radius r are as wide as pi r
            // / 4.
            half_m = {light.half_width_m + 0.785398f * light.radius_m, light.radius_m};
            break;
        default:
            break;
    }
    return {half_m, static_cast<float>(shadow_shape(light)), 0.0f};
}

/// x/tan, y/tan, near/z: depth is 1 at the near plane and 0 infinitely far.
glm::mat4 perspective(const glm::vec4& x, const glm::vec4& y, const glm::vec4& z, const glm::vec2& tangent,
                      float near) {
    return matrix_of_rows(x / tangent.x, y / tangent.y, {0.0f, 0.0f, 0.0f, near}, z);
}

LightViews pyramid(const scene::Light& light, const AtlasTile& tile) {
    glm::vec2 tangent(kAreaOpening);
    float light_depth = 0.0f;
    float near = kPunctualNear_m;
    if (light.type == scene::LightType::spot) {
        tangent = glm::vec2(std::tan(light.outer_cone_rad));
    } else if (light.type == scene::LightType::frustum) {
        tangent = {std::tan(0.5f * light.horizontal_angle_rad), std::tan(0.5f * light.vertical_angle_rad)};
    } else {
        // The centre of projection moves back until the pyramid holds the light (Frostbite 4.10.4, Figure
        // 69); what is behind the light's plane is in nobody's way.
        const float size = light.type == scene::LightType::disk
                               ? light.radius_m
                               : std::max(light.half_width_m, light.half_height_m);
        light_depth = size / kAreaOpening;
        near = light_depth + std::max(1e-3f * size, 1e-4f);
    }
    const float half = 0.5f * static_cast<float>(tile.size);
    // Two texels beyond the beam, for the filter.
    tangent = glm::max(tangent, glm::vec2(1e-4f)) * (half / (half - 2.0f));
    const glm::vec3 origin = light.position - light_depth * light.direction;
    ShadowRecord r{};
    r.right = row(light.right, origin);
    r.up = row(light.up(), origin);
    r.forward = row(light.direction, origin);
    r.texels = glm::vec4(half / tangent.x, half / tangent.y, tile_center(tile));
    r.numbers = glm::vec4(near, light_depth, half, std::max(tangent.x, tangent.y) / half);
    r.extent = extent_of(light);
    return {{r}, {{perspective(r.right, r.up, r.forward, tangent, near), tile}}};
}

LightViews cube(const scene::Light& light, const LightShadow& shadow) {
    // What is inside a sphere or tube belongs to the lamp. The corner of the near planes' cube touches it.
    const float near = std::max(kPunctualNear_m, 0.577f * light.radius_m);
    const float half = 0.5f * static_cast<float>(shadow.tiles[0].size);
    ShadowRecord r{};
    const std::array axes{row(light.right, light.position), row(light.up(), light.position),
                          row(light.direction, light.position)};
    r.right = axes[0];
    r.up = axes[1];
    r.forward = axes[2];
    r.texels = glm::vec4(half);
    r.numbers = glm::vec4(near, 0.0f, half, 1.0f / half);
    r.extent = extent_of(light);
    LightViews out;
    for (std::uint32_t face = 0; face < kCubeFaces; ++face) {
        const std::uint32_t axis = face / 2;
        const AtlasTile& tile = shadow.tiles[face];
        const std::uint32_t corner = tile.x / kShadowTileUnit | tile.y / kShadowTileUnit << 8;
        r.faces[static_cast<int>(axis)] |= corner << (16 * (face & 1));
        const glm::vec4 depth = (face & 1) ? -axes[axis] : axes[axis];
        out.views.push_back(
            {perspective(axes[(axis + 1) % 3], axes[(axis + 2) % 3], depth, glm::vec2(1.0f), near), tile});
    }
    out.records.push_back(r);
    return out;
}

struct Sphere {
    glm::vec3 center{0.0f};
    float radius = 0.0f;
};

/// Smallest sphere about the part of the view between two depths.
Sphere slice_sphere(const scene::Camera& any_camera, float aspect, float near, float far) {
    const scene::Camera camera = scene::fitted(any_camera, aspect);
    const glm::vec3 eye(camera.world[3]);
    const glm::vec3 view = -glm::normalize(glm::vec3(camera.world[2]));
    if (camera.projection == scene::Projection::orthographic) {
        const float depth = 0.5f * (far - near);
        return {eye + 0.5f * (near + far) * view,
                std::sqrt(depth * depth + camera.ymag_m * camera.ymag_m * (1.0f + aspect * aspect))};
    }
    const float t = std::tan(0.5f * camera.yfov_rad);
    const float k2 = t * t * (1.0f + aspect * aspect);
    const float middle = std::min(0.5f * (near + far) * (1.0f + k2), far);
    const float dn = middle - near;
    const float df = far - middle;
    return {eye + middle * view, std::sqrt(std::max(dn * dn + near * near * k2, df * df + far * far * k2))};
}

/// Slices nearer than this share of the farthest depth would take texels from rooms, whose walls may not
/// leak.
constexpr float kLeastSplit = 0.05f;

/// Depths between which the cascades end, in steps of a quarter octave. The first one begins at the nearest
/// that is visible.
glm::vec2 split_range(const glm::vec2& visible_m) {
    const float far = std::max(visible_m.y, 1e-3f);
    const float near = std::clamp(visible_m.x, far * kLeastSplit, far);
    return {std::exp2(std::floor(std::log2(near) * 4.0f) / 4.0f),
            std::exp2(std::ceil(std::log2(far) * 4.0f) / 4.0f)};
}

/// One for each time that the depth doubles: within it a texel is at most twice as large beside a pixel at
/// its near end as at its far end.
std::uint32_t cascade_count(const glm::vec2& range) {
    const long doublings = std::lround(std::ceil(std::log2(range.y / range.x) - 0.01f));
    return static_cast<std::uint32_t>(std::clamp(doublings, 1l, static_cast<long>(kCascades)));
}

/// Equal ratios of depth: texels grow as pixels do (Lloyd et al. 2006, logarithmic z-partitioning).
float split(const glm::vec2& range, std::uint32_t i, std::uint32_t count) {
    return range.x * std::pow(range.y / range.x, static_cast<float>(i) / static_cast<float>(count));
}

}  // namespace

ShadowShape shadow_shape(const scene::Light& light) {
    switch (light.type) {
        case scene::LightType::sun:
        case scene::LightType::sphere:
            return ShadowShape::facing_disc;
        case scene::LightType::disk:
            return ShadowShape::disc;
        case scene::LightType::rectangle:
            return ShadowShape::rectangle;
        case scene::LightType::line:
        case scene::LightType::tube:
            return ShadowShape::tube;
        default:
            return ShadowShape::point;
    }
}

LightViews local_views(const scene::Light& light, const LightShadow& shadow) {
    return shadow.kind == ShadowKind::cube ? cube(light, shadow) : pyramid(light, shadow.tiles[0]);
}

LightViews cascade_views(const scene::Light& light, const LightShadow& shadow, const scene::Camera& camera,
                         float aspect, const scene::Aabb& bounds, const glm::vec2& visible_m) {
    glm::vec3 right;
    glm::vec3 up;
    shading::orthonormal_basis(light.direction, right, up);
    const Sphere whole{0.5f * (bounds.min + bounds.max),
                       std::max(0.5f * glm::length(bounds.max - bounds.min), 1e-3f)};
    // Everything that casts a shadow is between these planes.
    const float first = glm::dot(whole.center, light.direction) - 1.001f * whole.radius;
    const float depth = 2.002f * whole.radius;
    const glm::vec2 range = split_range(visible_m);
    LightViews out;
    const std::uint32_t count = cascade_count(range);
    for (std::uint32_t i = 0; i < count; ++i) {
        Sphere sphere =
            slice_sphere(camera, aspect, i == 0 ? std::min(visible_m.x, range.x) : split(range, i, count),
                         split(range, i + 1, count));
        sphere.radius = std::exp2(std::ceil(std::log2(sphere.radius) * 8.0f) / 8.0f);
        const bool last = sphere.radius >= whole.radius;
        if (last) sphere = whole;
        const AtlasTile& tile = shadow.tiles[i];
        const float half = 0.5f * static_cast<float>(tile.size);
        // Room for the filter, for the way from a sphere's edge into the next cascade and for the snapping.
        const float radius = sphere.radius * 1.1f * half / (half - 4.0f);
        const float texel = radius / half;
        const float x = std::floor(glm::dot(sphere.center, right) / texel) * texel;
        const float y = std::floor(glm::dot(sphere.center, up) / texel) * texel;
        ShadowRecord r{};
        r.right = {right, -x};
        r.up = {up, -y};
        r.forward = {light.direction, -first};
        r.texels = glm::vec4(1.0f / texel, 1.0f / texel, tile_center(tile));
        r.numbers = glm::vec4(depth, 0.0f, half, texel);
        r.extent = extent_of(light);
        out.records.push_back(r);
        const glm::vec4 one(0.0f, 0.0f, 0.0f, 1.0f);
        out.views.push_back(
            {matrix_of_rows(r.right / radius, r.up / radius, one - r.forward / depth, one), tile});
        if (last) break;
    }
    for (std::size_t i = 0; i < out.records.size(); ++i)
        out.records[i].faces.w = static_cast<std::uint32_t>(out.records.size() - i);
    return out;
}

}  // namespace candela::realtime
