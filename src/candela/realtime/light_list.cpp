#include "candela/realtime/light_list.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "candela/realtime/emissive_lights.hpp"
#include "candela/realtime/light_images.hpp"
#include "candela/scene/photometric.hpp"

namespace candela::realtime {
namespace {

constexpr float kUnlimited_m = 1e17f;

struct Row {
    LightBlock block;
    LightReach reach;
    std::uint32_t source = scene::no_index;
};

bool has_profile(const scene::Light& light) {
    return light.profile != scene::no_index &&
           (light.type == scene::LightType::point || light.type == scene::LightType::spot);
}

/// Of the cone that holds all the light, from the light's position; below 0: it shines everywhere.
float reach_cosine(const scene::Light& light) {
    switch (light.type) {
        case scene::LightType::spot:
            return std::cos(light.outer_cone_rad);
        case scene::LightType::frustum: {
            const float x = std::tan(0.5f * light.horizontal_angle_rad);
            const float y = std::tan(0.5f * light.vertical_angle_rad);
            return 1.0f / std::sqrt(1.0f + x * x + y * y);
        }
        case scene::LightType::disk:
        case scene::LightType::rectangle:
            return light.two_sided ? -1.0f : 0.0f;
        default:
            return -1.0f;
    }
}

LightReach reach_of(const scene::Light& light) {
    LightReach reach;
    const bool unlimited = scene::is_distant(light.type);
    reach.ball = glm::vec4(light.position, unlimited ? 1e18f : std::min(light.range_m, 1e18f));
    if (!unlimited) reach.cone = glm::vec4(light.direction, reach_cosine(light));
    return reach;
}

bool everywhere(const LightReach& reach) {
    return reach.ball.w > kUnlimited_m && reach.cone.w < 0.0f;
}

/// Where a table begins among all, and its size as links.w has it.
struct TablePlace {
    int first = 0;
    int size = 0;
};

std::vector<TablePlace> place_profiles(const scene::Scene& scene, std::vector<float>& table) {
    std::vector<TablePlace> places;
    for (const scene::PhotometricProfile& profile : scene.profiles) {
        const scene::PhotometricGrid grid = scene::fitting_grid(profile);
        const std::vector<float> cd = scene::resample(profile, grid.width, grid.height);
        places.push_back({static_cast<int>(table.size()), grid.width | grid.height << 16});
        table.insert(table.end(), cd.begin(), cd.end());
    }
    return places;
}

/// Puts each picture that a rectangle shows behind the tables once; place.size: its texels a side.
std::map<std::uint32_t, TablePlace> place_images(const scene::Scene& scene, std::vector<float>& table) {
    std::map<std::uint32_t, TablePlace> places;
    for (const scene::Light& light : scene.lights) {
        if (light.type != scene::LightType::rectangle || light.image >= scene.images.size()) continue;
        if (places.contains(light.image)) continue;
        const ImagePyramid pyramid = image_pyramid(scene.images[light.image]);
        places[light.image] = {static_cast<int>(table.size()), pyramid.size};
        table.insert(table.end(), pyramid.rgb.begin(), pyramid.rgb.end());
    }
    return places;
}

Row row_of(const scene::Light& light, std::uint32_t source, const std::vector<TablePlace>& profiles) {
    Row row{light_block(light), reach_of(light), source};
    if (has_profile(light) && light.profile < profiles.size()) {
        row.block.color_type.w = static_cast<float>(LightKind::photometric);
        row.block.links.y = profiles[light.profile].first;
        row.block.links.w = profiles[light.profile].size;
        if (light.type == scene::LightType::point) {
            // A cone that the cosine of no direction is outside of.
            row.block.direction_a.w = -2.0f;
            row.block.right_b.w = -3.0f;
        }
    }
    return row;
}

Row emissive_row(const LightBlock& block) {
    Row row;
    row.block = block;
    row.reach.ball = glm::vec4(glm::vec3(block.position_range), 1e18f);
    return row;
}

}  // namespace

LightList light_list(const scene::Scene& scene, bool with_emissive) {
    LightList list;
    const std::vector<TablePlace> profiles = place_profiles(scene, list.tables);
    const std::map<std::uint32_t, TablePlace> images = place_images(scene, list.tables);
    std::vector<Row> rows;
    for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
        const scene::Light& light = scene.lights[i];
        rows.push_back(row_of(light, i, profiles));
        if (light.type != scene::LightType::rectangle || !images.contains(light.image)) continue;
        rows.back().block.links.y = images.at(light.image).first;
        rows.back().block.links.w = images.at(light.image).size;
        list.kinds |= kLightImages;
    }
    if (with_emissive) {
        for (const EmissiveLight& light : emissive_lights(scene)) {
            Row row = emissive_row(light.block);
            if (light.shape) {
                row.source = static_cast<std::uint32_t>(scene.lights.size() + list.emissive_shapes.size());
                list.emissive_shapes.push_back(*light.shape);
            }
            rows.push_back(row);
        }
    }
    std::stable_sort(rows.begin(), rows.end(),
                     [](const Row& a, const Row& b) { return a.block.color_type.w < b.block.color_type.w; });
    for (const Row& row : rows) {
        list.blocks.push_back(row.block);
        list.reaches.push_back(row.reach);
        list.sources.push_back(row.source);
        list.kinds |= 1u << static_cast<std::uint32_t>(row.block.color_type.w);
        list.bounded += everywhere(row.reach) ? 0 : 1;
    }
    return list;
}

std::vector<std::uint32_t> shape_lights(const LightList& list) {
    constexpr int visible = 4;  // kLightVisible of shaders/lights.glsl
    std::vector<std::uint32_t> shapes;
    for (std::uint32_t i = 0; i < list.blocks.size(); ++i) {
        const LightBlock& block = list.blocks[i];
        const auto type = static_cast<scene::LightType>(block.color_type.w);
        if (list.sources[i] != scene::no_index && scene::is_shape(type) &&
            type <= scene::LightType::rectangle && (block.links.x & visible) != 0)
            shapes.push_back(i);
    }
    return shapes;
}

std::vector<std::uint32_t> light_entries(const LightList& list) {
    std::vector<std::uint32_t> entries;
    for (const LightBlock& block : list.blocks) {
        entries.push_back(static_cast<std::uint32_t>(entries.size()) |
                          (static_cast<std::uint32_t>(block.color_type.w) + 1u) << 24u);
    }
    entries.push_back(0);
    return entries;
}

}  // namespace candela::realtime
