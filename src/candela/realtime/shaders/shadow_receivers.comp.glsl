#version 460
#extension GL_GOOGLE_include_directive : require
// What the visibility pass needs to know of each pixel: where it is, and the facet that it shows.
#include "frame.glsl"
#include "octahedral.glsl"
#include "shadow_receivers.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
// In x the octahedral normal of the vertices, without normal maps: the G-buffer's where no surface has one.
layout(set = 0, binding = 1) uniform usampler2D normal_image;
layout(set = 0, binding = 2) uniform sampler2D depth_image;
layout(set = 0, binding = 3, rgba32ui) writeonly uniform uimage2D receiver_image;

// Between a facet and the smooth surface that it stands for, as a length between unit normals.
const float kMostLean = 0.3;
// Neighbours on one smooth surface are not turned from one another by more.
const float kMostTurn = 0.7;
// What is turned by less is parallel.
const float kLeastTurn = 0.05;
// Times the way to the next pixel on the steepest slope of the surface's own plane.
const float kMostApartPixels = 2.5;

const ivec2 kRightwards = ivec2(1, 0);
const ivec2 kDownwards = ivec2(0, 1);

// The point that a pixel shows, from what its place alone makes of the matrix: neighbours differ by one of its columns.
vec3 point_at(vec4 place, float depth) {
    vec4 p = place + depth * frame.clip_to_world[2];
    return p.xyz / p.w;
}
float depth_at(ivec2 pixel) { return texelFetch(depth_image, clamp(pixel, ivec2(0), frame.size.xy - 1), 0).r; }

// Way to the neighbour pixel along `step` or against it, whichever lies flatter on the plane of the vertices' normal: that one is
// likely on the same facet. Outside the picture there is none.
vec3 way_along(ivec2 pixel, ivec2 step, vec4 place, vec4 place_step, vec3 position, vec3 n, out ivec2 neighbour) {
    ivec2 after = pixel + step;
    ivec2 before = pixel - step;
    vec3 forward = point_at(place + place_step, depth_at(after)) - position;
    vec3 backward = position - point_at(place - place_step, depth_at(before));
    float forward2 = dot(forward, forward);
    float backward2 = dot(backward, backward);
    float rise = dot(n, forward);
    float fall = dot(n, backward);
    bool use_forward = rise * rise * backward2 < fall * fall * forward2;
    if (!(forward2 < 1e30) || any(greaterThanEqual(after, frame.size.xy))) use_forward = false;
    if (!(backward2 < 1e30) || any(lessThan(before, ivec2(0)))) use_forward = true;
    neighbour = use_forward ? after : before;
    return use_forward ? forward : backward;
}

// How far the vertices' normal at a neighbour is turned from n, as a length between unit normals.
float turn_to(ivec2 neighbour, vec3 n) {
    return distance(octahedral_decode(unpackSnorm2x16(texelFetch(normal_image, neighbour, 0).x)), n);
}

// The facet that the pixel shows, from the depth about it: its normal, and as far as it stands for a smooth surface how
// high its neighbours may rise above it. At an edge the normal is uncertain by the angle between facet and smooth
// surface, and a neighbour as long as twice that angle times the radius of curvature. Where there is no facet, as on a
// blade of grass, the vertices' normal must do.
vec4 facet_at(ivec2 pixel, vec4 place, vec3 position, vec3 n) {
    vec3 v = view_direction(position);
    ivec2 right;
    ivec2 down;
    vec2 px = 2.0 / vec2(frame.size.xy);
    vec3 way_right = way_along(pixel, kRightwards, place, px.x * frame.clip_to_world[0], position, n, right);
    vec3 way_down = way_along(pixel, kDownwards, place, px.y * frame.clip_to_world[1], position, n, down);
    // At a silhouette all neighbours are far away.
    float ray_depth = -dot(pixel_ray(pixel), frame.camera_backward.xyz);
    float depth_m = dot(frame.camera_position.xyz - position, frame.camera_backward.xyz);
    float pixel_m = frame.camera_position.w > 0.5 ? length(frame.ray_dx.xyz) * depth_m / max(ray_depth, 1e-9) : 0.0;
    float shorter_m = sqrt(min(dot(way_right, way_right), dot(way_down, way_down)));
    if (pixel_m > 0.0 && shorter_m > 8.0 * pixel_m) return vec4(n, 0.0);
    vec3 across = cross(way_right, way_down);
    float area2 = dot(across, across);
    if (!(area2 > 0.0)) return vec4(n, 0.0);
    across *= (dot(across, v) < 0.0 ? -1.0 : 1.0) * inversesqrt(area2);
    if (dot(across, n) < 0.7) return vec4(n, 0.0);
    float lean = distance(across, n);
    if (lean < 0.01) return vec4(across, lean < 0.002 ? 0.0 : 1e-4);
    float turn_right = turn_to(right, n);
    float turn_down = turn_to(down, n);
    float right_m = length(way_right);
    float down_m = length(way_down);
    // What is farther away than the plane's own next pixel can be, and parallel or turned by much, is another surface: the top of
    // a box before the floor behind it.
    float apart_m = kMostApartPixels * pixel_m / max(dot(n, v), 0.05);
    bool beyond_right = right_m > apart_m && (turn_right < kLeastTurn || turn_right > kMostTurn);
    bool beyond_down = down_m > apart_m && (turn_down < kLeastTurn || turn_down > kMostTurn);
    if (pixel_m > 0.0 && (beyond_right || beyond_down)) return vec4(n, 0.0);
    // Behind an edge between two surfaces lies another one's facet.
    if (lean > kMostLean && max(turn_right, turn_down) > kMostTurn) return vec4(n, 0.0);
    // At a silhouette the neighbours tell little of the facet.
    if (lean > kMostLean && dot(n, v) < 0.35) across = n;
    lean = min(lean, kMostLean);
    // 1/m: how fast the vertices' normal turns on the way to the neighbours.
    float bend = max(turn_right / right_m, turn_down / down_m);
    // A neighbour far away is of another surface, and tells nothing of how this one bends.
    if (pixel_m > 0.0 && max(right_m, down_m) > 8.0 * pixel_m) bend = right_m < down_m ? turn_right / right_m : turn_down / down_m;
    return vec4(across, 3.0 * lean * lean / max(bend, 1e-3));
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, frame.size.xy))) return;
    float depth = texelFetch(depth_image, pixel, 0).r;
    vec2 ndc = (vec2(pixel) + 0.5) * (2.0 / vec2(frame.size.xy)) - 1.0;
    vec4 place = frame.clip_to_world[0] * ndc.x + frame.clip_to_world[1] * ndc.y + frame.clip_to_world[3];
    vec3 position = depth > 0.0 ? point_at(place, depth) : vec3(0.0);
    vec3 n = octahedral_decode(unpackSnorm2x16(texelFetch(normal_image, pixel, 0).x));
    if (dot(n, view_direction(position)) < 0.0) n = -n;
    uvec4 receiver = depth > 0.0 ? pack_receiver(position, facet_at(pixel, place, position, n)) : kNoReceiver;
    imageStore(receiver_image, pixel, receiver);
}
