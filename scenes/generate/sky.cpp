#include "sky.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "candela/io/image_write.hpp"
#include "shading/color_temperature.glsl"
#include "shading/environment.glsl"

namespace candela::scenes {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

/// Half as wide again as the real sun many times over (1.5 degrees), so that it covers texels of 0.7 degrees
/// evenly.
constexpr float sun_radius_rad = 0.0262f;

/// ISO 15469 / CIE S 011, sky type 12 (clear, low turbidity), relative luminance.
float cie_clear_sky(float cos_zenith, float cos_sun) {
    const float a = -1.0f, b = -0.32f, c = 10.0f, d = -3.0f, e = 0.45f;
    const float chi = std::acos(std::clamp(cos_sun, -1.0f, 1.0f));
    const float gradation = 1.0f + a * std::exp(b / std::max(cos_zenith, 0.02f));
    const float indicatrix = 1.0f + c * (std::exp(d * chi) - std::exp(0.5f * d * pi)) + e * cos_sun * cos_sun;
    return gradation * indicatrix;
}

struct SoftBox {
    glm::vec3 towards{0.0f};    ///< where its centre hangs, unit
    glm::vec2 half_size{0.3f};  ///< tangents of its half angles
    float luminance = 1.0f;     ///< relative
    float kelvin = 6504.0f;
};

/// 1 within the box, falling over a soft edge like a diffuser's.
float soft_box_mask(const SoftBox& box, const glm::vec3& direction) {
    const float along = glm::dot(direction, box.towards);
    if (along <= 0.0f) return 0.0f;
    const glm::vec3 hint = std::abs(box.towards.y) < 0.99f ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, -1);
    const glm::vec3 right = glm::normalize(glm::cross(box.towards, hint));
    const glm::vec3 up = glm::cross(right, box.towards);
    const glm::vec2 p = glm::abs(glm::vec2(glm::dot(direction, right), glm::dot(direction, up)) / along);
    const float edge = 0.04f;
    return glm::smoothstep(edge, -edge, p.x - box.half_size.x) *
           glm::smoothstep(edge, -edge, p.y - box.half_size.y);
}

template <typename Paint>
Panorama paint_panorama(Paint paint) {
    Panorama panorama;
    panorama.luminance_nit.reserve(std::size_t{panorama.width} * panorama.height);
    for (std::uint32_t row = 0; row < panorama.height; ++row)
        for (std::uint32_t column = 0; column < panorama.width; ++column)
            panorama.luminance_nit.push_back(paint(panorama.direction(column, row)));
    return panorama;
}

}  // namespace

glm::vec3 Panorama::direction(std::uint32_t column, std::uint32_t row) const {
    return shading::equirect_direction({(static_cast<float>(column) + 0.5f) / static_cast<float>(width),
                                        (static_cast<float>(row) + 0.5f) / static_cast<float>(height)});
}

float Panorama::illuminance_lx(const glm::vec3& normal) const {
    double sum = 0.0;
    for (std::uint32_t row = 0; row < height; ++row) {
        const float texel_sr = shading::equirect_texel_solid_angle(row, width, height);
        for (std::uint32_t column = 0; column < width; ++column) {
            const float cosine = std::max(glm::dot(direction(column, row), normal), 0.0f);
            sum += double(texel_sr) * cosine *
                   shading::luminance(luminance_nit[std::size_t{row} * width + column]);
        }
    }
    return static_cast<float>(sum);
}

void Panorama::save(const std::filesystem::path& exr_file) const {
    std::vector<float> planes[3];
    for (const glm::vec3& texel : luminance_nit)
        for (int c = 0; c < 3; ++c) planes[c].push_back(texel[c]);
    const std::span<const float> r(planes[0]), g(planes[1]), b(planes[2]);
    io::write_exr(exr_file, width, height,
                  {{"R", io::PixelType::float32, r},
                   {"G", io::PixelType::float32, g},
                   {"B", io::PixelType::float32, b}},
                  {{"whiteLuminance", 1.0f}});
}

Panorama outdoor_sky(const SkySettings& settings) {
    Panorama sky = paint_panorama([&](const glm::vec3& d) {
        if (d.y <= 0.0f) return glm::vec3(0.0f);
        const float cos_sun = glm::dot(d, settings.to_sun);
        const float near_sun = std::exp(-4.0f * std::acos(std::clamp(cos_sun, -1.0f, 1.0f)));
        const float kelvin = glm::mix(glm::mix(6500.0f, 18000.0f, std::sqrt(d.y)), 5500.0f, near_sun);
        return cie_clear_sky(d.y, cos_sun) * shading::rec709_from_daylight(kelvin);
    });
    const float scale = settings.sky_illuminance_lx / sky.illuminance_lx({0, 1, 0});
    const float ground_nit = settings.ground_albedo * settings.ground_illuminance_lx / pi;
    const glm::vec3 earth = glm::vec3(1.09f, 0.99f, 0.80f);  // warm grey of luminance 1
    const auto in_sun = [&](const glm::vec3& d) {
        return glm::dot(d, settings.to_sun) > std::cos(sun_radius_rad);
    };
    // Scaled by what its texels really cover, so that the disc gives exactly the illuminance asked for.
    Panorama sun = paint_panorama([&](const glm::vec3& d) {
        return in_sun(d) ? shading::rec709_from_daylight(5500.0f) : glm::vec3(0.0f);
    });
    const float sun_scale = settings.sun_illuminance_lx / sun.illuminance_lx(settings.to_sun);
    for (std::uint32_t i = 0; i < sky.luminance_nit.size(); ++i) {
        const float up = sky.direction(i % sky.width, i / sky.width).y;
        sky.luminance_nit[i] = (up > 0.0f ? scale * sky.luminance_nit[i] : ground_nit * earth) +
                               sun_scale * sun.luminance_nit[i];
    }
    return sky;
}

Panorama soft_box_studio(float illuminance_lx) {
    const SoftBox boxes[] = {
        {glm::normalize(glm::vec3(-0.85f, 0.65f, 0.55f)), {0.45f, 0.6f}, 70.0f, 5500.0f},  // key, left front
        {glm::normalize(glm::vec3(1.0f, 0.25f, 0.35f)), {0.2f, 0.8f}, 22.0f, 6500.0f},     // strip, right
        {glm::normalize(glm::vec3(0.1f, 1.0f, -0.1f)), {0.5f, 0.3f}, 30.0f, 6000.0f},      // overhead
        {glm::normalize(glm::vec3(0.55f, 0.45f, -0.9f)), {0.25f, 0.45f}, 40.0f, 7500.0f},  // rim, behind
    };
    Panorama studio = paint_panorama([&](const glm::vec3& d) {
        // Grey walls that brighten towards the floor, and a floor that is a little brighter than they are.
        glm::vec3 light = glm::vec3(glm::mix(1.6f, 0.7f, glm::smoothstep(-0.2f, 0.8f, d.y)));
        light += glm::vec3(1.0f) * glm::smoothstep(-0.05f, -0.5f, d.y);
        for (const SoftBox& box : boxes)
            light += box.luminance * soft_box_mask(box, d) * shading::rec709_from_daylight(box.kelvin);
        return light;
    });
    const float scale = illuminance_lx / studio.illuminance_lx({0, 1, 0});
    for (glm::vec3& texel : studio.luminance_nit) texel *= scale;
    return studio;
}

}  // namespace candela::scenes
