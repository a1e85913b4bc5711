// Lights of every type and emissive triangles: what they send to a point from a direction, and directions drawn towards
// them. An emitter shines and is in nothing's way. C++: emitters.cpp.
#ifndef CANDELA_EMITTERS_GLSL
#define CANDELA_EMITTERS_GLSL

#include "lights.glsl"
#include "emitter_tree.glsl"
#include "ray_scene.glsl"
#include "lights/photometric.glsl"
#include "lights/sampling.glsl"
#include "lights/disk_sampling.glsl"
#include "lights/rectangle_sampling.glsl"
#include "lights/tube_sampling.glsl"
#include "lights/triangle.glsl"

const uint kItemTriangle = 1u;

// What arrives at a point from a direction, and how dense one emitter's draws are there.
struct Arrival {
    vec3 l;            // unit
    float distance_m;  // kNoEnd: infinitely far
    vec3 light;        // cd/m^2; of lights without extent the lx on a plane facing them, over pdf already
    float pdf;         // 1/sr; 0: nothing
    bool delta;        // without extent: no other draw finds it
};

const Arrival kNothing = Arrival(vec3(0.0, 0.0, 1.0), 0.0, vec3(0.0), 0.0, false);

// The lights as five quads each, in the order of the scene. links.w is their own here: the record of a profile or of an
// image, or -1.
Light light_at(uint index) {
    uint first = light_first() + 5u * index;
    return Light(uintBitsToFloat(table_quads[first]), uintBitsToFloat(table_quads[first + 1u]),
                 uintBitsToFloat(table_quads[first + 2u]), uintBitsToFloat(table_quads[first + 3u]),
                 ivec4(table_quads[first + 4u]));
}

int type_of(Light light) { return int(light.color_type.w); }

// A disk or rectangle that shines both ways is turned to the receiver.
float shining_side(Light light, vec3 to_center_m) {
    bool behind = dot(to_center_m, light.direction_a.xyz) > 0.0;
    return behind && (light.links.x & kLightTwoSided) != 0 ? -1.0 : 1.0;
}

vec3 window_times_color(Light light, vec3 to_center_m) {
    return light.color_type.rgb * window_attenuation(length(to_center_m), light.position_range.w);
}

// Luminance of a shape where a ray enters it.
vec3 light_luminance(Light light, vec3 to_center_m, vec3 l, float distance_m) {
    vec3 nit = window_times_color(light, to_center_m);
    if (type_of(light) == kLightDisk) {
        return nit * disk_cone(light, to_center_m, light.direction_a.xyz * shining_side(light, to_center_m));
    }
    if (type_of(light) != kLightRectangle || light.links.w < 0) return nit;
    vec3 up = cross(light.right_b.xyz, light.direction_a.xyz);
    vec2 uv = rectangle_image_uv(l * distance_m - to_center_m, light.right_b.xyz, up, light.direction_a.w, light.right_b.w);
    return nit * read_packed(uint(light.links.w), uv, true).rgb;
}

// What a profile makes of an intensity; travels: unit, from the light.
float profile_factor(Light light, vec3 travels) {
    if (light.links.w < 0) return 1.0;
    uvec4 profile = table_quads[profile_first() + uint(light.links.w)];
    vec3 up = cross(light.right_b.xyz, light.direction_a.xyz);
    vec3 local = vec3(dot(travels, light.right_b.xyz), dot(travels, up), -dot(travels, light.direction_a.xyz));
    PhotometricTaps taps = photometric_taps(local, int(profile.y), int(profile.z));
    uint first = profile_first_float() + profile.x;
    vec4 cd = vec4(table_floats[first + uint(taps.index.x)], table_floats[first + uint(taps.index.y)],
                   table_floats[first + uint(taps.index.z)], table_floats[first + uint(taps.index.w)]);
    return dot(taps.weight, cd);
}

// Distance in m at which the ray from the receiver enters a shape, or kNoEntry.
float enter_light(Light light, vec3 l, vec3 to_center_m) {
    int type = type_of(light);
    vec3 right = light.right_b.xyz;
    vec3 direction = light.direction_a.xyz * shining_side(light, to_center_m);
    if (type == kLightSphere) return enter_sphere(l, to_center_m, light.right_b.w);
    if (type == kLightTube) return enter_tube(l, to_center_m, right, light.direction_a.w, light.right_b.w);
    if (type == kLightDisk) return enter_disk(l, to_center_m, direction, light.right_b.w);
    if (type == kLightRectangle) {
        return enter_rectangle(l, to_center_m, right, cross(right, direction), light.direction_a.w, light.right_b.w);
    }
    return kNoEntry;
}

