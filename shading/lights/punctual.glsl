// How punctual lights fade with distance and angle.
// Source: Lagarde & de Rousiers 2014 ("Frostbite"), section 4.4 and listing 4; KHR_lights_punctual recommends the same
// cone, and the window without its square, which would end the light with an edge.
#ifndef CANDELA_LIGHTS_PUNCTUAL_GLSL
#define CANDELA_LIGHTS_PUNCTUAL_GLSL

#include "../language.glsl"
#include "../photometry.glsl"

CANDELA_SHADING_BEGIN

// Frostbite equation 26 with n = 4, of the square of distance over range.
FN float window_of_square(float share_of_range2) {
    return square(saturate(1.0f - share_of_range2 * share_of_range2));
}

// 1 near the light, 0 with zero slope from range_m on. range_m > 0; infinity: 1 everywhere.
FN float window_attenuation(float distance_m, float range_m) {
    return window_of_square(square(distance_m / range_m));
}

// 1/m^2, from cd to lx at normal incidence: the inverse square with the light's size of 1 cm (Frostbite
// equation 14) times the window. to_light: from the surface to the light, m, any length.
FN float distance_attenuation(vec3 to_light, float range_m) {
    float distance2 = dot(to_light, to_light);
    return window_of_square(distance2 / square(range_m)) / max(distance2, square(kPunctualMinDistance_m));
}

// Frostbite listing 4, getAngleAtt: 0 outside the outer cone, 1 inside the inner one, the square of a ramp in
// the cosine between. cos_inner >= cos_outer. The guard is 1e-5 in place of Frostbite's 1e-3, which would dim
// the centre of every beam with a half angle under 2.6 degrees; at cos_inner == cos_outer it makes a sharp
// edge.
FN float angle_attenuation(float cos_angle, float cos_inner, float cos_outer) {
    return square(saturate((cos_angle - cos_outer) / max(cos_inner - cos_outer, 1.0e-5f)));
}

// From the receiver to the tip of the cone with this half angle whose rim is a disk light's: Frostbite listing 9.
FN vec3 disk_to_virtual_apex(vec3 to_center_m, vec3 direction, float radius_m, float tan_outer) {
    return to_center_m - direction * (radius_m / max(tan_outer, 1.0e-6f));
}

// What a disk light's cones leave of its light: what a spot's would, seen from that tip. It multiplies the illuminance as a whole,
// "without any realistic consideration", so that a disk goes over into the spot as it shrinks, but for its own cosine: Frostbite
// listing 9. Cosines of half angles in [0,1], cos_inner >= cos_outer; direction: unit, the way the disk shines.
FN float disk_cone_attenuation(vec3 to_center_m, vec3 direction, float radius_m, float cos_inner, float cos_outer) {
    float tan_outer = sqrt(max(1.0f - square(cos_outer), 0.0f)) / max(cos_outer, 1.0e-6f);
    vec3 to_apex = disk_to_virtual_apex(to_center_m, direction, radius_m, tan_outer);
    float cos_angle = -dot(direction, to_apex) * inversesqrt(max(dot(to_apex, to_apex), 1.0e-30f));
    return angle_attenuation(cos_angle, cos_inner, cos_outer);
}

// 1 within the rectangular pyramid of a frustum light, else 0 (Frostbite Table 9: a uniform intensity within it).
// travels: unit, from the light; direction, right, up: its frame; tangents of half its opening angles, which are under pi.
FN float frustum_attenuation(vec3 travels, vec3 direction, vec3 right, vec3 up, float tan_half_horizontal,
                             float tan_half_vertical) {
    float ahead = dot(travels, direction);
    bool inside = ahead > 0.0f && abs(dot(travels, right)) <= ahead * tan_half_horizontal &&
                  abs(dot(travels, up)) <= ahead * tan_half_vertical;
    return inside ? 1.0f : 0.0f;
}

CANDELA_SHADING_END

#endif
