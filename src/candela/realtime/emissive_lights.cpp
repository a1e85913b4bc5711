#include "candela/realtime/emissive_lights.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>

#include "candela/realtime/light_list.hpp"
#include "shading/transfer.glsl"

namespace candela::realtime {
namespace {

constexpr float kPi = 3.14159265f;

/// A triangle that glows, counter-clockwise seen from its front.
struct Piece {
    std::array<glm::vec3, 3> corners;
    glm::vec3 nit;
    bool two_sided = false;
    [[nodiscard]] glm::vec3 vector_area() const {
        return 0.5f * glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    }
    [[nodiscard]] glm::vec3 centroid() const { return (corners[0] + corners[1] + corners[2]) / 3.0f; }
};

glm::vec2 transformed(const scene::TextureRef& ref, const glm::vec2& uv) {
    const float c = std::cos(ref.rotation_rad);
    const float s = std::sin(ref.rotation_rad);
    const glm::vec2 scaled = uv * ref.scale;
    return ref.offset + glm::vec2(c * scaled.x + s * scaled.y, c * scaled.y - s * scaled.x);
}

glm::vec3 texel(const scene::Image& image, const glm::vec2& uv) {
    const auto at = [](float x, std::uint32_t size) {
        const float wrapped = x - std::floor(x);
        return std::min(static_cast<std::uint32_t>(wrapped * static_cast<float>(size)), size - 1);
    };
    const std::size_t first = (std::size_t{at(uv.y, image.height)} * image.width + at(uv.x, image.width)) * 4;
    const auto code = [&](std::size_t c) { return static_cast<float>(image.rgba[first + c]) / 255.0f; };
    return shading::linear_from_srgb(glm::vec3(code(0), code(1), code(2)));
}

/// Mean of the emissive texture over a triangle, by 64 points on a grid of its barycentric coordinates.
glm::vec3 mean_emission(const scene::Scene& scene, const scene::Primitive& p, const scene::Material& material,
                        std::size_t first_index) {
    const scene::TextureRef& ref = material.emissive_texture;
    if (!ref || ref.texture >= scene.textures.size() || p.uv[ref.uv_set & 1u].empty())
        return material.emissive_nit;
    const std::uint32_t image = scene.textures[ref.texture].image;
    if (image >= scene.images.size() || scene.images[image].rgba.empty()) return material.emissive_nit;
    constexpr int steps = 8;
    glm::vec3 sum(0.0f);
    for (int i = 0; i < steps * steps; ++i) {
        float b = (static_cast<float>(i % steps) + 0.5f) / steps;
        float c = (static_cast<float>(i / steps) + 0.5f) / steps;
        if (b + c > 1.0f) b = 1.0f - b, c = 1.0f - c;
        const auto uv = [&](std::size_t corner) {
            return p.uv[ref.uv_set & 1u][p.indices[first_index + corner]];
        };
        sum += texel(scene.images[image], transformed(ref, (1.0f - b - c) * uv(0) + b * uv(1) + c * uv(2)));
    }
    return material.emissive_nit * sum / static_cast<float>(steps * steps);
}

/// The glowing triangles of every instance of a primitive, each a part of its own; `found` then has of each
/// where it is from.
std::vector<std::vector<Piece>> collect_parts(const scene::Scene& scene,
                                              std::vector<EmissiveSurface>* found = nullptr) {
    std::vector<std::vector<Piece>> parts;
    for (std::uint32_t index = 0; index < scene.instances.size(); ++index) {
        const scene::Instance& instance = scene.instances[index];
        const bool mirrored = glm::determinant(glm::mat3(instance.world)) < 0.0f;
        for (const scene::Primitive& p : scene.meshes[instance.mesh].primitives) {
            const scene::Material& material = scene.materials[p.material];
            if (material.unlit || material.emissive_nit == glm::vec3(0.0f)) continue;
            std::vector<Piece> part;
            for (std::size_t i = 0; i + 2 < p.indices.size(); i += 3) {
                Piece piece;
                for (std::size_t c = 0; c < 3; ++c) {
                    const glm::vec4 position(p.positions[p.indices[i + c]], 1.0f);
                    piece.corners[c] = glm::vec3(instance.world * position);
                }
                if (mirrored) std::swap(piece.corners[1], piece.corners[2]);
                piece.nit = mean_emission(scene, p, material, i);
                piece.two_sided = material.double_sided;
                if (glm::length(piece.vector_area()) > 0.0f && piece.nit != glm::vec3(0.0f))
                    part.push_back(piece);
            }
            if (part.empty()) continue;
            if (found != nullptr) found->push_back({index, p.material, part.size()});
            parts.push_back(std::move(part));
        }
    }
    return parts;
}

EmissiveLight light_of(scene::Light light, const glm::vec3& nit) {
    light.color = nit;
    light.intensity = 1.0f;
    light.visible = false;  // the surface itself is
    return {light_block(light), light};
}

/// The rectangle that two neighbouring triangles of a list make: the second has the first one's longest side.
std::optional<EmissiveLight> rectangle_of(const Piece& a, const Piece& b) {
    if (a.nit != b.nit || a.two_sided != b.two_sided) return std::nullopt;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::vec3 corner = a.corners[i];
        const glm::vec3 x = a.corners[(i + 1) % 3] - corner;
        const glm::vec3 y = a.corners[(i + 2) % 3] - corner;
        const float width_m = glm::length(x);
        const float height_m = glm::length(y);
        const float tolerance_m = 1e-4f * (width_m + height_m);
        if (std::abs(glm::dot(x, y)) > 1e-4f * width_m * height_m) continue;
        const std::array<glm::vec3, 3> others{corner + x, corner + x + y, corner + y};
        // The same turn, from any corner.
        for (std::size_t turn = 0; turn < 3; ++turn) {
            bool same = true;
            for (std::size_t c = 0; c < 3; ++c)
                same &= glm::length(b.corners[(c + turn) % 3] - others[c]) < tolerance_m;
            if (!same) continue;
            scene::Light light;
            light.type = scene::LightType::rectangle;
            light.position = corner + 0.5f * (x + y);
            light.direction = glm::normalize(glm::cross(x, y));
            light.right = y / height_m;
            light.half_width_m = 0.5f * height_m;
            light.half_height_m = 0.5f * width_m;
            light.two_sided = a.two_sided;
            return light_of(light, a.nit);
        }
    }
    return std::nullopt;
}

LightBlock triangle_block(const Piece& piece) {
    constexpr int two_sided = 1;
    LightBlock block;
    block.position_range = glm::vec4(piece.corners[0], 1e18f);
    block.direction_a = glm::vec4(piece.corners[1], 0.0f);
    block.right_b = glm::vec4(piece.corners[2], 0.0f);
    block.color_type = glm::vec4(piece.nit, static_cast<float>(LightKind::triangle));
    block.links = glm::ivec4(piece.two_sided ? two_sided : 0, -1, -1, 0);
    return block;
}

std::vector<EmissiveLight> pieces_of(const std::vector<Piece>& part) {
    std::vector<EmissiveLight> lights;
    for (std::size_t i = 0; i < part.size(); ++i) {
        const std::optional<EmissiveLight> rectangle =
            i + 1 < part.size() ? rectangle_of(part[i], part[i + 1]) : std::nullopt;
        lights.push_back(rectangle ? *rectangle : EmissiveLight{triangle_block(part[i]), std::nullopt});
        if (rectangle) ++i;
    }
    return lights;
}

/// Sums over a group. Of two-sided pieces both sides count, and their normals cancel.
struct Group {
    std::vector<Piece> pieces;
    float area_m2 = 0.0f;
    glm::vec3 vector_area{0.0f};
    glm::vec3 nit{0.0f};     ///< mean over the area
    glm::vec3 center{0.0f};  ///< mean over the area
    glm::vec3 half_extent{0.0f};

