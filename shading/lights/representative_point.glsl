// Area lights as the one point that matters most for the highlight: Karis 2013, "Representative Point"; Lagarde & de Rousiers
// 2014, section 4.7.5. `mirror` (unit) is the mirror direction, or the dominant direction of the lobe
// (specular_dominant_direction_area), which is Frostbite's variant. A highlight is specular_at_point at the shape's point, times
// the shape's normalization and the light's illuminance.
#ifndef CANDELA_LIGHTS_REPRESENTATIVE_POINT_GLSL
#define CANDELA_LIGHTS_REPRESENTATIVE_POINT_GLSL

#include "../microfacet.glsl"
#include "contour.glsl"

CANDELA_SHADING_BEGIN

// The point of a sphere light that is nearest to the mirror ray, relative to the surface: Karis 2013, equation 11.
// to_center_m: from the surface to the sphere's centre; mirror: unit. Sign: the step is (L.r) r - L, towards the ray. The
// guard prevents 0/0 where the ray meets the centre.
FN vec3 representative_point_sphere(vec3 to_center_m, vec3 mirror, float radius_m) {
    vec3 center_to_ray = dot(to_center_m, mirror) * mirror - to_center_m;
    return to_center_m + center_to_ray * saturate(radius_m / max(length(center_to_ray), 1.0e-9f));
}

// GGX width that stands for the lobe convolved with the light's disc: Karis 2013, equation 10.
FN float alpha_widened_by_sphere(float alpha, float radius_m, float distance_m) {
    return saturate(alpha + radius_m / max(3.0f * distance_m, 1.0e-20f));
}

// Factor on the lobe that takes back the energy which moving the point has added: Karis 2013, equation 14.
FN float representative_point_sphere_normalization(float alpha, float radius_m, float distance_m) {
    return square(alpha / alpha_widened_by_sphere(alpha, radius_m, distance_m));
}

// D V of the light in one direction, 1/sr: the BRDF without Fresnel. distribution_alpha: for D; that of the surface, but for the
// "specular D modification", which widens it (Karis 2013, equation 10) and leaves the light where it is. A receiver on the light
// is its own nearest point, the null vector, and gets nothing.
FN float specular_at_point(vec3 n, vec3 v, vec3 to_point_m, float alpha, float distribution_alpha) {
    vec3 l = direction_of(to_point_m);
    float NoL = dot(n, l);
    if (NoL <= 0.0f) return 0.0f;
    return D_GGX(n, normalize(v + l), distribution_alpha) * V_SmithGGXCorrelated(max(dot(n, v), 0.0f), NoL, alpha);
}

// The point of a segment that is nearest to the mirror ray's line, as its share of the way from start to end: Karis 2013,
// equation 19. The guards prevent 0/0 where the ray runs along the segment, or the segment has no length.
FN float representative_share_of_line(vec3 start_m, vec3 end_m, vec3 mirror) {
    vec3 along = end_m - start_m;
    float on_mirror = dot(mirror, along);
    float numerator = dot(mirror, start_m) * on_mirror - dot(start_m, along);
    return saturate(numerator / max(dot(along, along) - on_mirror * on_mirror, 1.0e-9f * dot(along, along)));
}

// As above with the smallest angle to the ray: Picott 1992, in Karis 2013, equation 18. The denominator is what the ray's
// direction and the segment's make of the plane through both; 0 where the segment points at the receiver.
FN float representative_share_of_line_by_angle(vec3 start_m, vec3 end_m, vec3 mirror) {
    vec3 along = end_m - start_m;
    float on_mirror = dot(mirror, along);
    float start_on_mirror = dot(mirror, start_m);
    float start_on_along = dot(start_m, along);
    float numerator = start_on_along * start_on_mirror - dot(start_m, start_m) * on_mirror;
    float denominator = start_on_along * on_mirror - dot(along, along) * start_on_mirror;
    return saturate(numerator / (abs(denominator) > 1.0e-20f ? denominator : 1.0e-20f));
}

