#include "candela/realtime/shadow_plan.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "shading/lights/units.glsl"

namespace candela::realtime {
namespace {

constexpr std::uint32_t kLargestTile = 2048;
constexpr std::uint32_t kLargestFace = 1024;
constexpr std::uint32_t kSmallestWanted = 512;  ///< a small picture still needs to see what touches

/// A pyramid with a wider half angle than 60 degrees wastes its texels on the middle.
constexpr float kWidestPyramid_rad = 1.0472f;

/// The nearest one, sooner the larger.
std::uint32_t power_of_two(float x) {
    return 1u << static_cast<std::uint32_t>(std::lround(std::log2(1.1f * std::max(x, 1.0f))));
}

/// Where the light's window closes, or the scene ends.
float reach_m(const scene::Light& light, const scene::Aabb& bounds) {
    float farthest = 0.0f;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 p{(corner & 1) ? bounds.max.x : bounds.min.x,
                          (corner & 2) ? bounds.max.y : bounds.min.y,
                          (corner & 4) ? bounds.max.z : bounds.min.z};
        farthest = std::max(farthest, glm::distance(p, light.position));
    }
    return std::max(std::min(light.range_m, farthest), 1e-3f);
}

/// How much of the picture's height the light's reach covers: 1 when the camera is inside it, 0 when it is
/// all behind the camera.
float screen_coverage(const scene::Light& light, float reach, const scene::Camera& camera) {
    const glm::vec3 way = light.position - glm::vec3(camera.world[3]);
    const float distance = glm::length(way);
    if (distance <= reach) return 1.0f;
    if (glm::dot(way, glm::normalize(glm::vec3(camera.world[2]))) > reach) return 0.0f;
    const float half_height = camera.projection == scene::Projection::perspective
                                  ? distance * std::tan(0.5f * camera.yfov_rad)
                                  : camera.ymag_m;
    return std::min(1.0f, reach / std::max(half_height, 1e-6f));
}

float luminous_intensity_cd(const scene::Light& light) {
    const float strength = light.intensity * std::max({light.color.r, light.color.g, light.color.b, 0.0f});
    switch (light.type) {
        case scene::LightType::sphere:
        case scene::LightType::disk:
            return strength * shading::disk_area(light.radius_m);
        case scene::LightType::rectangle:
            return strength * shading::rectangle_area(2.0f * light.half_width_m, 2.0f * light.half_height_m);
        case scene::LightType::tube:
            return strength * shading::tube_projected_area(light.radius_m, 2.0f * light.half_width_m);
        default:
            return strength;
    }
}

std::uint32_t even_bits(std::uint32_t x) {
    x &= 0x55555555u;
    x = (x | (x >> 1)) & 0x33333333u;
    x = (x | (x >> 2)) & 0x0f0f0f0fu;
    x = (x | (x >> 4)) & 0x00ff00ffu;
    return (x | (x >> 8)) & 0x0000ffffu;
}

std::uint64_t area(const ShadowRequest& r) {
    return std::uint64_t{shadow_tiles(r.kind)} * r.size * r.size;
}

std::uint64_t area(const std::vector<ShadowRequest>& requests) {
    std::uint64_t sum = 0;
    for (const ShadowRequest& r : requests) sum += area(r);
    return sum;
}

/// Cascades cover the picture: they shrink only to leave half of the atlas to lights that have nothing else.
void shrink_cascades(std::vector<ShadowRequest>& requests, std::uint64_t room) {
    const auto is_cascades = [](const ShadowRequest& r) { return r.kind == ShadowKind::cascades; };
    const bool alone = std::all_of(requests.begin(), requests.end(), is_cascades);
    const std::uint64_t most = area(requests) <= room || alone ? room : room / 2;
    std::uint64_t sum = 0;
    for (const ShadowRequest& r : requests) sum += is_cascades(r) ? area(r) : 0;
    for (; sum > most; sum /= 4) {
        for (ShadowRequest& r : requests)
            if (is_cascades(r)) r.size = std::max(r.size / 2, kShadowTileUnit);
    }
}

void shrink_others(std::vector<ShadowRequest>& requests, std::uint64_t room) {
    // Texels for what they cover; of two that have as many, the less important one goes first.
    const auto later = [](const ShadowRequest* a, const ShadowRequest* b) {
        const float x = static_cast<float>(a->size) * std::max(b->coverage, 1e-3f);
        const float y = static_cast<float>(b->size) * std::max(a->coverage, 1e-3f);
        return x != y ? x < y : a->importance > b->importance;
    };
    std::vector<ShadowRequest*> heap;
    for (ShadowRequest& r : requests)
        if (r.kind != ShadowKind::cascades && r.size > kShadowTileUnit) heap.push_back(&r);
    std::make_heap(heap.begin(), heap.end(), later);
    std::uint64_t sum = area(requests);
    while (sum > room && !heap.empty()) {
        std::pop_heap(heap.begin(), heap.end(), later);
        ShadowRequest& r = *heap.back();
        sum -= area(r);
        r.size /= 2;
        sum += area(r);
        if (r.size > kShadowTileUnit) {
            std::push_heap(heap.begin(), heap.end(), later);
        } else {
            heap.pop_back();
        }
    }
}

/// The last one to shrink may have made more room than was needed.
void grow_again(std::vector<ShadowRequest>& requests, const std::vector<ShadowRequest>& wanted,
                std::uint64_t room) {
    std::uint64_t sum = area(requests);
    for (std::size_t i = 0; i < requests.size(); ++i) {
        ShadowRequest& r = requests[i];
        while (r.kind != ShadowKind::cascades && r.size < wanted[i].size && sum + 3 * area(r) <= room) {
            sum += 3 * area(r);
            r.size *= 2;
        }
    }
}

}  // namespace

