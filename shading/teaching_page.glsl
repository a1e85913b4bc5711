// The teaching page on the Unreal Engine 4 subset, word by word where it differs from Karis 2013, so that the difference
// can be measured (candela validate --only teaching_page) and seen (the profile lesson-literal beside lesson). Its D, k and F are
// Karis's: microfacet.glsl, fresnel.glsl.
#ifndef CANDELA_TEACHING_PAGE_GLSL
#define CANDELA_TEACHING_PAGE_GLSL

#include "language.glsl"

CANDELA_SHADING_BEGIN

// Teaching page, section 3, item 5: its denominator says n.v for both directions x, where Karis 2013, equation 4, has n.x.
FN float G1_TeachingPage(float NoX, float NoV, float k) {
    return NoX / (NoV * (1.0f - k) + k);
}

// G1 of both directions over 4 n.l n.v, as the page has it: n.l cancels, so that light and view may not be exchanged. NoV in (0,1].
FN float V_TeachingPage(float NoV, float k) {
    return 0.25f / square(NoV * (1.0f - k) + k);
}

// Teaching page, section 3, item 2: the direction that replaces the light's for specular. l, v and mirror (v about the
// normal) are unit. The page takes v.r where Karis 2013, equation 11, has l.r, and moves the point by the fraction
// radius/distance of the way to the ray where Karis moves it by the radius.
FN vec3 representative_direction_TeachingPage(vec3 l, vec3 v, vec3 mirror, float radius_over_distance) {
    vec3 center_to_ray = l - dot(v, mirror) * mirror;
    return normalize(l - center_to_ray * saturate(radius_over_distance));
}

CANDELA_SHADING_END

#endif