// Capsule: the point of its axis, then that of the sphere about it. Karis 2013, "Tube Lights".
FN vec3 representative_point_tube(vec3 to_center_m, vec3 axis, float half_length_m, float radius_m, vec3 mirror) {
    vec3 start_m = to_center_m - half_length_m * axis;
    vec3 end_m = to_center_m + half_length_m * axis;
    vec3 on_axis = mix(start_m, end_m, representative_share_of_line(start_m, end_m, mirror));
    return representative_point_sphere(on_axis, mirror, radius_m);
}

// Karis 2013, equation 20: a line widens the lobe in one direction only.
FN float representative_point_line_normalization(float alpha, float half_length_m, float distance_m) {
    return alpha / alpha_widened_by_sphere(alpha, half_length_m, distance_m);
}

// Both normalizations, Karis 2013, "Tube Lights".
FN float representative_point_tube_normalization(float alpha, float half_length_m, float radius_m, float distance_m) {
    return representative_point_line_normalization(alpha, half_length_m, distance_m) *
           representative_point_sphere_normalization(alpha, radius_m, distance_m);
}

// From the centre of a flat light to where the mirror ray meets its plane, in that plane. A ray that leads away from the plane is
// taken to meet it far out. direction: the way the light shines; the receiver is in front of it.
FN vec3 mirror_on_plane(vec3 to_center_m, vec3 direction, vec3 mirror) {
    float approach = min(dot(mirror, direction), -1.0e-4f);
    vec3 at = mirror * (dot(to_center_m, direction) / approach) - to_center_m;
    return at - dot(at, direction) * direction;
}

// The point of a disk nearest to where the mirror ray meets its plane: Lagarde & de Rousiers 2014, section 4.7.5, where no
// normalization was found.
FN vec3 representative_point_disk(vec3 to_center_m, vec3 direction, float radius_m, vec3 mirror) {
    vec3 at = mirror_on_plane(to_center_m, direction, mirror);
    return to_center_m + at * saturate(radius_m / max(length(at), 1.0e-9f));
}

// Rectangle, the same; it shines to where right x up points away from.
FN vec3 representative_point_rectangle(vec3 to_center_m, vec3 right, vec3 up, float half_width_m, float half_height_m,
                                       vec3 mirror) {
    vec3 at = mirror_on_plane(to_center_m, -cross(right, up), mirror);
    return to_center_m + clamp(dot(at, right), -half_width_m, half_width_m) * right +
           clamp(dot(at, up), -half_height_m, half_height_m) * up;
}

// Own: Karis's reasoning (equation 20) in both directions of a rectangle. A disk takes the sphere's.
FN float representative_point_rectangle_normalization(float alpha, float half_width_m, float half_height_m,
                                                      float distance_m) {
    return representative_point_line_normalization(alpha, half_width_m, distance_m) *
           representative_point_line_normalization(alpha, half_height_m, distance_m);
}

// The direction within the sun's disc that is nearest to the mirror direction, unit: Lagarde & de Rousiers 2014, section 4.6,
// listing 6. direction: unit, towards its centre. The guard prevents 0/0 where the two are one, and inside anyway.
FN vec3 representative_direction_of_sun(vec3 direction, vec3 mirror, float angular_radius_rad) {
    float edge = cos(angular_radius_rad);
    float inside = dot(direction, mirror);
    vec3 across = mirror - inside * direction;
    vec3 rim = edge * direction + (sin(angular_radius_rad) / max(length(across), 1.0e-9f)) * across;
    return inside < edge ? normalize(rim) : mirror;
}

// GGX width that stands for the lobe convolved with a disc much narrower than itself: with it the peak falls by what the disc sees of
// the lobe on average, (disc radius / (2 alpha))^2 in the second order. Own.
FN float alpha_widened_by_disc(float alpha, float angular_radius_rad) {
    return min(sqrt(alpha * alpha + 0.25f * square(angular_radius_rad)), 1.0f);
}

CANDELA_SHADING_END

#endif
