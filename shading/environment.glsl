// Directions to and from equirectangular pictures, as scene::Environment holds them: row 0 at +Y, the centre
// looks down -Z, u grows to the right as seen from inside, so that +X is at u = 0.75 and -X at u = 0.25.
#ifndef CANDELA_ENVIRONMENT_GLSL
#define CANDELA_ENVIRONMENT_GLSL

#include "language.glsl"

CANDELA_SHADING_BEGIN

// Turns v counter-clockwise seen from above (+Y). An environment with rotation r shows, in world direction w,
// what its picture holds at rotate_about_y(w, -r).
FN vec3 rotate_about_y(vec3 v, float angle_rad) {
    float c = cos(angle_rad);
    float s = sin(angle_rad);
    return vec3(c * v.x + s * v.z, v.y, c * v.z - s * v.x);
}

// unit_direction to uv in [0,1]. The polar angle is taken with two arguments because acos loses half its
// digits near the poles. At the poles u is arbitrary but finite.
FN vec2 equirect_uv(vec3 unit_direction) {
    float across = sqrt(square(unit_direction.x) + square(unit_direction.z));
    float azimuth = across > 0.0f ? atan(unit_direction.x, -unit_direction.z) : 0.0f;
    return vec2(0.5f + azimuth / TWO_PI, atan(across, unit_direction.y) * INV_PI);
}

// Inverse of equirect_uv; unit length.
FN vec3 equirect_direction(vec2 uv) {
    float azimuth = (uv.x - 0.5f) * TWO_PI;
    float polar = uv.y * PI;
    return vec3(sin(polar) * sin(azimuth), cos(polar), -sin(polar) * cos(azimuth));
}

// Exact solid angle in sr of a texel of row `row` (0 at the top) in a picture of width x height texels: the
// azimuth step times the difference of the cosines of its edges, as a product because the difference loses
// digits.
FN float equirect_texel_solid_angle(uint row, uint width, uint height) {
    float polar_step = PI / float(height);
    float polar = (float(row) + 0.5f) * polar_step;
    return TWO_PI / float(width) * 2.0f * sin(polar) * sin(0.5f * polar_step);
}

// Arc tangent of y/x in the right quadrant, within 1.2e-5 rad: Abramowitz & Stegun 4.4.49 on [0,1], the rest
// by symmetry. atan2_fast(0, 0) is 0.
FN float atan2_fast(float y, float x) {
    float ax = abs(x);
    float ay = abs(y);
    float t = min(ax, ay) / max(max(ax, ay), 1.0e-30f);
    float t2 = t * t;
    float p = ((((0.0208351f * t2 - 0.0851330f) * t2 + 0.1801410f) * t2 - 0.3302995f) * t2 + 0.9998660f) * t;
    if (ay > ax) p = 0.5f * PI - p;
    if (x < 0.0f) p = PI - p;
    return y < 0.0f ? -p : p;
}

// equirect_uv for the frame, without a call into the driver's atan: within 2e-6 in u and 4e-6 in v, which is
// 1/100 of a texel at 4096 x 2048.
FN vec2 equirect_uv_fast(vec3 unit_direction) {
    float across = sqrt(square(unit_direction.x) + square(unit_direction.z));
    return vec2(0.5f + atan2_fast(unit_direction.x, -unit_direction.z) * (1.0f / TWO_PI),
                atan2_fast(across, unit_direction.y) * INV_PI);
}

CANDELA_SHADING_END

#endif
