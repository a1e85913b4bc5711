// Lines whose points shine alike in all directions, as Karis 2013 has tube lights. A lamp's line is a diffuse cylinder that
// gives less towards its ends: line.glsl. Positions of the two end points are relative to the receiver, in m; n: its unit
// normal; results in 1/m^2: lx per cd of the whole line in any one direction.
#ifndef CANDELA_LIGHTS_ISOTROPIC_LINE_GLSL
#define CANDELA_LIGHTS_ISOTROPIC_LINE_GLSL

#include "../language.glsl"

CANDELA_SHADING_BEGIN

// The right side of Karis 2013, equation 15. It is the mean of n.L / |L|^3 over the segment; the integral over its length, as
// the left side is printed, is this times |L1 - L0|. Right for a segment above the horizon. offset_m2 >= 0: added to the
// squared distances, so that nothing is divided by 0 (equations 9 and 16, which add 1 squared unit).
FN float isotropic_line_attenuation_unclipped(vec3 n, vec3 start_m, vec3 end_m, float offset_m2) {
    float start = max(length(start_m), 1.0e-18f);
    float end = max(length(end_m), 1.0e-18f);
    float cosines = dot(n, start_m) / start + dot(n, end_m) / end;
    return cosines / max(start * end + dot(start_m, end_m) + 2.0f * offset_m2, 1.0e-12f);
}

// Karis 2013, equation 16, as printed but for the offset, which is 1 there. Where the horizon cuts the segment it clamps the
// mean of the two cosines, so that light fades too early and ends while a part of the segment is in view.
FN float isotropic_line_attenuation_printed(vec3 n, vec3 start_m, vec3 end_m, float offset_m2) {
    return max(isotropic_line_attenuation_unclipped(n, start_m, end_m, offset_m2), 0.0f);
}

// The same with the segment cut at the horizon: equation 15 over what is above, times the fraction of the length that is.
// Exact for offset 0; of a segment without length, the point light of equation 9.
FN float isotropic_line_attenuation(vec3 n, vec3 start_m, vec3 end_m, float offset_m2) {
    float height_start = dot(n, start_m);
    float height_end = dot(n, end_m);
    if (height_start <= 0.0f && height_end <= 0.0f) return 0.0f;
    float crossing = height_start / (height_start - height_end);
    vec3 low = start_m;
    vec3 high = end_m;
    float visible = 1.0f;
    if (height_start < 0.0f) {
        low = mix(start_m, end_m, crossing);
        visible = 1.0f - crossing;
    } else if (height_end < 0.0f) {
        high = mix(start_m, end_m, crossing);
        visible = crossing;
    }
    return visible * max(isotropic_line_attenuation_unclipped(n, low, high, offset_m2), 0.0f);
}

// Sine between a lamp's axis and the direction to its middle: what its diffuse cylinder sends there over what it sends across the
// axis. 0 for a receiver in the middle.
FN float lamp_sine(vec3 to_center_m, vec3 axis) {
    vec3 across = cross(axis, to_center_m);
    return sqrt(dot(across, across) / max(dot(to_center_m, to_center_m), 1.0e-30f));
}

// Lamps by the line above: lx per cd across the axis. The sine is own: with it a small lamp is what its cylinder is in each
// direction, where a line that shines alike in all directions would be off by up to 4 / pi. Offset: Karis's 1 cm^2, the squared unit
// of his engine.
FN float lamp_line_illuminance(vec3 n, vec3 to_center_m, vec3 axis, float half_length_m) {
    vec3 half_m = half_length_m * axis;
    return lamp_sine(to_center_m, axis) *
           isotropic_line_attenuation(n, to_center_m - half_m, to_center_m + half_m, 1.0e-4f);
}

// Illuminance per luminance (sr) of a tube by its axis: the area that it shows times the line's mean. Exact for half_length_m = 0
// above the horizon, where it is a sphere. Inside of the tube the light stops growing.
FN float lamp_tube_projected_solid_angle(vec3 n, vec3 to_center_m, vec3 axis, float half_length_m, float radius_m) {
    vec3 half_m = half_length_m * axis;
    float area_m2 = radius_m * (4.0f * half_length_m * lamp_sine(to_center_m, axis) + PI * radius_m);
    return min(area_m2 * isotropic_line_attenuation(n, to_center_m - half_m, to_center_m + half_m, 1.0e-4f), PI);
}

CANDELA_SHADING_END

#endif