    explicit Group(std::vector<Piece> from) : pieces(std::move(from)) {
        scene::Aabb bounds;
        for (const Piece& piece : pieces) {
            const glm::vec3 vector = piece.vector_area();
            const float area = glm::length(vector) * (piece.two_sided ? 2.0f : 1.0f);
            area_m2 += area;
            if (!piece.two_sided) vector_area += vector;
            nit += area * piece.nit;
            center += area * piece.centroid();
            for (const glm::vec3& corner : piece.corners) bounds.extend(corner);
        }
        nit /= area_m2;
        center /= area_m2;
        half_extent = 0.5f * (bounds.max - bounds.min);
    }
    /// Far longer than a sphere of its area.
    [[nodiscard]] bool is_long() const {
        const float radius_m = std::sqrt(area_m2 / (4.0f * kPi));
        return pieces.size() > 1 &&
               std::max(half_extent.x, std::max(half_extent.y, half_extent.z)) > 2.5f * radius_m;
    }
};

std::pair<Group, Group> halves(Group group) {
    const glm::vec3& h = group.half_extent;
    const int axis = h.x >= std::max(h.y, h.z) ? 0 : h.y >= h.z ? 1 : 2;
    const auto middle = group.pieces.begin() + static_cast<std::ptrdiff_t>(group.pieces.size() / 2);
    std::nth_element(
        group.pieces.begin(), middle, group.pieces.end(),
        [axis](const Piece& a, const Piece& b) { return a.centroid()[axis] < b.centroid()[axis]; });
    std::vector<Piece> second(middle, group.pieces.end());
    group.pieces.erase(middle, group.pieces.end());
    return {Group(std::move(group.pieces)), Group(std::move(second))};
}

void add_group(const Group& group, std::vector<EmissiveLight>& lights) {
    constexpr float negligible = 0.02f;
    const float front_m2 = glm::length(group.vector_area);
    const float rest_m2 = group.area_m2 - front_m2;
    scene::Light light;
    light.position = group.center;
    if (front_m2 > negligible * group.area_m2) {
        light.type = scene::LightType::disk;
        light.direction = group.vector_area / front_m2;
        light.radius_m = std::sqrt(front_m2 / kPi);
        const glm::vec3 aside = std::abs(light.direction.x) < 0.5f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
        light.right = glm::normalize(glm::cross(aside, light.direction));
        lights.push_back(light_of(light, group.nit));
    }
    if (rest_m2 > negligible * group.area_m2) {
        light.type = scene::LightType::sphere;
        light.radius_m = std::sqrt(rest_m2 / (4.0f * kPi));
        lights.push_back(light_of(light, group.nit));
    }
}

/// Each group makes two lights at most.
std::vector<EmissiveLight> grouped(std::vector<std::vector<Piece>> parts) {
    constexpr std::size_t most_groups = kMostEmissivePieces / 2;
    std::vector<Group> groups;
    if (parts.size() > most_groups) {
        std::vector<Piece> all;
        for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
        parts = {std::move(all)};
    }
    for (auto& part : parts) groups.emplace_back(std::move(part));
    while (groups.size() < most_groups) {
        const auto longest =
            std::max_element(groups.begin(), groups.end(), [](const Group& a, const Group& b) {
                const auto weight = [](const Group& g) {
                    return g.is_long() ? glm::length(g.half_extent) : 0.0f;
                };
                return weight(a) < weight(b);
            });
        if (!longest->is_long()) break;
        auto [first, second] = halves(std::move(*longest));
        *longest = std::move(first);
        groups.push_back(std::move(second));
    }
    std::vector<EmissiveLight> lights;
    for (const Group& group : groups) add_group(group, lights);
    return lights;
}

}  // namespace

