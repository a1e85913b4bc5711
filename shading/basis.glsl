// Local frames with z along the normal.
#ifndef CANDELA_BASIS_GLSL
#define CANDELA_BASIS_GLSL

#include "language.glsl"

CANDELA_SHADING_BEGIN

// Right-handed orthonormal t, b, n from unit n, continuous but at n.z = 0: Duff et al. 2017, "Building an
// Orthonormal Basis, Revisited", listing 3.
FN void orthonormal_basis(vec3 n, OUT(vec3) t, OUT(vec3) b) {
    float s = n.z >= 0.0f ? 1.0f : -1.0f;
    float p = -1.0f / (s + n.z);
    float q = n.x * n.y * p;
    t = vec3(1.0f + s * n.x * n.x * p, s * q, -s * n.x);
    b = vec3(q, s + n.y * n.y * p, -n.y);
}

FN vec3 to_world(vec3 local, vec3 t, vec3 b, vec3 n) {
    return local.x * t + local.y * b + local.z * n;
}

FN vec3 to_local(vec3 world, vec3 t, vec3 b, vec3 n) {
    return vec3(dot(world, t), dot(world, b), dot(world, n));
}

// The normal turned towards the viewer until he sees it, at a cosine of 1e-4 or more. Interpolation and normal mapping
// turn normals away from him; clamping the cosine alone leaves a half-vector that belongs to another view than the
// clamped one, and the lobe that is evaluated then differs by orders of magnitude from the lobe that is drawn from.
FN vec3 normal_facing(vec3 n, vec3 v) {
    float NoV = dot(n, v);
    return NoV >= 1.0e-4f ? n : normalize(n + (1.0e-4f - NoV) * v);
}

// Whether a surface with a normal map can be lit from unit l. surface_normal: interpolated from the vertices, without the map,
// on the viewer's side. A map turns part of the hemisphere about its normal below the surface itself: light from there
// comes through the surface, and what would leave in such a direction meets the surface again. Neither counts, in any mode.
FN bool above_surface(vec3 surface_normal, vec3 l) {
    return dot(surface_normal, l) > 0.0f;
}

// Part of the cosine-weighted hemisphere about a mapped normal that is above the surface: half a unit disk and half of the
// ellipse that the surface's horizon is projected to (Nusselt's analog). cosine: of the angle between both normals.
FN float hemisphere_above_surface(float cosine) {
    return 0.5f * (1.0f + clamp(cosine, -1.0f, 1.0f));
}

CANDELA_SHADING_END

#endif
