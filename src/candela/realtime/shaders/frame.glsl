// Set 0, binding 0 of every pass: the camera, the exposure and the environment of this frame. C++: FrameBlock.
#ifndef CANDELA_FRAME_GLSL
#define CANDELA_FRAME_GLSL

layout(set = 0, binding = 0, std140) uniform Frame {
    mat4 world_to_clip;
    mat4 clip_to_world;
    vec4 camera_position;   // m; w = 1 perspective, 0 orthographic
    vec4 camera_backward;   // unit, towards the viewer
    vec4 exposure;          // x pre-exposure (1 / nit), y its inverse, z footprint of a sample in pixels,
                            //   w the largest number that fits the light buffer
    vec4 environment;       // x cos, y sin of the rotation about +Y, z nit per texel unit, w 1 = drawn as background
    ivec4 size;             // x, y pixels; z lights; w unused
    ivec4 tiles;            // x, y tiles; z tiles in a class list; w 1 = unlit colours go to their own image
    vec4 ray;               // world direction through pixel (0, 0), any length
    vec4 ray_dx;            // its change per pixel
    vec4 ray_dy;
    ivec4 lights;           // of the light lists: x first entry of the list of all lights, y first of the room for others,
                            //   z entries in it; w index of the first sun
    ivec4 light_cells;      // x, y, z cells; w first of their lists
    vec4 light_slices;      // x nearest depth in m, y slices per natural logarithm of depth; z, w unused
    uvec4 random;           // x sample, y seed, z draws a sample (integrate.glsl); w unused
} frame;

// NaN as black: one sample of one pixel is wrong then, and not the mean of its samples, nor what is filtered from the picture.
vec3 without_nan(vec3 x) { return mix(x, vec3(0.0), isnan(x)); }

// What the light buffer stores of a luminance in cd/m^2. Half floats end at 65504, and beyond it is infinity.
vec3 pre_exposed(vec3 luminance_nit) { return min(without_nan(luminance_nit) * frame.exposure.x, vec3(frame.exposure.w)); }

vec3 world_position(vec2 pixel, float depth) {
    vec2 ndc = pixel / vec2(frame.size.xy) * 2.0 - 1.0;
    vec4 p = frame.clip_to_world * vec4(ndc, depth, 1.0);
    return p.xyz / p.w;
}

vec3 view_direction(vec3 position) {
    return frame.camera_position.w > 0.5 ? normalize(frame.camera_position.xyz - position) : frame.camera_backward.xyz;
}

// Into the environment's own frame: the environment turns counter-clockwise, so directions turn clockwise.
vec3 to_environment(vec3 d) {
    float c = frame.environment.x;
    float s = frame.environment.y;
    return vec3(c * d.x - s * d.z, d.y, s * d.x + c * d.z);
}

// The inverse of to_environment.
vec3 from_environment(vec3 d) {
    float c = frame.environment.x;
    float s = frame.environment.y;
    return vec3(c * d.x + s * d.z, d.y, c * d.z - s * d.x);
}

// From the camera through a pixel, unnormalised: linear in the pixel, so that it costs no matrix and no division.
vec3 pixel_ray(ivec2 pixel) {
    return frame.ray.xyz + float(pixel.x) * frame.ray_dx.xyz + float(pixel.y) * frame.ray_dy.xyz;
}

// Of the buffer of light lists (C++: LightListPlaces).
const int kFirstTileList = 1;

// Cells of lights: kCellSize pixels wide and high, slices of equal ratio in depth.
const int kCellSize = 32;
int light_slice(float depth_m) {
    return max(int(log(max(depth_m, 1.0e-6) / frame.light_slices.x) * frame.light_slices.y), 0);
}

#endif