float pdf_light(Light light, vec3 l, vec3 to_center_m) {
    int type = type_of(light);
    vec3 right = light.right_b.xyz;
    vec3 direction = light.direction_a.xyz * shining_side(light, to_center_m);
    if (type == kLightSphere) return pdf_sphere(to_center_m, light.right_b.w);
    if (type == kLightTube) return pdf_tube(l, to_center_m, right, light.direction_a.w, light.right_b.w);
    if (type == kLightDisk) return pdf_disk(l, to_center_m, direction, light.right_b.w);
    return pdf_rectangle(l, to_center_m, right, cross(right, direction), light.direction_a.w, light.right_b.w);
}

LightDirection sample_shape(Light light, vec2 u, vec3 to_center_m) {
    int type = type_of(light);
    vec3 right = light.right_b.xyz;
    vec3 direction = light.direction_a.xyz * shining_side(light, to_center_m);
    if (type == kLightSphere) return sample_sphere(u, to_center_m, light.right_b.w);
    if (type == kLightTube) return sample_tube(u, to_center_m, right, light.direction_a.w, light.right_b.w);
    if (type == kLightDisk) return sample_disk(u, to_center_m, direction, light.right_b.w);
    return sample_rectangle(u, to_center_m, right, cross(right, direction), light.direction_a.w, light.right_b.w);
}

Arrival sample_line_light(Light light, float u, vec3 to_center_m) {
    LinePoint at = sample_line(u, to_center_m, light.right_b.xyz, light.direction_a.w);
    float distance_m = length(at.to_point_m);
    if (!(distance_m > 0.0)) return kNothing;
    return Arrival(at.to_point_m / distance_m, distance_m, window_times_color(light, to_center_m) * at.per_m2, 1.0, true);
}

// Point, spot, frustum, directional: one direction there is.
Arrival only_arrival(Light light, vec3 position) {
    vec3 l;
    vec3 lx = perpendicular_illuminance(type_of(light), light, position, l);
    if (type_of(light) == kLightDirectional) return Arrival(l, kNoEnd, lx, 1.0, true);
    return Arrival(l, distance(light.position_range.xyz, position), lx * profile_factor(light, -l), 1.0, true);
}

Arrival sample_light(Light light, vec2 u, vec3 position) {
    int type = type_of(light);
    vec3 to_center_m = light.position_range.xyz - position;
    if (type < kLightLine) return only_arrival(light, position);
    if (type == kLightLine) return sample_line_light(light, u.x, to_center_m);
    LightDirection s = sample_shape(light, u, to_center_m);
    return Arrival(s.direction, s.distance_m, light_luminance(light, to_center_m, s.direction, s.distance_m), s.pdf,
                   false);
}

// The sun's angular radius in rad stands where shapes have their radius.
vec3 sun_luminance(Light light, vec3 l) {
    bool darkened = (light.links.x & kLightLimbDarkening) != 0;
    return light.color_type.rgb * sun_nit_from_lx(l, -light.direction_a.xyz, light.right_b.w, darkened);
}
Arrival sample_sun_light(Light light, vec2 u) {
    vec3 l = sample_sun(u, -light.direction_a.xyz, light.right_b.w);
    return Arrival(l, kNoEnd, sun_luminance(light, l), pdf_sun(light.right_b.w), false);
}
// Of a direction that something else drew.
Arrival sun_from(Light light, vec3 l) {
    if (!meets_sun(l, -light.direction_a.xyz, light.right_b.w)) return kNothing;
    return Arrival(l, kNoEnd, sun_luminance(light, l), pdf_sun(light.right_b.w), false);
}

// An emissive triangle, counter-clockwise seen from its front.
struct EmissiveTriangle {
    uint first;  // its first quad
    vec3 a;
    vec3 b;
    vec3 c;
};
EmissiveTriangle triangle_at(uint index) {
    uint first = emissive_triangle_first() + 6u * index;
    return EmissiveTriangle(first, quad_vec3(first), quad_vec3(first + 1u), quad_vec3(first + 2u));
}

// Luminance at barycentric coordinates of its second and third corner, seen along l.
vec3 triangle_luminance(EmissiveTriangle t, vec3 l, vec2 at) {
    bool two_sided = table_quads[t.first + 2u].w != 0u;
    if (!two_sided && dot(cross(t.b - t.a, t.c - t.a), l) >= 0.0) return vec3(0.0);
    vec4 uv_ab = uintBitsToFloat(table_quads[t.first + 4u]);
    vec2 uv_c = uintBitsToFloat(table_quads[t.first + 5u].xy);
    vec2 uv = (1.0 - at.x - at.y) * uv_ab.xy + at.x * uv_ab.zw + at.y * uv_c;
    vec3 nit = quad_vec3(t.first + 3u) * read_packed(table_quads[t.first].w, uv, true).rgb;
    return kHasTransparency ? nit * (1.0 - transparency(table_quads[t.first + 1u].w, at)) : nit;
}

