// Area lights as the one point that matters most for the highlight: Karis 2013, "Representative Point".
#ifndef CANDELA_LIGHTS_REPRESENTATIVE_POINT_GLSL
#define CANDELA_LIGHTS_REPRESENTATIVE_POINT_GLSL

#include "../language.glsl"

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
    return saturate(alpha + radius_m / (3.0f * distance_m));
}

// Factor on the lobe that takes back the energy which moving the point has added: Karis 2013, equation 14.
FN float representative_point_sphere_normalization(float alpha, float radius_m, float distance_m) {
    return square(alpha / alpha_widened_by_sphere(alpha, radius_m, distance_m));
}

CANDELA_SHADING_END

#endif
