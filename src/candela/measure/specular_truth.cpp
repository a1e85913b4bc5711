#include "candela/measure/specular_truth.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "shading/basis.glsl"
#include "shading/dfg.glsl"

namespace candela::measure {
namespace {

using namespace shading;

/// Unit direction of one point of the light and the density per solid angle that it was drawn with.
struct LightSample {
    vec3 l{0.0f, 0.0f, 1.0f};
    double pdf = 0.0;  ///< 0: the point does not shine on the receiver
};

double cap_solid_angle(const ShapedLight& light) {
    const double sine = std::min(double(light.radius) / double(length(light.center)), 1.0);
    return 2.0 * double(PI) * sine * sine / (1.0 + std::sqrt((1.0 - sine) * (1.0 + sine)));
}

double area_m2(const ShapedLight& light) {
    const double r = double(light.radius);
    switch (light.shape) {
        case LightShape::disk:
            return double(PI) * r * r;
        case LightShape::rectangle:
            return 4.0 * double(light.half_width) * double(light.half_height);
        default:
            return 4.0 * double(PI) * r * (r + double(light.half_width));
    }
}

/// Distance along l to a sphere about `center`; negative for a miss.
double distance_to_sphere(const vec3& center, double radius, const vec3& l) {
    const glm::dvec3 c(center);
    const glm::dvec3 d(l);
    const double along = glm::dot(c, d);
    const glm::dvec3 across = c - along * d;
    const double inside = radius * radius - glm::dot(across, across);
    if (along <= 0.0 || inside <= 0.0) return -1.0;
    return along - std::sqrt(inside);
}

double on_flat(const ShapedLight& light, const vec3& l) {
    const vec3 shine = light.direction();
    const float facing = -dot(shine, l);
    const float height = -dot(shine, light.center);
    if (facing <= 0.0f || height <= 0.0f) return 0.0;
    const float distance = height / facing;
    const vec3 at = distance * l - light.center;
    const bool hit = light.shape == LightShape::disk ? dot(at, at) <= light.radius * light.radius
                                                     : std::abs(dot(at, light.right)) <= light.half_width &&
                                                           std::abs(dot(at, light.up)) <= light.half_height;
    return hit ? double(distance) * double(distance) / double(facing) : 0.0;
}

double on_tube(const ShapedLight& light, const vec3& l) {
    const glm::dvec3 axis(light.right);
    const glm::dvec3 d(l);
    const glm::dvec3 c(light.center);
    const double r = double(light.radius);
    double nearest = -1.0;
    glm::dvec3 normal(0.0);
    // The cylinder: the ray across the axis meets a circle.
    const glm::dvec3 c_across = c - glm::dot(c, axis) * axis;
    const glm::dvec3 d_across = d - glm::dot(d, axis) * axis;
    const double a = glm::dot(d_across, d_across);
    const double b = glm::dot(d_across, c_across);
    const double under = b * b - a * (glm::dot(c_across, c_across) - r * r);
    if (under > 0.0 && a > 0.0 && b > 0.0) {
        const double distance = (b - std::sqrt(under)) / a;
        const glm::dvec3 at = distance * d - c;
        const double along = glm::dot(at, axis);
        if (std::abs(along) <= double(light.half_width)) {
            nearest = distance;
            normal = (at - along * axis) / r;
        }
    }
    for (const float side : {-1.0f, 1.0f}) {
        const vec3 end = light.center + side * light.half_width * light.right;
        const double distance = distance_to_sphere(end, r, l);
        if (distance <= 0.0 || (nearest > 0.0 && distance >= nearest)) continue;
        nearest = distance;
        normal = (distance * d - glm::dvec3(end)) / r;
    }
    if (nearest <= 0.0) return 0.0;
    const double facing = -glm::dot(normal, d);
    return facing > 1.0e-6 ? nearest * nearest / facing : 0.0;
}

vec3 point_on_tube(const ShapedLight& light, const vec2& u) {
    const float cylinder = light.half_width / (light.half_width + light.radius);
    if (u.x < cylinder) {
        const float along = (2.0f * u.x / cylinder - 1.0f) * light.half_width;
        const vec3 across = cos(TWO_PI * u.y) * light.up + sin(TWO_PI * u.y) * cross(light.right, light.up);
        return light.center + along * light.right + light.radius * across;
    }
    const float z = 2.0f * (u.x - cylinder) / (1.0f - cylinder) - 1.0f;
    const float sine = std::sqrt(max((1.0f - z) * (1.0f + z), 0.0f));
    const vec3 across = cos(TWO_PI * u.y) * light.up + sin(TWO_PI * u.y) * cross(light.right, light.up);
    const float end = z < 0.0f ? -light.half_width : light.half_width;
    return light.center + end * light.right + light.radius * (z * light.right + sine * across);
}

LightSample sample_light(const ShapedLight& light, const vec2& u) {
    LightSample out;
    if (light.shape == LightShape::sphere) {
        const double cap = cap_solid_angle(light);
        const float height = float(double(u.x) * cap / (2.0 * double(PI)));  // 1 - cos of the angle
        const float sine = std::sqrt(max(height * (2.0f - height), 0.0f));
        const vec3 axis = normalize(light.center);
        vec3 t;
        vec3 b;
        orthonormal_basis(axis, t, b);
        out.l = normalize((1.0f - height) * axis + sine * (cos(TWO_PI * u.y) * t + sin(TWO_PI * u.y) * b));
        out.pdf = 1.0 / cap;
        return out;
    }
    vec3 at = light.center;
    if (light.shape == LightShape::disk) {
        const float r = light.radius * std::sqrt(u.x);
        at += r * (cos(TWO_PI * u.y) * light.right + sin(TWO_PI * u.y) * light.up);
    } else if (light.shape == LightShape::rectangle) {
        at += (2.0f * u.x - 1.0f) * light.half_width * light.right +
              (2.0f * u.y - 1.0f) * light.half_height * light.up;
    } else {
        at = point_on_tube(light, u);
    }
    out.l = normalize(at);
    if (light.shape != LightShape::tube) {
        out.pdf =
            double(dot(at, at)) / (double(max(-dot(light.direction(), out.l), 1.0e-9f)) * area_m2(light));
        if (dot(light.direction(), out.l) >= 0.0f) out.pdf = 0.0;
        return out;
    }
    // Only the near side is seen; a convex body shows all of it.
    const vec3 foot =
        light.center +
        clamp(dot(at - light.center, light.right), -light.half_width, light.half_width) * light.right;
    const double facing = -double(dot(at - foot, out.l)) / double(light.radius);
    out.pdf = facing > 1.0e-6 ? double(dot(at, at)) / (facing * area_m2(light)) : 0.0;
    return out;
}

}  // namespace

double square_metres_per_steradian(const ShapedLight& light, const vec3& l) {
    switch (light.shape) {
        case LightShape::sphere:
            return distance_to_sphere(light.center, double(light.radius), l) > 0.0 ? 1.0 : 0.0;
        case LightShape::tube:
            return on_tube(light, l);
        default:
            return on_flat(light, l);
    }
}

bool contains_receiver(const ShapedLight& light) {
    if (light.shape == LightShape::disk || light.shape == LightShape::rectangle) return false;
    const float half_length = light.shape == LightShape::tube ? light.half_width : 0.0f;
    const vec3 nearest =
        light.center + clamp(-dot(light.center, light.right), -half_length, half_length) * light.right;
    return length(nearest) <= 1.001f * light.radius;
}

float specular_albedo(float NoV, float alpha) {
    const vec2 scale_and_bias = integrate_ggx_albedo(NoV, std::sqrt(alpha), 4096u);
    return scale_and_bias.x + scale_and_bias.y;
}

SpecularTruth::SpecularTruth(float NoV, float alpha, float albedo, int lobe_samples, int light_samples)
    : v_(-std::sqrt((1.0f - NoV) * (1.0f + NoV)), 0.0f, NoV),
      alpha_(alpha),
      albedo_(albedo),
      lobe_count_(lobe_samples),
      light_count_(light_samples) {
    for (int i = 0; i < lobe_samples; ++i) {
        const vec3 h = sample_ggx_vndf(sobol_owen(uint(i), 17u), v_, alpha);
        const vec3 l = 2.0f * dot(v_, h) * h - v_;
        LobeSample s{l, 0.0, 1.0};
        if (l.z > 0.0f) s = {l, lobe(l), pdf(l)};
        lobe_.push_back(s);
    }
}

double SpecularTruth::lobe(const vec3& l) const {
    const vec3 n(0.0f, 0.0f, 1.0f);
    return double(D_GGX(n, normalize(v_ + l), alpha_) * V_SmithGGXCorrelated(v_.z, l.z, alpha_) * l.z /
                  albedo_);
}

double SpecularTruth::pdf(const vec3& l) const {
    const vec3 h = normalize(v_ + l);
    return double(pdf_reflected(pdf_ggx_vndf(v_, h, alpha_), dot(v_, h)));
}

SpecularIntegral SpecularTruth::integrate(const ShapedLight& light) const {
    const bool is_sphere = light.shape == LightShape::sphere;
    const double per_measure = is_sphere ? 1.0 / cap_solid_angle(light) : 1.0 / area_m2(light);
    std::array<double, 2> halves{};
    for (std::size_t i = 0; i < lobe_.size(); ++i) {
        const LobeSample& s = lobe_[i];
        if (s.density <= 0.0) continue;
        const double light_pdf = per_measure * square_metres_per_steradian(light, s.l);
        if (light_pdf > 0.0)
            halves[2 * i < lobe_.size() ? 0 : 1] +=
                s.density / (lobe_count_ * s.pdf + light_count_ * light_pdf);
    }
    for (int i = 0; i < light_count_; ++i) {
        const LightSample s = sample_light(light, sobol_owen(uint(i), 29u));
        if (s.l.z <= 0.0f || s.pdf <= 0.0) continue;
        halves[2 * i < light_count_ ? 0 : 1] += lobe(s.l) / (lobe_count_ * pdf(s.l) + light_count_ * s.pdf);
    }
    return {halves[0] + halves[1], std::abs(halves[0] - halves[1])};
}

}  // namespace candela::measure
