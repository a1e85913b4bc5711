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

CANDELA_SHADING_END

#endif