ShadowKind shadow_kind(const scene::Light& light) {
    if (scene::is_distant(light.type)) return ShadowKind::cascades;
    switch (light.type) {
        case scene::LightType::spot:
            return light.outer_cone_rad < kWidestPyramid_rad ? ShadowKind::perspective : ShadowKind::cube;
        case scene::LightType::frustum:
            return 0.5f * std::max(light.horizontal_angle_rad, light.vertical_angle_rad) < kWidestPyramid_rad
                       ? ShadowKind::perspective
                       : ShadowKind::cube;
        case scene::LightType::disk:
        case scene::LightType::rectangle:
            return light.two_sided ? ShadowKind::cube : ShadowKind::perspective;
        default:
            return ShadowKind::cube;
    }
}

std::uint32_t shadow_tiles(ShadowKind kind) {
    switch (kind) {
        case ShadowKind::cascades:
            return kCascades;
        case ShadowKind::cube:
            return kCubeFaces;
        default:
            return 1;
    }
}

std::vector<ShadowRequest> shadow_requests(const std::vector<scene::Light>& lights, const scene::Aabb& bounds,
                                           const scene::Camera& camera, std::uint32_t width,
                                           std::uint32_t height, float cascade_texels) {
    std::vector<ShadowRequest> requests;
    if (bounds.empty()) return requests;
    const auto pixels = static_cast<float>(std::max(width, height));
    for (std::uint32_t i = 0; i < lights.size(); ++i) {
        const scene::Light& light = lights[i];
        if (!light.casts_shadow || !(light.intensity > 0.0f)) continue;
        ShadowRequest r{i, shadow_kind(light), 0, std::numeric_limits<float>::infinity()};
        float texels = cascade_texels * std::max(pixels, static_cast<float>(kSmallestWanted));
        if (r.kind != ShadowKind::cascades) {
            const float reach = reach_m(light, bounds);
            const float coverage = screen_coverage(light, reach, camera);
            const float half_m = std::max(0.5f * reach, 0.01f);
            r.coverage = coverage;
            r.importance = coverage * luminous_intensity_cd(light) / (half_m * half_m);
            texels = coverage * pixels * (r.kind == ShadowKind::cube ? 0.5f : 1.0f);
        }
        r.size = std::clamp(power_of_two(texels), kSmallestWanted,
                            r.kind == ShadowKind::cube ? kLargestFace : kLargestTile);
        requests.push_back(r);
    }
    return requests;
}

ShadowPlan plan_shadows(std::vector<ShadowRequest> requests, std::uint32_t atlas_texels,
                        std::size_t most_lights) {
    ShadowPlan plan;
    std::stable_sort(requests.begin(), requests.end(), [](const ShadowRequest& a, const ShadowRequest& b) {
        return a.importance > b.importance;
    });
    atlas_texels = std::bit_floor(std::max(atlas_texels, kShadowTileUnit));
    const std::uint64_t room = std::uint64_t{atlas_texels} * atlas_texels;
    const std::size_t wanted = requests.size();
    requests.resize(std::min(wanted, most_lights));
    const std::vector<ShadowRequest> before = requests;
    shrink_cascades(requests, room);
    shrink_others(requests, room);
    grow_again(requests, before, room);
    while (!requests.empty() && area(requests) > room) requests.pop_back();
    plan.unshadowed = static_cast<std::uint32_t>(wanted - requests.size());
    if (requests.empty()) return plan;

    // Squares whose sides are powers of two, from large to small along the Z-order curve, leave no gaps.
    std::vector<std::size_t> order(requests.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return requests[a].size > requests[b].size; });
    std::uint64_t next = 0;
    std::uint32_t side = 0;
    plan.lights.resize(requests.size());
    for (const std::size_t i : order) {
        const ShadowRequest& r = requests[i];
        LightShadow& shadow = plan.lights[i];
        shadow = {r.light, r.kind, {}};
        for (std::uint32_t t = 0; t < shadow_tiles(r.kind); ++t) {
            const auto z = static_cast<std::uint32_t>(next / (kShadowTileUnit * kShadowTileUnit));
            AtlasTile& tile = shadow.tiles[t];
            tile = {even_bits(z) * kShadowTileUnit, even_bits(z >> 1) * kShadowTileUnit, r.size};
            next += std::uint64_t{r.size} * r.size;
            side = std::max({side, tile.x + r.size, tile.y + r.size});
        }
    }
    plan.atlas_texels = std::bit_ceil(side);
    return plan;
}

}  // namespace candela::realtime
