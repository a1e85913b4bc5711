#include "candela/realtime/light_records.hpp"

#include <map>

namespace candela::realtime {
namespace {

using scene::LightType;

/// Under this a disc's luminance leaves the range of single precision, and nobody could see that it is one.
constexpr float kLeastAngularRadius_rad = 1e-5f;

void append_profile(const scene::PhotometricProfile& profile, LightRecords& out) {
    const scene::PhotometricGrid grid = scene::fitting_grid(profile);
    const std::vector<float> table = scene::resample(profile, grid.width, grid.height);
    out.profiles.push_back({static_cast<std::uint32_t>(out.profile_cd.size()),
                            static_cast<std::uint32_t>(grid.width), static_cast<std::uint32_t>(grid.height),
                            0});
    out.profile_cd.insert(out.profile_cd.end(), table.begin(), table.end());
}

}  // namespace

LightRecords light_records(const scene::Scene& scene, PackedTextures& textures) {
    LightRecords out;
    for (const scene::PhotometricProfile& profile : scene.profiles) append_profile(profile, out);
    std::map<std::uint32_t, std::uint32_t> image_records;
    for (const scene::Light& light : scene.lights) {
        LightBlock block = light_block(light);
        if (light.type != LightType::disk) block.links.w = -1;
        const bool has_profile = light.type == LightType::point || light.type == LightType::spot ||
                                 light.type == LightType::frustum;
        if (has_profile && light.profile < scene.profiles.size())
            block.links.w = static_cast<int>(light.profile);
        if (light.type == LightType::rectangle && light.image != scene::no_index) {
            const auto [entry, fresh] = image_records.try_emplace(light.image, 0u);
            if (fresh) entry->second = textures.record_of_image(light.image);
            block.links.w = static_cast<int>(entry->second);
        }
        if (light.type == LightType::sun && 0.5f * light.angular_diameter_rad <= kLeastAngularRadius_rad) {
            block.color_type.w = static_cast<float>(LightType::directional);
        }
        out.lights.push_back(block);
    }
    return out;
}

}  // namespace candela::realtime
