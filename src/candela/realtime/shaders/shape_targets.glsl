// The luminance of a light's shape where the ray through the pixel meets it (Frostbite Figure 51). The ray is met exactly, so
// edges are where they are and supersampling smooths them. With SHAPE_ALL_TARGETS the ids are written too.
#include "frame.glsl"
#include "gbuffer.glsl"
#include "lights.glsl"
#include "lights/intersect.glsl"

layout(set = 0, binding = 1, std430) readonly buffer Lights { Light lights[]; };
layout(set = 0, binding = 2, std430) readonly buffer LightTables { float light_tables[]; };
#include "light_pictures.glsl"

layout(push_constant) uniform Push { uint index; } shape;

layout(location = 0) out uvec4 out_gbuffer;
layout(location = 1) out vec4 out_light;
#ifdef SHAPE_ALL_TARGETS
layout(location = 2) out uvec2 out_ids;
#endif

float meet(Light light, vec3 ray, vec3 to_center_m) {
    vec3 direction = light.direction_a.xyz;
    vec3 right = light.right_b.xyz;
    // The side that faces the ray's start shines too.
    if ((light.links.x & kLightTwoSided) != 0 && dot(direction, to_center_m) > 0.0) direction = -direction;
    switch (int(light.color_type.w)) {
        case kLightRectangle:
            return enter_rectangle(ray, to_center_m, right, cross(right, direction), light.direction_a.w, light.right_b.w);
        case kLightDisk: return enter_disk(ray, to_center_m, direction, light.right_b.w);
        case kLightTube: return enter_tube(ray, to_center_m, right, light.direction_a.w, light.right_b.w);
        default: return enter_sphere(ray, to_center_m, light.right_b.w);
    }
}

// What a rectangle's picture shows at a point, with the pixel's footprint.
vec3 picture_at(Light light, vec3 from_center_m) {
    if (int(light.color_type.w) != kLightRectangle) return vec3(1.0);
    vec3 right = light.right_b.xyz;
    vec2 uv = rectangle_image_uv(from_center_m, right, cross(right, light.direction_a.xyz), light.direction_a.w, light.right_b.w);
    vec2 dx = dFdx(uv);
    vec2 dy = dFdy(uv);
    return read_picture(light, vec3(uv, abs(dx.x * dy.y - dx.y * dy.x)));
}

void main() {
    Light light = lights[shape.index];
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    bool perspective = frame.camera_position.w > 0.5;
    vec3 start = perspective ? frame.camera_position.xyz : world_position(vec2(pixel) + 0.5, 1.0);
    vec3 ray = normalize(pixel_ray(pixel));
    float t = meet(light, ray, light.position_range.xyz - start);
    vec3 picture = picture_at(light, start + t * ray - light.position_range.xyz);
    if (t < 0.0) discard;
    vec4 clip = frame.world_to_clip * vec4(start + t * ray, 1.0);
    gl_FragDepth = clip.z / clip.w;
    out_gbuffer = uvec4(packSnorm2x16(octahedral_encode(-ray)), 0u, kClassUnlit << 28u, kEmitterMark);
    out_light = vec4(pre_exposed(light.color_type.rgb * picture), 1.0);
#ifdef SHAPE_ALL_TARGETS
    out_ids = uvec2(0u);
#endif
}