std::vector<EmissiveLight> emissive_lights(const scene::Scene& scene) {
    std::vector<std::vector<Piece>> parts = collect_parts(scene);
    std::size_t triangles = 0;
    for (const auto& part : parts) triangles += part.size();
    if (triangles <= 2 * kMostEmissivePieces) {
        std::vector<EmissiveLight> lights;
        for (const auto& part : parts) {
            const std::vector<EmissiveLight> pieces = pieces_of(part);
            lights.insert(lights.end(), pieces.begin(), pieces.end());
        }
        if (lights.size() <= kMostEmissivePieces) return lights;
    }
    return parts.empty() ? std::vector<EmissiveLight>{} : grouped(std::move(parts));
}

std::vector<EmissiveSurface> emissive_surfaces(const scene::Scene& scene) {
    std::vector<EmissiveSurface> out;
    const std::vector<std::vector<Piece>> parts = collect_parts(scene, &out);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        for (const Piece& piece : parts[i]) {
            const auto area_m2 = static_cast<double>(glm::length(piece.vector_area()));
            out[i].area_m2 += area_m2;
            out[i].mean_nit += area_m2 * glm::dvec3(piece.nit);
        }
        out[i].mean_nit /= out[i].area_m2;
    }
    return out;
}

}  // namespace candela::realtime
