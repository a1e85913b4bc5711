#version 460
#extension GL_GOOGLE_include_directive : require
#include "features.glsl"
#include "frame.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec4 normal;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec2 uv0;
layout(location = 4) in vec2 uv1;
layout(location = 5) in vec4 color;

layout(location = 0) out vec3 out_normal;
layout(location = 1) out vec4 out_tangent;
layout(location = 2) out vec4 out_uv;
layout(location = 3) out vec4 out_color;
layout(location = 4) out vec3 out_position;

// Rows of the 3 x 4 object-to-world matrix.
layout(push_constant) uniform Push {
    vec4 row0;
    vec4 row1;
    vec4 row2;
    uvec4 ids;
} object;

invariant gl_Position;

void main() {
    vec4 p = vec4(position, 1.0);
    vec3 world = vec3(dot(object.row0, p), dot(object.row1, p), dot(object.row2, p));
    // Normals transform by the cofactors of the matrix, which needs no inverse and keeps its sign when it mirrors.
    vec3 c0 = cross(object.row1.xyz, object.row2.xyz);
    vec3 c1 = cross(object.row2.xyz, object.row0.xyz);
    vec3 c2 = cross(object.row0.xyz, object.row1.xyz);
    float handedness = dot(object.row0.xyz, c0) < 0.0 ? -1.0 : 1.0;
    vec3 n = vec3(dot(c0, normal.xyz), dot(c1, normal.xyz), dot(c2, normal.xyz)) * handedness;
    vec3 t = vec3(dot(object.row0.xyz, tangent.xyz), dot(object.row1.xyz, tangent.xyz), dot(object.row2.xyz, tangent.xyz));
    out_normal = n * inversesqrt(max(dot(n, n), 1e-30));
    // What the fragment shader of this variant does not read is not worth computing for every vertex.
    bool tangents = has(kNormalTexture | kClearcoatNormalTexture | kLayered);
    out_tangent = tangents ? vec4(t * inversesqrt(max(dot(t, t), 1e-30)), tangent.w * handedness) : vec4(0.0);
    out_uv = has(kAnyTexture) ? vec4(uv0, uv1) : vec4(0.0);
    out_color = has(kVertexColor) ? color : vec4(0.0);
    out_position = kForward ? world : vec3(0.0);
    gl_Position = frame.world_to_clip * vec4(world, 1.0);
}
