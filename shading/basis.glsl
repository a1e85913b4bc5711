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

CANDELA_SHADING_END

#endif
