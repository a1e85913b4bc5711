#include "candela/realtime/emissive_lights.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "candela/realtime/emissive_cut.hpp"
#include "candela/realtime/emissive_groups.hpp"
#include "candela/realtime/light_list.hpp"
#include "shading/language.glsl"

namespace candela::realtime {
namespace {

using Pieces = std::vector<EmissivePiece>;

EmissiveLight light_of(scene::Light light, const glm::vec3& nit) {
    light.color = nit;
    light.intensity = 1.0f;
    light.visible = false;  // the surface itself is
    return {light_block(light), light};
}

/// The rectangle that two neighbouring triangles of a list make: the second has the first one's longest side.
std::optional<EmissiveLight> rectangle_of(const EmissivePiece& a, const EmissivePiece& b) {
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

LightBlock triangle_block(const EmissivePiece& piece) {
    constexpr int two_sided = 1;
    LightBlock block;
    block.position_range = glm::vec4(piece.corners[0], 1e18f);
    block.direction_a = glm::vec4(piece.corners[1], 0.0f);
    block.right_b = glm::vec4(piece.corners[2], 0.0f);
    block.color_type = glm::vec4(piece.nit, static_cast<float>(LightKind::triangle));
    block.links = glm::ivec4(piece.two_sided ? two_sided : 0, -1, -1, 0);
    return block;
}

/// Every piece by itself, each a light and the group of it.
void lights_of_pieces(const Pieces& pieces, std::vector<EmissiveLight>& lights,
                      std::vector<EmissiveGroup>& groups) {
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const std::optional<EmissiveLight> rectangle =
            i + 1 < pieces.size() ? rectangle_of(pieces[i], pieces[i + 1]) : std::nullopt;
        lights.push_back(rectangle ? *rectangle : EmissiveLight{triangle_block(pieces[i]), std::nullopt});
        groups.emplace_back(rectangle ? Pieces{pieces[i], pieces[i + 1]} : Pieces{pieces[i]});
        if (rectangle) ++i;
    }
}

/// A flat group covers its bounding rectangle with its mean luminance: windows of a facade are a glow all
/// over it and no spot in its middle. What fills the rectangle as a disk does is a disk.
std::optional<EmissiveLight> rectangle_of(const EmissiveGroup& group) {
    const std::optional<BoundingRectangle> b = bounding_rectangle(group);
    if (!b) return std::nullopt;
    const float filled = group.area_m2 / b->area_m2();
    const float aspect = b->half_width_m / b->half_height_m;
    if (filled > 0.7f && filled < 0.85f && aspect > 0.9f && aspect < 1.1f) return std::nullopt;
    scene::Light light;
    light.type = scene::LightType::rectangle;
    light.position = b->center;
    light.direction = glm::normalize(group.vector_area_m2);
    light.right = b->right;
    light.half_width_m = b->half_width_m;
    light.half_height_m = b->half_height_m;
    return light_of(light, group.nit * filled);
}

void add_group(const EmissiveGroup& group, std::vector<EmissiveLight>& lights) {
    constexpr float negligible = 0.02f;
    if (const std::optional<EmissiveLight> rectangle = rectangle_of(group)) {
        lights.push_back(*rectangle);
        return;
    }
    const float front_m2 = group.front_m2();
    const float rest_m2 = group.area_m2 - front_m2;
    scene::Light light;
    light.position = group.center;
    if (front_m2 > negligible * group.area_m2) {
        light.type = scene::LightType::disk;
        light.direction = group.vector_area_m2 / front_m2;
        light.radius_m = std::sqrt(front_m2 / shading::PI);
        const glm::vec3 aside = std::abs(light.direction.x) < 0.5f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
        light.right = glm::normalize(glm::cross(aside, light.direction));
        lights.push_back(light_of(light, group.nit));
    }
    if (rest_m2 > negligible * group.area_m2) {
        light.type = scene::LightType::sphere;
        light.radius_m = std::sqrt(rest_m2 / (4.0f * shading::PI));
        lights.push_back(light_of(light, group.nit));
    }
}

/// All pieces one by one; none when they are too many.
std::optional<std::vector<EmissiveLight>> single_lights(const scene::Scene& scene,
                                                        const std::vector<EmissivePart>& parts) {
    std::size_t triangles = 0;
    for (const EmissivePart& part : parts) triangles += part.pieces.size();
    if (triangles > 2 * kMaxEmissivePieces) return std::nullopt;
    std::vector<EmissiveLight> lights;
    std::vector<EmissiveGroup> groups;
    for (const EmissivePart& part : parts) lights_of_pieces(part.pieces, lights, groups);
    if (lights.size() > kMaxEmissivePieces) return std::nullopt;
    const std::vector<bool> matters = emitters_that_matter(scene, groups);
    std::vector<EmissiveLight> kept;
    for (std::size_t i = 0; i < lights.size(); ++i)
        if (matters[i]) kept.push_back(lights[i]);
    return kept;
}

}  // namespace

std::vector<EmissiveLight> emissive_lights(const scene::Scene& scene) {
    std::vector<EmissivePart> parts = emissive_parts(scene);
    if (parts.empty()) return {};
    if (std::optional<std::vector<EmissiveLight>> lights = single_lights(scene, parts)) return *lights;
    const std::vector<EmissiveGroup> groups = group_emissive(std::move(parts), kMaxEmissiveGroups);
    const std::vector<bool> matters = emitters_that_matter(scene, groups);
    std::vector<EmissiveLight> lights;
    for (std::size_t i = 0; i < groups.size(); ++i)
        if (matters[i]) add_group(groups[i], lights);
    return lights;
}

std::vector<EmissiveSurface> emissive_surfaces(const scene::Scene& scene) {
    std::vector<EmissiveSurface> out;
    for (const EmissivePart& part : emissive_parts(scene)) {
        EmissiveSurface surface{part.instance, part.material, part.pieces.size()};
        for (const EmissivePiece& piece : part.pieces) {
            const auto area_m2 = static_cast<double>(glm::length(piece.vector_area()));
            surface.area_m2 += area_m2;
            surface.mean_nit += area_m2 * glm::dvec3(piece.nit);
        }
        surface.mean_nit /= surface.area_m2;
        out.push_back(surface);
    }
    return out;
}

}  // namespace candela::realtime
