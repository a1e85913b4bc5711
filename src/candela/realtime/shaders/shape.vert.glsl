#version 460
#extension GL_GOOGLE_include_directive : require
// A box around the shape of a light, its twelve triangles made from the vertex's number. The fragment shader finds the shape.
#include "frame.glsl"
#include "lights.glsl"

layout(set = 0, binding = 1, std430) readonly buffer Lights { Light lights[]; };
layout(push_constant) uniform Push { uint index; } shape;

// Of the box by more than the shape: what rasterizing rounds away, and a thickness for flat shapes.
const float kMargin = 0.02;

vec3 half_sizes(Light light) {
    float radius = light.right_b.w;
    switch (int(light.color_type.w)) {
        case kLightRectangle: return vec3(light.direction_a.w, radius, 0.0);
        case kLightDisk: return vec3(radius, radius, 0.0);
        case kLightTube: return vec3(light.direction_a.w + radius, radius, radius);
        default: return vec3(radius);
    }
}

void main() {
    Light light = lights[shape.index];
    vec3 half_size = half_sizes(light);
    half_size += kMargin * max(half_size.x, max(half_size.y, half_size.z));
    // Two triangles a face; corners as bits x, y, z.
    const int corners[36] = int[](0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3, 0, 4, 5, 0, 5, 1,
                                  2, 3, 7, 2, 7, 6, 0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5);
    int corner = corners[gl_VertexIndex];
    vec3 side = vec3(corner & 1, corner >> 1 & 1, corner >> 2) * 2.0 - 1.0;
    vec3 up = cross(light.right_b.xyz, light.direction_a.xyz);
    vec3 offset = side * half_size;
    vec3 world = light.position_range.xyz + offset.x * light.right_b.xyz + offset.y * up - offset.z * light.direction_a.xyz;
    gl_Position = frame.world_to_clip * vec4(world, 1.0);
}
