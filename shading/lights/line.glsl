// Line lights: diffuse cylinders too thin to have a width, given by their luminous intensity in cd perpendicular to the
// axis (units.glsl has the conversions).
#ifndef CANDELA_LIGHTS_LINE_GLSL
#define CANDELA_LIGHTS_LINE_GLSL

#include "../photometry.glsl"
#include "contour.glsl"

CANDELA_SHADING_BEGIN

// Illuminance in lx per cd, with the horizon: exact. The integral over the length of
// sin(psi) <n . l> / distance^2, psi between axis and direction; with the position along the axis as the distance from it
// times tan(t) the integrand is cos t (n_axis sin t + n_across cos t): closed (Heitz & Hill 2017, "Real-Time Line- and
// Disk-Light Shading", here with the differences of its bounds multiplied out so that nothing cancels far
// away, and clipped at the horizon). A lamp has a thickness: nearer than 1 cm illuminance stays what it is there.
FN float line_illuminance(vec3 n, vec3 to_center_m, vec3 axis, float half_length_m) {
    float half_length = max(half_length_m, 1.0e-4f);
    float middle = dot(to_center_m, axis);
    vec3 across = to_center_m - middle * axis;
    float beyond_end_m = max(abs(middle) - half_length, 0.0f);
    float thickness2 = max(square(kPunctualMinDistance_m) - square(beyond_end_m), 1.0e-12f);
    float distance_m = sqrt(max(dot(across, across), thickness2));
    float n_axis = dot(n, axis);
    float n_across = dot(n, across) / distance_m;

    // Above the horizon: from start to end along the axis, both relative to the receiver's foot on it.
    float start = middle - half_length;
    float end = middle + half_length;
    float height_start = start * n_axis + distance_m * n_across;
    float height_end = end * n_axis + distance_m * n_across;
    if (height_start <= 0.0f && height_end <= 0.0f) return 0.0f;
    float share = height_start / (height_start - height_end);
    float crossing = start + 2.0f * half_length * share;
    float visible_share = 1.0f;
    if (height_start < 0.0f) {
        visible_share = 1.0f - share;
        start = crossing;
    } else if (height_end < 0.0f) {
        visible_share = share;
        end = crossing;
    }
    float visible_m = 2.0f * half_length * visible_share;

    float d2 = square(distance_m);
    float start2 = square(start) + d2;
    float end2 = square(end) + d2;
    float angle = half_turn_angle(distance_m * visible_m, d2 + start * end) / (2.0f * half_length * distance_m);
    float sines = visible_share / (start2 * end2);
    return max(0.5f * (n_axis * distance_m * (start + end) * sines +
                       n_across * (angle + (d2 - start * end) * sines)), 0.0f);
}

CANDELA_SHADING_END

#endif
