#include "candela/measure/specular_techniques.hpp"

#include <cmath>

#include "candela/bake/ltc_table.hpp"
#include "shading/dominant_direction.glsl"
#include "shading/lights/ltc.glsl"
#include "shading/lights/representative_point.glsl"
#include "shading/lights/tube.glsl"

namespace candela::measure {
namespace {

using namespace shading;

const vec3 kNormal(0.0f, 0.0f, 1.0f);

vec3 mirror_of(const SpecularView& view) {
    return {-view.v.x, -view.v.y, view.v.z};
}
vec3 dominant_of(const SpecularView& view) {
    return specular_dominant_direction_area(kNormal, mirror_of(view), view.alpha);
}

double ltc(const ShapedLight& light, const SpecularView& view) {
    const mat3 m = ltc_inverse_matrix(bake::ltc_table().read(view.v.z, std::sqrt(view.alpha)));
    switch (light.shape) {
        case LightShape::sphere:
            return double(ltc_sphere(m, kNormal, view.v, light.center, light.radius));
        case LightShape::disk:
            return double(ltc_disk(m, kNormal, view.v, light.center, light.direction(), light.radius));
        case LightShape::rectangle:
            return double(ltc_rectangle(m, kNormal, view.v, light.center, light.right, light.up,
                                        light.half_width, light.half_height));
        default:
            return double(
                ltc_tube(m, kNormal, view.v, light.center, light.right, light.half_width, light.radius));
    }
}

float spreading_radius(const ShapedLight& light) {
    switch (light.shape) {
        case LightShape::rectangle:
            return rectangle_spreading_radius(light.half_width, light.half_height);
        case LightShape::tube:
            return tube_spreading_radius(light.half_width, light.radius);
        default:
            return light.radius;
    }
}

double corrected_ltc(const ShapedLight& light, const SpecularView& view) {
    const mat3 m = ltc_inverse_matrix(bake::ltc_table().read(view.v.z, std::sqrt(view.alpha)));
    const float distance_m = length(light.center);
    const vec3 l = light.center / distance_m;
    const float lobe = specular_at_point(kNormal, view.v, l, view.alpha, view.alpha) * l.z / view.albedo;
    return ltc(light, view) *
           double(ltc_small_light_factor(lobe, ltc_density(m, kNormal, view.v, l), view.alpha, l.z, l,
                                         mirror_of(view), spreading_radius(light) / distance_m));
}

/// lx per cd/m^2, exact: the error is then the highlight's alone.
float illuminance(const ShapedLight& light) {
    switch (light.shape) {
        case LightShape::sphere:
            return sphere_projected_solid_angle(kNormal, light.center, light.radius);
        case LightShape::disk:
            return disk_projected_solid_angle(kNormal, light.center, light.direction(), light.radius);
        case LightShape::rectangle:
            return rectangle_projected_solid_angle(kNormal, light.center, light.right, light.up,
                                                   light.half_width, light.half_height);
        default:
            return tube_projected_solid_angle(kNormal, light.center, light.right, light.half_width,
                                              light.radius);
    }
}

vec3 representative_point(const ShapedLight& light, const vec3& towards) {
    switch (light.shape) {
        case LightShape::sphere:
            return representative_point_sphere(light.center, towards, light.radius);
        case LightShape::disk:
            return representative_point_disk(light.center, light.direction(), light.radius, towards);
        case LightShape::rectangle:
            return representative_point_rectangle(light.center, light.right, light.up, light.half_width,
                                                  light.half_height, towards);
        default:
            return representative_point_tube(light.center, light.right, light.half_width, light.radius,
                                             towards);
    }
}

float normalization(const ShapedLight& light, float alpha) {
    const float distance = length(light.center);
    switch (light.shape) {
        case LightShape::rectangle:
            return representative_point_rectangle_normalization(alpha, light.half_width, light.half_height,
                                                                distance);
        case LightShape::tube:
            return representative_point_tube_normalization(alpha, light.half_width, light.radius, distance);
        default:
            return representative_point_sphere_normalization(alpha, light.radius, distance);
    }
}

double highlight(const ShapedLight& light, const SpecularView& view, const vec3& point,
                 float distribution_alpha, float factor) {
    return double(factor * specular_at_point(kNormal, view.v, point, view.alpha, distribution_alpha) *
                  illuminance(light) / view.albedo);
}

double karis(const ShapedLight& light, const SpecularView& view) {
    return highlight(light, view, representative_point(light, mirror_of(view)), view.alpha,
                     normalization(light, view.alpha));
}
double karis_dominant(const ShapedLight& light, const SpecularView& view) {
    return highlight(light, view, representative_point(light, dominant_of(view)), view.alpha,
                     normalization(light, view.alpha));
}
double without_normalization(const ShapedLight& light, const SpecularView& view) {
    return highlight(light, view, representative_point(light, dominant_of(view)), view.alpha, 1.0f);
}
double widened(const ShapedLight& light, const SpecularView& view) {
    const float alpha = alpha_widened_by_sphere(view.alpha, light.radius, length(light.center));
    return highlight(light, view, light.center, alpha, 1.0f);
}
double tube_by_angle(const ShapedLight& light, const SpecularView& view) {
    const vec3 start = light.center - light.half_width * light.right;
    const vec3 end = light.center + light.half_width * light.right;
    const vec3 mirror = mirror_of(view);
    const vec3 at = mix(start, end, representative_share_of_line_by_angle(start, end, mirror));
    return highlight(light, view, representative_point_sphere(at, mirror, light.radius), view.alpha,
                     normalization(light, view.alpha));
}

}  // namespace

std::string name_of(LightShape shape) {
    switch (shape) {
        case LightShape::sphere:
            return "sphere";
        case LightShape::disk:
            return "disk";
        case LightShape::rectangle:
            return "rectangle";
        default:
            return "tube";
    }
}

std::vector<SpecularTechnique> specular_techniques(LightShape shape) {
    const std::string name = name_of(shape);
    const bool flat = shape == LightShape::disk || shape == LightShape::rectangle;
    std::vector<SpecularTechnique> out{
        {"ltc_" + name, "transformed cosine",
         shape == LightShape::rectangle ? "Heitz et al. 2016; own fit, cut at the surface"
                                        : "Heitz & Hill 2017; own fit, cut at the surface",
         ltc},
        {"representative_point_" + name, "representative point",
         flat ? "Karis 2013, equation 20, applied to both directions (own)"
              : "Karis 2013, \"Representative Point\"",
         karis},
        {"representative_point_" + name +
             (flat ? ", dominant direction, normalized" : ", dominant direction"),
         "dominant direction",
         flat ? "Frostbite, section 4.7.5; normalization own" : "Frostbite, section 4.7.5", karis_dominant}};
    if (flat)
        out.push_back({"representative_point_" + name + ", dominant direction",
                       "dominant direction, not normalized", "Frostbite, section 4.7.5, as printed",
                       without_normalization});
    if (shape == LightShape::sphere)
        out.push_back(
            {"alpha_widened_by_sphere", "specular D modification", "Karis 2013, equation 10", widened});
    if (shape == LightShape::tube)
        out.push_back({"representative_share_of_line_by_angle", "smallest angle", "Karis 2013, equation 18",
                       tube_by_angle});
    out.push_back({"ltc_" + name + " times ltc_small_light_factor", "transformed cosine, corrected",
                   "own: the lobe over the fit at the light's middle", corrected_ltc});
    return out;
}

}  // namespace candela::measure
