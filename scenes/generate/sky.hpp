#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <vector>

namespace candela::scenes {

/// Equirectangular luminance in cd/m^2, linear Rec.709, laid out as scene::Environment.
struct Panorama {
    std::uint32_t width = 512;
    std::uint32_t height = 256;
    std::vector<glm::vec3> luminance_nit;

    [[nodiscard]] glm::vec3 direction(std::uint32_t column, std::uint32_t row) const;
    /// On a surface of this unit normal, lx.
    [[nodiscard]] float illuminance_lx(const glm::vec3& normal) const;
    void save(const std::filesystem::path& exr_file) const;
};

struct SkySettings {
    glm::vec3 to_sun{0.0f, 1.0f, 0.0f};   ///< unit
    float sky_illuminance_lx = 20000.0f;  ///< on level ground, without the sun
    float sun_illuminance_lx = 0.0f;     ///< at normal incidence, in the picture; 0 leaves the sun to a light
    float ground_illuminance_lx = 0.0f;  ///< what the level ground receives
    float ground_albedo = 0.2f;
};

/// CIE clear sky (ISO 15469, type 12) coloured by daylight of rising temperature towards the zenith, over
/// ground.
[[nodiscard]] Panorama outdoor_sky(const SkySettings& settings);

/// A dark photo studio with four soft boxes, scaled so that a level surface receives this much.
[[nodiscard]] Panorama soft_box_studio(float illuminance_lx);

}  // namespace candela::scenes
