#include "candela/scene/light_units.hpp"

#include <cmath>

#include "candela/scene/error.hpp"
#include "shading/color_temperature.glsl"
#include "shading/lights/line.glsl"
#include "shading/lights/punctual.glsl"
#include "shading/lights/rectangle.glsl"
#include "shading/lights/tube.glsl"
#include "shading/lights/units.glsl"

namespace candela::scene {
namespace {

constexpr LightUnit kUnits[] = {LightUnit::lumen, LightUnit::candela, LightUnit::lux,
                                LightUnit::nit,   LightUnit::ev100,   LightUnit::watt};

float sides(const Light& light) {
    const bool flat = light.type == LightType::disk || light.type == LightType::rectangle;
    return flat && light.two_sided ? 2.0f : 1.0f;
}

/// Light::intensity of this much luminous power, on a scale where power is proportional to it.
float intensity_of_lm(const Light& l, float lm) {
    switch (l.type) {
        case LightType::point:
            return shading::point_cd_from_lm(lm);
        case LightType::spot:
            return l.spot_power == SpotPower::exact ? shading::spot_cd_from_lm_exact(lm, l.outer_cone_rad)
                                                    : shading::spot_cd_from_lm(lm);
        case LightType::frustum:
            return shading::frustum_cd_from_lm(lm, l.horizontal_angle_rad, l.vertical_angle_rad);
        case LightType::line:
            return shading::line_cd_from_lm(lm);
        case LightType::sphere:
            return shading::sphere_nit_from_lm(lm, l.radius_m);
        case LightType::disk:
            return shading::disk_nit_from_lm(lm / sides(l), l.radius_m);
        case LightType::rectangle:
            return shading::rectangle_nit_from_lm(lm / sides(l), 2.0f * l.half_width_m,
                                                  2.0f * l.half_height_m);
        case LightType::tube:
            return shading::tube_nit_from_lm(lm, l.radius_m, 2.0f * l.half_width_m);
        case LightType::directional:
        case LightType::sun:
            break;
    }
    return 0.0f;
}

/// What a shape shows of itself along its axis, m^2.
float projected_area(const Light& l) {
    switch (l.type) {
        case LightType::sphere:
        case LightType::disk:
            return shading::disk_area(l.radius_m);
        case LightType::rectangle:
            return shading::rectangle_area(2.0f * l.half_width_m, 2.0f * l.half_height_m);
        case LightType::tube:
            return shading::tube_projected_area(l.radius_m, 2.0f * l.half_width_m);
        default:
            return 0.0f;
    }
}

/// lx at 1 m per unit of Light::intensity; none where 1 m is inside the light.
std::optional<float> lx_at_1m(const Light& l) {
    const glm::vec3 n(0.0f, 0.0f, 1.0f), x(1.0f, 0.0f, 0.0f), y(0.0f, 1.0f, 0.0f);
    const float window = shading::window_attenuation(1.0f, l.range_m);
    switch (l.type) {
        case LightType::point:
        case LightType::spot:
        case LightType::frustum:
            return window * shading::lx_from_cd(1.0f, 1.0f);
        case LightType::line:
            return window * shading::line_illuminance(n, n, x, l.half_width_m);
        case LightType::sphere:
            if (l.radius_m >= 1.0f) return std::nullopt;
            return window * shading::sphere_lx_from_nit(1.0f, l.radius_m, 1.0f);
        case LightType::disk:
            return window * shading::disk_lx_from_nit(1.0f, l.radius_m, 1.0f);
        case LightType::rectangle:
            return window *
                   shading::rectangle_projected_solid_angle(n, n, x, y, l.half_width_m, l.half_height_m);
        case LightType::tube:
            if (l.radius_m >= 1.0f) return std::nullopt;
            return window * shading::tube_projected_solid_angle(n, n, x, l.half_width_m, l.radius_m);
        case LightType::directional:
        case LightType::sun:
            break;
    }
    return std::nullopt;
}

std::string hint_for(LightType type, LightUnit unit) {
    const std::string units = std::string("a ") + name_of(type) + " light takes " + accepted_units(type);
    const bool luminance = unit == LightUnit::nit || unit == LightUnit::ev100;
    // Frostbite (below Table 12) promotes a punctual light that is given a luminance to an area light of 1
    // cm.
    if (luminance && type == LightType::point)
        return units + "; what has a luminance has a size: a sphere with \"radius_m\": 0.01";
    if (luminance && type == LightType::spot)
        return units + "; what has a luminance has a size: a disk with \"radius_m\": 0.01";
    if (luminance && type == LightType::line) return units + "; what has a luminance has a size: a tube";
    return units;
}

/// lm of the part of a web that a spot's cones let through, by the midpoint rule.
float lm_through_cones(const PhotometricProfile& profile, const Light& spot) {
    constexpr int rings = 256, sectors = 72;
    const float cos_inner = std::cos(spot.inner_cone_rad), cos_outer = std::cos(spot.outer_cone_rad);
    double sum = 0.0;
    for (int r = 0; r < rings; ++r) {
        const double gamma = (r + 0.5) / rings * static_cast<double>(spot.outer_cone_rad);
        double ring = 0.0;
        for (int s = 0; s < sectors; ++s)
            ring += intensity_cd(profile, (s + 0.5) * 360.0 / sectors, gamma * 180.0 / M_PI);
        const auto cos_gamma = static_cast<float>(std::cos(gamma));
        sum += ring * std::sin(gamma) *
               static_cast<double>(shading::angle_attenuation(cos_gamma, cos_inner, cos_outer));
    }
    return static_cast<float>(sum * 2.0 * M_PI / sectors * static_cast<double>(spot.outer_cone_rad) / rings);
}

LightQuantities profile_quantities(const Light& light, const PhotometricProfile& profile) {
    LightQuantities q;
    const float factor = light.intensity * shading::luminance(light.color);
    q.power_lm = factor * static_cast<float>(integrated_lm(profile));
    q.emitted_lm = light.type == LightType::spot ? factor * lm_through_cones(profile, light) : *q.power_lm;
    q.intensity_cd = factor * static_cast<float>(intensity_cd(profile, 0.0, 0.0));
    q.peak_cd = factor * static_cast<float>(peak(profile).candela);
    q.illuminance_at_1m_lx = *q.intensity_cd * *lx_at_1m(light);
    if (light.efficacy_lm_per_w > 0.0f)
        q.power_w = shading::watt_from_lm(*q.power_lm, light.efficacy_lm_per_w);
    return q;
}

}  // namespace

const char* name_of(LightUnit unit) {
    switch (unit) {
        case LightUnit::candela:
            return "cd";
        case LightUnit::lumen:
            return "lm";
        case LightUnit::lux:
            return "lx";
        case LightUnit::nit:
            return "nit";
        case LightUnit::ev100:
            return "EV100";
        case LightUnit::watt:
            return "W";
    }
    return "";
}

bool accepts(LightType type, LightUnit unit) {
    switch (unit) {
        case LightUnit::lumen:
        case LightUnit::watt:
            return !is_distant(type);
        case LightUnit::candela:
            return !is_distant(type) && !is_shape(type);
        case LightUnit::lux:
            return is_distant(type);
        case LightUnit::nit:
        case LightUnit::ev100:
            return has_extent(type);
    }
    return false;
}

std::string accepted_units(LightType type) {
    std::string out;
    std::string last;
    for (const LightUnit unit : kUnits) {
        if (!accepts(type, unit)) continue;
        if (!last.empty()) out += (out.empty() ? "" : ", ") + last;
        last = name_of(unit);
    }
    return out.empty() ? last : out + " or " + last;
}

float intensity_from(const Light& light, const LightStrength& s, const std::string& where) {
    if (!accepts(light.type, s.unit))
        throw input_error(
            std::string("a ") + name_of(light.type) + " light has no strength in " + name_of(s.unit), where,
            hint_for(light.type, s.unit));
    switch (s.unit) {
        case LightUnit::candela:
        case LightUnit::lux:
            return s.value;
        case LightUnit::lumen:
            return intensity_of_lm(light, s.value);
        case LightUnit::watt:
            return intensity_of_lm(light, shading::lm_from_watt(s.value, s.efficacy_lm_per_w));
        case LightUnit::nit:
        case LightUnit::ev100:
            break;
    }
    const float nit = s.unit == LightUnit::nit ? s.value : shading::luminance_from_ev100(s.value);
    return light.type == LightType::sun ? shading::sun_lx_from_nit(nit, light.angular_diameter_rad) : nit;
}

float profile_factor_from(const Light& light, const PhotometricProfile& profile, ProfileScale scale,
                          const LightStrength& s, const std::string& where) {
    const float intensity = intensity_from(light, s, where);
    if (scale == ProfileScale::mask) {
        const auto peak_cd = static_cast<float>(peak(profile).candela);
        if (!(peak_cd > 0.0f)) throw input_error("the profile is dark", where);
        return intensity / peak_cd;
    }
    const auto web_lm = static_cast<float>(integrated_lm(profile));
    if (!(web_lm > 0.0f)) throw input_error("the profile is dark", where);
    return (s.unit == LightUnit::watt ? shading::lm_from_watt(s.value, s.efficacy_lm_per_w) : s.value) /
           web_lm;
}

std::optional<float> power_lm(const Light& light) {
    if (is_distant(light.type)) return std::nullopt;
    const float per_lm = intensity_of_lm(light, 1.0f);
    return light.intensity / per_lm;
}

LightQuantities quantities(const Light& light, const PhotometricProfile* profile) {
    if (profile) return profile_quantities(light, *profile);
    LightQuantities q;
    const float luminance = shading::luminance(light.color);
    const float strength = light.intensity * luminance;
    if (const std::optional<float> lm = power_lm(light)) {
        q.power_lm = *lm * luminance;
        q.emitted_lm = q.power_lm;
        if (light.type == LightType::spot)
            q.emitted_lm =
                shading::spot_lm_from_cd_smooth(strength, light.inner_cone_rad, light.outer_cone_rad);
        if (light.efficacy_lm_per_w > 0.0f)
            q.power_w = shading::watt_from_lm(*q.power_lm, light.efficacy_lm_per_w);
    }
    if (is_distant(light.type)) {
        q.illuminance_lx = strength;
    } else {
        q.intensity_cd = is_shape(light.type) ? strength * projected_area(light) : strength;
        if (const std::optional<float> lx = lx_at_1m(light)) q.illuminance_at_1m_lx = strength * *lx;
    }
    if (has_extent(light.type)) {
        q.luminance_nit = light.type == LightType::sun
                              ? shading::sun_nit_from_lx(strength, light.angular_diameter_rad)
                              : strength;
        if (*q.luminance_nit > 0.0f) q.ev100 = shading::ev100_from_luminance(*q.luminance_nit);
    }
    return q;
}

}  // namespace candela::scene
