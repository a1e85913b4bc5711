// Directions to lights drawn by chance: the sphere, the sun, and points of a line. The other shapes have files of their
// own (*_sampling.glsl). All positions are relative to the receiver; u in [0,1)^2.
//
// Each shape has sample_X(u, ...) and pdf_X(direction, ...): the density in 1/sr with which the first draws that
// direction. pdf_X asks for a direction that meets the shape (intersect.glsl) and is not defined for others.
#ifndef CANDELA_LIGHTS_SAMPLING_GLSL
#define CANDELA_LIGHTS_SAMPLING_GLSL

#include "../basis.glsl"
#include "../language.glsl"
#include "../photometry.glsl"
#include "intersect.glsl"
#include "units.glsl"

CANDELA_SHADING_BEGIN

struct LightDirection {
    vec3 direction;    // unit
    float distance_m;  // to where the light leaves the shape
    float pdf;         // 1/sr; 0: nothing was drawn
};

FN LightDirection no_light_direction() {
    LightDirection s;
    s.direction = vec3(0.0f, 0.0f, 1.0f);
    s.distance_m = 0.0f;
    s.pdf = 0.0f;
    return s;
}

// 1 - cos of an angle of which sin^2 is known and which is at most pi/2, with all its digits.
FN float one_minus_cos(float sine2) {
    return sine2 / (1.0f + sqrt(max(1.0f - sine2, 0.0f)));
}

// Uniform within the cone about unit `axis` that is given by 1 - cos of its half angle.
FN vec3 sample_cone(vec2 u, vec3 axis, float cone_one_minus_cos) {
    float v = u.x * cone_one_minus_cos;
    float sine = sqrt(max(v * (2.0f - v), 0.0f));
    float phi = TWO_PI * u.y;
    vec3 t;
    vec3 b;
    orthonormal_basis(axis, t, b);
    return normalize(sine * cos(phi) * t + sine * sin(phi) * b + (1.0f - v) * axis);
}

// The solid angle in sr of a sphere; 0 within it.
FN float sphere_solid_angle(vec3 to_center_m, float radius_m) {
    float distance2 = dot(to_center_m, to_center_m);
    return distance2 > square(radius_m) ? TWO_PI * one_minus_cos(square(radius_m) / distance2) : 0.0f;
}
FN float pdf_sphere(vec3 to_center_m, float radius_m) {
    float solid_angle = sphere_solid_angle(to_center_m, radius_m);
    return solid_angle > 0.0f ? 1.0f / solid_angle : 0.0f;
}
FN LightDirection sample_sphere(vec2 u, vec3 to_center_m, float radius_m) {
    LightDirection s = no_light_direction();
    float distance2 = dot(to_center_m, to_center_m);
    if (distance2 <= square(radius_m)) return s;
    float distance = sqrt(distance2);
    s.direction = sample_cone(u, to_center_m / distance, one_minus_cos(square(radius_m) / distance2));
    // Rounding may put a direction on the rim just outside: the nearest point of the ray stands in.
    float along = dot(to_center_m, s.direction);
    vec3 miss = to_center_m - along * s.direction;
    s.distance_m = max(along - sqrt(max(square(radius_m) - dot(miss, miss), 0.0f)), 0.0f);
    s.pdf = pdf_sphere(to_center_m, radius_m);
    return s;
}

