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

// Part of a lobe about unit `reflection` that is above the surface: a disc whose radius is the sine of twice the
// half-vectors' slope alpha in [0,1]. Candela's own estimate.
FN float lobe_above_surface(vec3 reflection, vec3 surface_normal, float alpha) {
    float radius = clamp(2.0f * alpha, 0.01f, 1.0f);
    return saturate(0.5f + 0.5f * dot(reflection, surface_normal) / radius);
}

CANDELA_SHADING_END

#endif
