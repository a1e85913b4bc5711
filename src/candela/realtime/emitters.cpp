#include "candela/realtime/emitters.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/packing.hpp>

#include "candela/realtime/box_tree.hpp"
#include "shading/lights/emission_cone.glsl"
#include "shading/octahedral.glsl"
#include "shading/transfer.glsl"

namespace candela::realtime {
namespace {

using scene::LightType;

struct Bounds {
    scene::Aabb box;
    shading::EmissionCone cone{{0.0f, 0.0f, 1.0f}, -1.0f, 0.0f, false};
    float power = 0.0f;  ///< cd at most in any direction
    float range_m = 0.0f;
};

struct Candidate {
    Bounds bounds;
    Quad item;
};

bool always_asked(LightType type) {
    return scene::is_distant(type);
}
bool without_extent(LightType type) {
    return type == LightType::point || type == LightType::spot || type == LightType::frustum;
}

/// About a segment of this half length along `axis`, and a ball of this radius at each of its points.
scene::Aabb capsule_box(const glm::vec3& center, const glm::vec3& axis, float half_length_m, float radius_m) {
    const glm::vec3 reach = glm::abs(axis) * half_length_m + glm::vec3(radius_m);
    scene::Aabb box;
    box.extend(center - reach);
    box.extend(center + reach);
    return box;
}

float cos_of_widest_ray(const scene::Light& light) {
    const float h = std::tan(0.5f * light.horizontal_angle_rad);
    const float v = std::tan(0.5f * light.vertical_angle_rad);
    return 1.0f / std::sqrt(1.0f + h * h + v * v);
}

Bounds bounds_of(const scene::Light& light, const scene::Scene& scene) {
    const float strength = light.intensity * shading::luminance(light.color);
    const float r = light.radius_m;
    Bounds b;
    b.range_m = light.range_m;
    b.power = strength;
    b.box.extend(light.position);
    const auto facing = [&](float cos_emission) {
        b.cone = {light.direction, 1.0f, cos_emission, light.two_sided};
    };
    switch (light.type) {
        case LightType::spot:
            facing(std::cos(light.outer_cone_rad));
            break;
        case LightType::frustum:
            facing(cos_of_widest_ray(light));
            break;
        case LightType::line:
            b.box = capsule_box(light.position, light.right, light.half_width_m, 0.0f);
            break;
        case LightType::sphere:
            b.box = capsule_box(light.position, light.right, 0.0f, r);
            b.power = strength * shading::PI * r * r;
            break;
        case LightType::tube:
            b.box = capsule_box(light.position, light.right, light.half_width_m, r);
            b.power = strength * r * (shading::PI * r + 4.0f * light.half_width_m);
            break;
        case LightType::disk: {
            const glm::vec3 reach =
                r * glm::sqrt(glm::max(glm::vec3(1.0f) - light.direction * light.direction, 0.0f));
            b.box.extend(light.position - reach);
            b.box.extend(light.position + reach);
            b.power = strength * shading::PI * r * r;
            facing(0.0f);
            break;
        }
        case LightType::rectangle: {
            const glm::vec3 reach =
                glm::abs(light.right) * light.half_width_m + glm::abs(light.up()) * light.half_height_m;
            b.box.extend(light.position - reach);
            b.box.extend(light.position + reach);
            b.power = strength * 4.0f * light.half_width_m * light.half_height_m;
            facing(0.0f);
            break;
        }
        default:
            break;
    }
    if (without_extent(light.type) && light.profile < scene.profiles.size()) {
        float most = 0.0f;
        for (const float cd : scene.profiles[light.profile].candela) most = std::max(most, cd);
        b.power *= most;
    }
    return b;
}

void collect_lights(const scene::Scene& scene, Emitters& out, std::vector<Candidate>& candidates) {
    const auto few = std::count_if(scene.lights.begin(), scene.lights.end(), [](const scene::Light& light) {
                         return without_extent(light.type);
                     }) <= static_cast<std::ptrdiff_t>(kMostAskedLights);
    for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
        const scene::Light& light = scene.lights[i];
        if (!(light.intensity > 0.0f)) continue;
        const std::uint32_t shadows = light.casts_shadow ? 1u : 0u;
        if (always_asked(light.type) || (few && without_extent(light.type))) {
            out.asked.push_back({i, shadows, 0, 0});
        } else {
            candidates.push_back({bounds_of(light, scene), {0, i, shadows, 0}});
        }
    }
}

bool emissive(const scene::Material& m) {
    return !m.unlit && m.emissive_nit != glm::vec3(0.0f);
}

/// A picture's mean over the triangle, from four points of it.
float mean_nit(const scene::Scene& scene, const scene::Material& m, const std::array<glm::vec2, 3>& uv) {
    const float whole = shading::luminance(m.emissive_nit);
    if (m.emissive_texture.texture >= scene.textures.size()) return whole;
    const std::uint32_t index = scene.textures[m.emissive_texture.texture].image;
    if (index >= scene.images.size() || scene.images[index].rgba.empty()) return whole;
    const scene::Image& image = scene.images[index];
    constexpr std::array<std::array<float, 2>, 4> at{
        {{1.0f / 3, 1.0f / 3}, {1.0f / 6, 1.0f / 6}, {2.0f / 3, 1.0f / 6}, {1.0f / 6, 2.0f / 3}}};
    glm::vec3 sum(0.0f);
    for (const auto& [u, v] : at) {
        glm::vec2 p = uv[0] * (1.0f - u - v) + uv[1] * u + uv[2] * v;
        p -= glm::floor(p);
        const auto column =
            std::min(static_cast<std::uint32_t>(p.x * static_cast<float>(image.width)), image.width - 1);
        const auto row =
            std::min(static_cast<std::uint32_t>(p.y * static_cast<float>(image.height)), image.height - 1);
        const std::uint8_t* t = image.rgba.data() + (std::size_t{row} * image.width + column) * 4;
        sum += 0.25f * shading::linear_from_srgb(glm::vec3(t[0], t[1], t[2]) / 255.0f);
    }
    // What those points missed must still be drawn now and then.
    return std::max(shading::luminance(m.emissive_nit * sum), 0.01f * whole);
}

void collect_triangles(const scene::Scene& scene, AlphaRecords& alphas, PackedTextures& textures,
                       Emitters& out, std::vector<Candidate>& candidates) {
    for (const WorldTriangle& t : world_triangles(scene, emissive)) {
        const scene::Material& m = scene.materials[t.primitive->material];
        const auto uv = corner_uv(t, m.emissive_texture);
        const glm::vec3 normal = glm::cross(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0]);
        const float area2 = glm::length(normal);
        if (!std::isfinite(area2) || !(area2 > 0.0f)) continue;
        Candidate c;
        for (const glm::vec3& corner : t.corners) c.bounds.box.extend(corner);
        c.bounds.cone = {normal / area2, 1.0f, 0.0f, m.double_sided};
        c.bounds.power = 0.5f * area2 * mean_nit(scene, m, uv);
        c.bounds.range_m = std::numeric_limits<float>::infinity();
        c.item = {1, static_cast<std::uint32_t>(out.triangles.size() / 6), 1, 0};
        candidates.push_back(c);
        out.triangles.push_back(quad(t.corners[0], textures.record_of(m.emissive_texture)));
        out.triangles.push_back(quad(t.corners[1], alphas.record_of(t)));
        out.triangles.push_back(quad(t.corners[2], m.double_sided ? 1u : 0u));
        out.triangles.push_back(quad(m.emissive_nit, 0));
        out.triangles.push_back(quad(uv[0], uv[1]));
        out.triangles.push_back(quad(uv[2], glm::vec2(0.0f)));
    }
}

