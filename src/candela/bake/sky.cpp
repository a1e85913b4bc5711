#include "candela/bake/sky.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "shading/environment.glsl"

namespace candela::bake {
namespace {

using namespace shading;

constexpr int kAzimuths = 33;  ///< of half the dome: the other half mirrors it
constexpr int kElevations = 72;

/// Rays of the sky or of the ground, over azimuth from the sun's and elevation from the horizon. Without
/// their phase functions they change slowly, so that few do.
struct Half {
    SkyTable<SkyRay<glm::vec3>> rays;
    float horizon_rad;
    bool ground;

    [[nodiscard]] float whole_rad() const {
        return ground ? 0.5f * PI + horizon_rad : 0.5f * PI - horizon_rad;
    }
    /// Denser towards the horizon, by the square.
    [[nodiscard]] float elevation_rad(int row) const {
        const float off = whole_rad() * square(float(row) / float(kElevations - 1));
        return ground ? horizon_rad - off : horizon_rad + off;
    }
    [[nodiscard]] float row(float elevation) const {
        const float off = std::abs(elevation - horizon_rad) / whole_rad();
        return std::sqrt(std::min(off, 1.0f)) * float(kElevations - 1);
    }
};

float cosine_to_sun(float elevation_rad, float azimuth_rad, float sun_mu) {
    return std::sin(elevation_rad) * sun_mu + std::cos(elevation_rad) *
                                                  std::sqrt(std::max(1.0f - sun_mu * sun_mu, 0.0f)) *
                                                  std::cos(azimuth_rad);
}

Half half_of(const SkyModel& model, bool ground) {
    Half half{{kAzimuths, kElevations, {}}, std::asin(sky_horizon_mu(model.eye_altitude_m())), ground};
    half.rays.values.resize(std::size_t{kAzimuths} * kElevations);
    tbb::parallel_for(0, kElevations, [&](int row) {
        const float elevation = half.elevation_rad(row);
        for (int x = 0; x < kAzimuths; ++x) {
            const float azimuth = PI * float(x) / float(kAzimuths - 1);
            half.rays.at(x, row) =
                model.ray(std::sin(elevation), cosine_to_sun(elevation, azimuth, model.sun_mu()), ground);
        }
    });
    return half;
}

SkyRay<glm::vec3> mix_rays(const SkyRay<glm::vec3>& a, const SkyRay<glm::vec3>& b, float t) {
    SkyRay<glm::vec3> out{glm::mix(a.air, b.air, t), {}, glm::mix(a.rest, b.rest, t)};
    for (std::size_t n = 0; n < out.aerosol.size(); ++n)
        out.aerosol[n] = glm::mix(a.aerosol[n], b.aerosol[n], t);
    return out;
}

glm::vec3 luminance_of(const Half& half, float elevation, float azimuth, float sun_mu) {
    const float x = std::abs(azimuth) / PI * float(kAzimuths - 1);
    const float y = half.row(elevation);
    const int x0 = std::min(int(x), kAzimuths - 2);
    const int y0 = std::min(int(y), kElevations - 2);
    const auto& rays = half.rays;
    const SkyRay<glm::vec3> light =
        mix_rays(mix_rays(rays.at(x0, y0), rays.at(x0 + 1, y0), x - float(x0)),
                 mix_rays(rays.at(x0, y0 + 1), rays.at(x0 + 1, y0 + 1), x - float(x0)), y - float(y0));
    return radiance_of(light, cosine_to_sun(elevation, azimuth, sun_mu));
}

/// Any direction across; a sun is round.
glm::vec3 level_across(const glm::vec3& d) {
    const glm::vec3 across = glm::cross(d, std::abs(d.y) < 0.99f ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, 1));
    return glm::normalize(across);
}

}  // namespace

glm::vec3 sun_direction(const scene::SkySettings& s) {
    const float elevation = s.elevation_deg * PI / 180.0f;
    const float azimuth = s.azimuth_deg * PI / 180.0f;
    return {std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
            -std::cos(elevation) * std::cos(azimuth)};
}

scene::Environment sky_picture(const SkyModel& model, float sun_azimuth_rad, std::uint32_t height) {
    const Half above = half_of(model, false);
    const Half below = half_of(model, true);
    scene::Environment e;
    e.name = "sky";
    e.width = 2 * height;
    e.height = height;
    e.luminance_nit.resize(std::size_t{e.width} * e.height);
    tbb::parallel_for(std::uint32_t{0}, height, [&](std::uint32_t y) {
        const float elevation = PI * (0.5f - (float(y) + 0.5f) / float(height));
        const Half& half = elevation < above.horizon_rad ? below : above;
        for (std::uint32_t x = 0; x < e.width; ++x) {
            // equirect_direction: the middle looks north, the right side east.
            const float azimuth = TWO_PI * ((float(x) + 0.5f) / float(e.width) - 0.5f) - sun_azimuth_rad;
            const float wrapped = std::remainder(azimuth, TWO_PI);
            e.luminance_nit[std::size_t{y} * e.width + x] =
                rec709_into_gamut(luminance_of(half, elevation, wrapped, model.sun_mu()));
        }
    });
    return e;
}

Sky sky_of(const scene::SkySettings& settings, std::uint32_t height) {
    const SkyModel model(settings);
    Sky sky;
    sky.environment = sky_picture(model, settings.azimuth_deg * PI / 180.0f, height);
    const glm::vec3 lx = rec709_into_gamut(model.sun_rec709_lx());
    if (!(luminance(lx) > 0.0f)) return sky;
    scene::Light sun;
    sun.name = "sun";
    sun.type = scene::LightType::sun;
    sun.unit = scene::LightUnit::lux;
    sun.carrier = "sky";
    sun.intensity = luminance(lx);
    sun.color = lx / sun.intensity;
    sun.direction = -sun_direction(settings);
    sun.right = level_across(sun.direction);
    sun.angular_diameter_rad = 2.0f * kSunAngularRadius_rad;
    sun.limb_darkening = true;
    sky.sun = sun;
    return sky;
}

void follow_environment(scene::Light& sun, const scene::Environment& environment) {
    sun.direction = rotate_about_y(sun.direction, environment.rotation_rad);
    sun.right = rotate_about_y(sun.right, environment.rotation_rad);
    sun.intensity *= environment.scale;
    sun.visible = environment.visible;
}

}  // namespace candela::bake
