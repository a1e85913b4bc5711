// Which of many lights to draw: bounds of where lights are and which way they shine, and an estimate of what they give.
// Source: Conty Estevez & Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting".
#ifndef CANDELA_LIGHTS_EMISSION_CONE_GLSL
#define CANDELA_LIGHTS_EMISSION_CONE_GLSL

#include "punctual.glsl"

CANDELA_SHADING_BEGIN

// Normals of lights lie within cos_normals of the unit axis (-1: everywhere); light leaves a normal within cos_emission.
struct EmissionCone {
    vec3 axis;
    float cos_normals;
    float cos_emission;
    bool two_sided;
};

FN float sine_from_cosine(float cosine) {
    return sqrt(max(1.0f - cosine * cosine, 0.0f));
}
FN float angle_from_cosine(float cosine) {
    return atan(sine_from_cosine(cosine), cosine);
}

// cos and sin of max(a - b, 0) for angles in [0, pi] given by their sines and cosines.
FN float cos_difference(float sin_a, float cos_a, float sin_b, float cos_b) {
    return cos_a > cos_b ? 1.0f : cos_a * cos_b + sin_a * sin_b;
}
FN float sin_difference(float sin_a, float cos_a, float sin_b, float cos_b) {
    return cos_a > cos_b ? 0.0f : sin_a * cos_b - cos_a * sin_b;
}

// Smallest cone about two cones: Conty Estevez & Kulla 2018, algorithm 1.
FN EmissionCone unite_cones(EmissionCone a, EmissionCone b) {
    EmissionCone wide = a;
    EmissionCone thin = b;
    if (b.cos_normals < a.cos_normals) {
        wide = b;
        thin = a;
    }
    EmissionCone united = wide;
    united.cos_emission = min(a.cos_emission, b.cos_emission);
    united.two_sided = a.two_sided || b.two_sided;
    float wide_rad = angle_from_cosine(wide.cos_normals);
    float thin_rad = angle_from_cosine(thin.cos_normals);
    float between_rad = angle_from_cosine(clamp(dot(wide.axis, thin.axis), -1.0f, 1.0f));
    if (min(between_rad + thin_rad, PI) <= wide_rad) return united;
    float united_rad = 0.5f * (wide_rad + between_rad + thin_rad);
    vec3 about = cross(wide.axis, thin.axis);
    float about2 = dot(about, about);
    if (united_rad >= PI || about2 < 1.0e-12f) {
        united.cos_normals = -1.0f;
        return united;
    }
    // The wide axis turned in the plane of the two.
    vec3 across = cross(about, wide.axis) * inversesqrt(about2);
    float turn_rad = united_rad - wide_rad;
    united.axis = normalize(wide.axis * cos(turn_rad) + across * sin(turn_rad));
    united.cos_normals = cos(united_rad);
    return united;
}

// Estimate of what lights within a box give at a point: power over squared distance, times the best cosine at the lights
// and at the receiver that the bounds allow, times the best window. 0 only where nothing can arrive. Changed from the
// paper: the window, and a floor under the cosine at the light, so that a light seen edge-on is not drawn so rarely that
// its weight explodes. to_point: from the middle of the box; n: unit normal of the receiver.
FN float emission_importance(EmissionCone cone, float power, float range_m, vec3 half_size_m, vec3 to_point, vec3 n) {
    float distance2 = dot(to_point, to_point);
    float radius2 = dot(half_size_m, half_size_m);
    float clamped2 = max(distance2, max(0.25f * radius2, 1.0e-10f));
    if (distance2 <= radius2) return power / clamped2;
    float distance_m = sqrt(distance2);
    float window = window_attenuation(distance_m - sqrt(radius2), range_m);
    vec3 direction = to_point / distance_m;
    float sin_box2 = radius2 / distance2;
    float sin_box = sqrt(sin_box2);
    float cos_box = sqrt(1.0f - sin_box2);
    float cos_axis = dot(cone.axis, direction);
    if (cone.two_sided) cos_axis = abs(cos_axis);
    float sin_axis = sine_from_cosine(cos_axis);
    float sin_normals = sine_from_cosine(cone.cos_normals);
    float cos_x = cos_difference(sin_axis, cos_axis, sin_normals, cone.cos_normals);
    float sin_x = sin_difference(sin_axis, cos_axis, sin_normals, cone.cos_normals);
    float cos_at_light = cos_difference(sin_x, cos_x, sin_box, cos_box);
    if (cos_at_light <= cone.cos_emission - 1.0e-3f) return 0.0f;
    float cos_receiver = -dot(direction, n);
    float best_receiver = cos_difference(sine_from_cosine(cos_receiver), cos_receiver, sin_box, cos_box);
    if (best_receiver <= 0.0f) return 0.0f;
    return power * window * max(cos_at_light, 0.02f) * best_receiver / clamped2;
}

CANDELA_SHADING_END

#endif
