// Cube maps in the layer order of Vulkan, Direct3D, KTX and DDS: +X -X +Y -Y +Z -Z, seen from inside, row 0 on top, left-handed as
// those APIs have it. A direction of Candela's own right-handed world names the same point of a face that the APIs' samplers
// find for it; what a file holds is told by its writer.
#ifndef CANDELA_CUBE_GLSL
#define CANDELA_CUBE_GLSL

#include "language.glsl"

CANDELA_SHADING_BEGIN

// Not unit: the point of the cube of half side 1. uv in [0,1] of face 0 to 5. Vulkan 1.3, "Cube Map Face Selection", solved for the
// direction.
FN vec3 cube_point(int face, vec2 uv) {
    float s = 2.0f * uv.x - 1.0f;
    float t = 2.0f * uv.y - 1.0f;
    if (face == 0) return vec3(1.0f, -t, -s);
    if (face == 1) return vec3(-1.0f, -t, s);
    if (face == 2) return vec3(s, 1.0f, t);
    if (face == 3) return vec3(s, -1.0f, -t);
    if (face == 4) return vec3(s, -t, 1.0f);
    return vec3(-s, -t, -1.0f);
}

// x, y: uv in [0,1]; z: face. direction need not be unit, but not zero. Vulkan 1.3, "Cube Map Face Selection".
FN vec3 cube_uv_face(vec3 direction) {
    vec3 a = abs(direction);
    if (a.x >= a.y && a.x >= a.z) {
        bool positive = direction.x >= 0.0f;
        float s = positive ? -direction.z : direction.z;
        return vec3(0.5f * s / a.x + 0.5f, 0.5f - 0.5f * direction.y / a.x, positive ? 0.0f : 1.0f);
    }
    if (a.y >= a.z) {
        bool positive = direction.y >= 0.0f;
        float t = positive ? direction.z : -direction.z;
        return vec3(0.5f * direction.x / a.y + 0.5f, 0.5f * t / a.y + 0.5f, positive ? 2.0f : 3.0f);
    }
    bool positive = direction.z >= 0.0f;
    float s = positive ? direction.x : -direction.x;
    return vec3(0.5f * s / a.z + 0.5f, 0.5f - 0.5f * direction.y / a.z, positive ? 4.0f : 5.0f);
}

// Solid angle in sr of the part of a face of half side 1 between its centre and (x, y), with the sign of x y.
FN float cube_corner_solid_angle(float x, float y) {
    return atan(x * y, sqrt(x * x + y * y + 1.0f));
}

// Exact solid angle in sr of texel (x, y) of a face of `size` texels a side; all of a cube sum to 4 pi.
FN float cube_texel_solid_angle(uint x, uint y, uint size) {
    float step = 2.0f / float(size);
    float left = float(x) * step - 1.0f;
    float top = float(y) * step - 1.0f;
    float right = left + step;
    float bottom = top + step;
    return cube_corner_solid_angle(right, bottom) - cube_corner_solid_angle(left, bottom) -
           cube_corner_solid_angle(right, top) + cube_corner_solid_angle(left, top);
}

CANDELA_SHADING_END

#endif