// The sun's disc, angular_radius_rad about unit to_sun. 1 - cos as 2 sin^2 of the half, which keeps its digits.
FN float sun_one_minus_cos(float angular_radius_rad) {
    return 2.0f * square(sin(0.5f * angular_radius_rad));
}
FN float pdf_sun(float angular_radius_rad) {
    return 1.0f / (TWO_PI * sun_one_minus_cos(angular_radius_rad));
}
FN vec3 sample_sun(vec2 u, vec3 to_sun, float angular_radius_rad) {
    return sample_cone(u, to_sun, sun_one_minus_cos(angular_radius_rad));
}
// Whether a unit direction meets the disc.
FN bool meets_sun(vec3 direction, vec3 to_sun, float angular_radius_rad) {
    vec3 apart = direction - to_sun;
    return dot(apart, apart) <= 2.0f * sun_one_minus_cos(angular_radius_rad);
}
// The solar limb darkening law at 550 nm, I(mu) / I(1) = 0.30 + 0.93 mu - 0.23 mu^2 (Cox 2000, "Allen's Astrophysical
// Quantities", 4th edition, section 14.7: u = 0.93, v = -0.23), over its mean over the disc, 0.30 + 0.93 2/3 - 0.23/2,
// so that the illuminance stays what it is. mu: cosine between the line of sight and the normal of the sun's surface.
FN float limb_darkening(float mu) {
    return (0.30f + mu * (0.93f - 0.23f * mu)) / 0.805f;
}
// Luminance per lx at normal incidence (1/sr) towards a direction that meets the disc. With limb darkening the distance
// from the centre over the disc's radius is the ratio of the sines.
FN float sun_nit_from_lx(vec3 direction, vec3 to_sun, float angular_radius_rad, bool darkened_limb) {
    float even = sun_nit_from_lx(1.0f, 2.0f * angular_radius_rad);
    if (!darkened_limb) return even;
    vec3 off = cross(direction, to_sun);
    return even * limb_darkening(sqrt(max(1.0f - dot(off, off) / square(sin(angular_radius_rad)), 0.0f)));
}

// A point of a line light: a diffuse cylinder too thin to have a luminance, so that each part of its length gives
// I sin(theta) / length towards theta from the axis, and I is its intensity at right angles to the axis.
struct LinePoint {
    vec3 to_point_m;
    float per_m2;  // lx at normal incidence per cd of the whole line, over the density: the estimate
};

// Drawn in proportion to its share of the illuminance at normal incidence, D / d^3 with D the distance from the axis and d
// that from the point: uniform in the sine of the angle from the perpendicular. Seen nearly end-on that has no digits, and
// the point is drawn uniformly. As for punctual lights the inverse square ends at 1 cm (Frostbite, equation 14).
FN LinePoint sample_line(float u, vec3 to_center_m, vec3 axis, float half_length_m) {
    float center = dot(to_center_m, axis);
    vec3 across = to_center_m - center * axis;
    float across2 = dot(across, across);
    float low = center - half_length_m;
    float high = center + half_length_m;
    float to_low = sqrt(low * low + across2);
    float to_high = sqrt(high * high + across2);
    bool one_side = low * high > 0.0f;
    bool end_on = one_side && across2 < 1.0e-4f * min(low * low, high * high);
    LinePoint p;
    p.per_m2 = 0.0f;
    p.to_point_m = to_center_m;
    if (!(across2 > 0.0f) || !(half_length_m > 0.0f)) return p;
    float at;
    float over_density;
    if (end_on) {
        at = low + u * (high - low);
        float distance2 = at * at + across2;
        over_density = sqrt(across2 / distance2) / distance2;
    } else {
        float sine_low = low / to_low;
        // Of two ends on one side, the difference of their sines by the difference of their squares.
        float difference = one_side ? across2 * (high * high - low * low) /
                                          ((high * to_low + low * to_high) * to_low * to_high)
                                    : high / to_high - sine_low;
        float sine = sine_low + u * difference;
        at = clamp(sqrt(across2 / max(1.0f - sine * sine, 1.0e-12f)) * sine, low, high);
        over_density = difference / (2.0f * half_length_m * sqrt(across2));
    }
    float distance2 = at * at + across2;
    p.to_point_m = across + at * axis;
    p.per_m2 = over_density * min(distance2 / square(kPunctualMinDistance_m), 1.0f);
    return p;
}

CANDELA_SHADING_END

#endif