Bounds unite(const Bounds& a, const Bounds& b) {
    Bounds out = a;
    out.box.extend(b.box);
    out.cone = shading::unite_cones(a.cone, b.cone);
    out.power += b.power;
    out.range_m = std::max(a.range_m, b.range_m);
    return out;
}

constexpr std::uint32_t kLeafBit = 0x80000000u;
constexpr std::uint32_t kTwoSidedBit = 0x40000000u;

/// Children come after their parents, so that bounds are united from the back.
void write_nodes(const BoxTree& tree, const std::vector<Candidate>& candidates, Emitters& out) {
    std::vector<Bounds> bounds(tree.nodes.size());
    for (std::size_t i = tree.nodes.size(); i-- > 0;) {
        const BoxTree::Node& node = tree.nodes[i];
        bounds[i] = node.count ? candidates[tree.order[node.first]].bounds
                               : unite(bounds[i + 1], bounds[tree.nodes[i + 1].skip]);
    }
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
        const BoxTree::Node& node = tree.nodes[i];
        const Bounds& b = bounds[i];
        const std::uint32_t flags = (node.count ? kLeafBit : 0u) | (b.cone.two_sided ? kTwoSidedBit : 0u);
        out.nodes.push_back(quad(b.box.min, node.skip));
        out.nodes.push_back(quad(b.box.max, node.first | flags));
        out.nodes.push_back({word(b.power), word(std::min(b.range_m, 1e18f)),
                             glm::packSnorm2x16(shading::octahedral_encode(b.cone.axis)),
                             glm::packSnorm2x16({b.cone.cos_normals, b.cone.cos_emission})});
    }
    for (const std::uint32_t i : tree.order) out.items.push_back(candidates[i].item);
}

}  // namespace

Emitters collect_emitters(const scene::Scene& scene, AlphaRecords& alphas, PackedTextures& textures) {
    Emitters out;
    std::vector<Candidate> candidates;
    collect_lights(scene, out, candidates);
    collect_triangles(scene, alphas, textures, out, candidates);
    std::vector<scene::Aabb> boxes;
    for (const Candidate& c : candidates) {
        boxes.push_back(c.bounds.power > 0.0f && std::isfinite(c.bounds.power) ? c.bounds.box
                                                                               : scene::Aabb{});
    }
    write_nodes(build_box_tree(boxes, 1), candidates, out);
    return out;
}

}  // namespace candela::realtime