// Under this a triangle is flat enough for a point drawn on its area, and single precision too coarse for its sides.
const float kLeastSphericalTriangle_sr = 1.0e-3;

// The triangle as seen from the receiver.
struct SeenTriangle {
    vec3 a;  // unit
    vec3 b;
    vec3 c;
    float solid_angle_sr;
    bool spherical;
};
SeenTriangle see_triangle(EmissiveTriangle t, vec3 position) {
    SeenTriangle s;
    s.a = normalize(t.a - position);
    s.b = normalize(t.b - position);
    s.c = normalize(t.c - position);
    s.solid_angle_sr = triangle_solid_angle(s.a, s.b, s.c);
    s.spherical = s.solid_angle_sr > kLeastSphericalTriangle_sr && s.solid_angle_sr < 6.2;
    return s;
}
float pdf_triangle(EmissiveTriangle t, SeenTriangle s, vec3 l, float distance_m) {
    if (s.spherical) return 1.0 / s.solid_angle_sr;
    float projected = 0.5 * abs(dot(cross(t.b - t.a, t.c - t.a), l));
    return projected > 1.0e-20 ? distance_m * distance_m / projected : 0.0;
}

Arrival sample_triangle(EmissiveTriangle t, vec2 u, vec3 position) {
    SeenTriangle s = see_triangle(t, position);
    Arrival r = kNothing;
    vec2 at;
    if (s.spherical) {
        r.l = sample_spherical_triangle(s.a, s.b, s.c, u);
        vec3 normal = cross(t.b - t.a, t.c - t.a);
        float approach = dot(normal, r.l);
        if (approach == 0.0) return kNothing;
        r.distance_m = dot(normal, t.a - position) / approach;
        // Rounding may put a direction on the edge just outside, where the triangle's plane stands in for it.
        vec3 from_a = position + r.l * r.distance_m - t.a;
        float scale = 1.0 / max(dot(normal, normal), 1.0e-38);
        at.x = clamp(dot(cross(from_a, t.c - t.a), normal) * scale, 0.0, 1.0);
        at.y = clamp(dot(cross(t.b - t.a, from_a), normal) * scale, 0.0, 1.0 - at.x);
    } else {
        float root = sqrt(u.x);
        at = vec2(root * (1.0 - u.y), root * u.y);
        vec3 way = t.a + at.x * (t.b - t.a) + at.y * (t.c - t.a) - position;
        r.distance_m = length(way);
        r.l = way / max(r.distance_m, 1.0e-20);
    }
    if (!(r.distance_m > 0.0)) return kNothing;
    r.light = triangle_luminance(t, r.l, at);
    r.pdf = pdf_triangle(t, s, r.l, r.distance_m);
    return r;
}

// An item of the tree: 0 a light or kItemTriangle, its index, whether it casts shadows.
uvec4 emitter_item(uint item) { return table_quads[emitter_item_first() + item]; }

Arrival sample_item(uvec4 item, vec2 u, vec3 position) {
    if (item.x == kItemTriangle) return sample_triangle(triangle_at(item.y), u, position);
    return sample_light(light_at(item.y), u, position);
}

// Whether a ray from the receiver enters an item.
bool enters_item(uvec4 item, vec3 position, vec3 l) {
    if (item.x == kItemTriangle) {
        EmissiveTriangle t = triangle_at(item.y);
        vec2 at;
        return meet_triangle(position, l, t.a, t.b, t.c, at) > 0.0;
    }
    Light light = light_at(item.y);
    return enter_light(light, l, light.position_range.xyz - position) > 0.0;
}

// What a ray from the receiver meets of an item.
Arrival item_from(uvec4 item, vec3 position, vec3 l) {
    Arrival r = kNothing;
    r.l = l;
    if (item.x == kItemTriangle) {
        EmissiveTriangle t = triangle_at(item.y);
        vec2 at;
        r.distance_m = meet_triangle(position, l, t.a, t.b, t.c, at);
        if (!(r.distance_m > 0.0)) return kNothing;
        r.light = triangle_luminance(t, l, at);
        r.pdf = pdf_triangle(t, see_triangle(t, position), l, r.distance_m);
        return r;
    }
    Light light = light_at(item.y);
    vec3 to_center_m = light.position_range.xyz - position;
    r.distance_m = enter_light(light, l, to_center_m);
    if (!(r.distance_m > 0.0)) return kNothing;
    r.light = light_luminance(light, to_center_m, l, r.distance_m);
    r.pdf = pdf_light(light, l, to_center_m);
    return r;
}

#endif
