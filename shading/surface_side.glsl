// Which side of a surface with a normal map a direction is on. surface_normal: unit, interpolated from the vertices, without
// the map, on the viewer's side.
#ifndef CANDELA_SURFACE_SIDE_GLSL
#define CANDELA_SURFACE_SIDE_GLSL

#include "language.glsl"

CANDELA_SHADING_BEGIN

// Whether the surface can be lit from unit l. A map turns part of the hemisphere about its normal below the surface itself:
// light from there comes through the surface, and what would leave in such a direction meets the surface again. Neither
// counts, in any mode.
FN bool above_surface(vec3 surface_normal, vec3 l) {
    return dot(surface_normal, l) > 0.0f;
}

// Part of the cosine-weighted hemisphere about a mapped normal that is above the surface: half a unit disk and half of the
// ellipse that the surface's horizon is projected to (Nusselt's analog). cosine: of the angle between both normals.
FN float hemisphere_above_surface(float cosine) {
    return 0.5f * (1.0f + clamp(cosine, -1.0f, 1.0f));
}

// Part of a GGX lobe about unit `direction` that is on the side of `normal`. Slopes of half-vectors in any one direction have
// the density alpha^2 / (2 (alpha^2 + m^2)^(3/2)), of which the integral is this; the horizon is at the slope m of half the
// angle to it.
FN float lobe_on_side(vec3 direction, vec3 normal, float alpha) {
    float sine = clamp(dot(direction, normal), -1.0f, 1.0f);
    float cosine = sqrt(max(1.0f - sine * sine, 0.0f));
    float m = sine / (1.0f + cosine);
    return 0.5f + 0.5f * m * inversesqrt(max(alpha * alpha + m * m, 1.0e-12f));
}

// Where the lobe of n and its mirror direction stands as a whole: wide ones lean to the normal, and outwards where they are due
// to the rise of Fresnel's reflectance (fresnel_rise, the part of their light). Own fit to the sums of lobe_above_surface.
FN vec3 lobe_axis(vec3 n, vec3 mirror, float alpha, float fresnel_rise) {
    float lean = max(1.8f - 4.0f * fresnel_rise, -1.0f) * alpha * alpha;
    return normalize(mix(mirror, n, lean));
}

// Part of the light of a lobe under a uniform surrounding that is left when what is below the surface does not count. n: the
// mapped normal, whose own horizon the lobe already ends at; mirror: unit, of the viewer at n. Both horizons are passed with
// lobe_on_side(); how they go together, by the angle between them as seen along the lobe, is linear between none of one with
// the other, independence and one within the other. 1 where there is no map. Candela's own; mean error 0.02 for metals and
// for dielectrics, at most 0.12, over maps of 30 to 60 degrees and perceptual roughness 0.1 to 0.7.
FN float lobe_above_surface(vec3 mirror, vec3 n, vec3 surface_normal, float alpha, float fresnel_rise) {
    vec3 axis = lobe_axis(n, mirror, alpha, fresnel_rise);
    float above_surface_part = lobe_on_side(axis, surface_normal, alpha);
    float above_map_part = max(lobe_on_side(axis, n, alpha), 1.0e-4f);
    vec3 to_surface = surface_normal - axis * dot(axis, surface_normal);
    vec3 to_map = n - axis * dot(axis, n);
    float together = dot(to_surface, to_map) * inversesqrt(max(dot(to_surface, to_surface) * dot(to_map, to_map), 1.0e-12f));
    float independent = above_surface_part * above_map_part;
    float within = min(above_surface_part, above_map_part);
    float apart = max(above_surface_part + above_map_part - 1.0f, 0.0f);
    float both = together > 0.0f ? mix(independent, within, together) : mix(independent, apart, -together);
    // Where the horizons are one, rounding of the angle does not count.
    float same = saturate(1.0f - 1.0e4f * (1.0f - dot(n, surface_normal)));
    return mix(saturate(both / above_map_part), 1.0f, same);
}

// A direction of a lobe of this alpha, moved to where the part of it that is above the surface is seen: by what the surface's
// horizon lifts it more than the map's own. Not unit. Candela's own estimate.
FN vec3 direction_above_surface(vec3 direction, vec3 n, vec3 surface_normal, float alpha) {
    float width = clamp(3.5f * alpha, 0.02f, 1.2f);
    float over_surface = dot(direction, surface_normal);
    float over_map = dot(direction, n);
    float lift = 0.5f * (sqrt(over_surface * over_surface + width * width) - over_surface);
    return direction + (lift * saturate((over_map - over_surface) / width)) * surface_normal;
}

CANDELA_SHADING_END

#endif
