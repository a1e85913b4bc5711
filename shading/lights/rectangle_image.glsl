// A rectangle that shows a picture, in a lobe that is a cosine, or one after a linear map (ltc.glsl): the picture is read once, where
// the light that counts comes from, in a level of a pyramid whose texels are as large as the lobe's spot on it. The idea of
// prefiltered pictures is Heitz et al. 2016's ("Textured Polygonal-Light Shading"); Lagarde & de Rousiers 2014, 4.7.1 name them too.
// Changed: place and size come from moments of the polygon's light instead of the foot of the perpendicular, which a tilted lobe
// does not look at.
#ifndef CANDELA_LIGHTS_RECTANGLE_IMAGE_GLSL
#define CANDELA_LIGHTS_RECTANGLE_IMAGE_GLSL

#include "contour.glsl"
#include "triangle.glsl"

CANDELA_SHADING_BEGIN

// The side of the square that stands for a cosine's spot on a plane across its axis, per metre of distance: twice the 0.64 m at
// which cos^4, what a plane sends per area, has fallen to a half.
CONSTANT float kCosineSpot = 1.3f;

// Sum of m (w . (m x (a - b))) of the edge between unit directions a and b, m its plane's normal towards the inside.
FN vec3 cosine_moment_edge(vec3 w, vec3 a, vec3 b) {
    vec3 m = direction_of(cross(a, b));
    return m * dot(w, cross(m, a - b));
}

// The integral of (w . l) l over the directions l of a convex quadrilateral, counterclockwise as the receiver sees it: where the
// light comes from that a cosine about the unit vector w weights. By the divergence theorem of (l . w)(u - (u . l) l), whose
// divergence is w . u - 3 (w . l)(u . l): own derivation; Arvo 1995, "Applications of Irradiance Tensors", has such moments of any order. Without
// the horizon of w.
FN vec3 quad_cosine_moment(vec3 w, vec3 p0, vec3 p1, vec3 p2, vec3 p3) {
    vec3 d0 = direction_of(p0);
    vec3 d1 = direction_of(p1);
    vec3 d2 = direction_of(p2);
    vec3 d3 = direction_of(p3);
    float sr = triangle_signed_solid_angle(d0, d1, d2) + triangle_signed_solid_angle(d0, d2, d3);
    vec3 edges = cosine_moment_edge(w, d0, d1) + cosine_moment_edge(w, d1, d2) + cosine_moment_edge(w, d2, d3) +
                 cosine_moment_edge(w, d3, d0);
    return (w * abs(sr) + edges) / 3.0f;
}

// Where to read the picture: xy in [0,1], row 0 at the top, as rectangle_image_uv has it; z: the share of the picture's area that the
// lobe's spot covers, 1 at most. w: unit axis of the cosine; corners in the order of rectangle_corners.
FN vec3 rectangle_image_spot(vec3 w, vec3 p0, vec3 p1, vec3 p2, vec3 p3) {
    vec3 right = p1 - p0;
    vec3 up = p3 - p0;
    vec3 away = cross(right, up);
    float area2 = max(dot(away, away), 1.0e-30f);
    vec3 moment = direction_of(quad_cosine_moment(w, p0, p1, p2, p3));
    vec3 middle = direction_of(p0 + p2);
    float height_area = dot(away, p0);
    // What lies mostly below the cosine's horizon has its moment anywhere.
    vec3 l = dot(away, moment) > 0.01f * dot(away, middle) ? moment : middle;
    float steepness = max(dot(away, l), 1.0e-20f);
    vec3 hit = l * (height_area / steepness);
    vec3 from_corner = hit - p0;
    float s = dot(cross(from_corner, up), away) / area2;
    float t = dot(cross(right, from_corner), away) / area2;
    float side = kCosineSpot * sqrt(dot(hit, hit) / steepness);  // on the plane, over the picture's
    // The picture ends: its own side and the spot's are one as resistors in parallel are.
    return vec3(1.0f - saturate(s), 1.0f - saturate(t), square(side / (1.0f + side)));
}

// Levels of a square pyramid of `size` texels a side (a power of two), finest first, one after the other: the first texel of one.
FN int pyramid_first_texel(int size, int level) {
    int side = size >> level;
    return (size * size - side * side) / 3 * 4;
}

// Bilinear reading of a level: indices of texels in the pyramid and their weights, clamped to the edge.
struct PyramidTaps {
    ivec4 index;
    vec4 weight;
};

FN PyramidTaps pyramid_taps(vec2 uv, int size, int level) {
    int side = size >> level;
    float x = clamp(uv.x, 0.0f, 1.0f) * float(side) - 0.5f;
    float y = clamp(uv.y, 0.0f, 1.0f) * float(side) - 0.5f;
    int x0 = int(floor(x));
    int y0 = int(floor(y));
    float fx = x - float(x0);
    float fy = y - float(y0);
    int left = max(x0, 0);
    int right = min(x0 + 1, side - 1);
    int upper = max(y0, 0) * side;
    int lower = min(y0 + 1, side - 1) * side;
    PyramidTaps taps;
    taps.index = ivec4(upper + left, upper + right, lower + left, lower + right) + pyramid_first_texel(size, level);
    taps.weight = vec4((1.0f - fx) * (1.0f - fy), fx * (1.0f - fy), (1.0f - fx) * fy, fx * fy);
    return taps;
}

// The level, not rounded, whose texels cover this share of the picture.
FN float pyramid_level_of_share(float share, int size) {
    return clamp(0.5f * log2(max(share, 1.0e-12f)) + log2(float(size)), 0.0f, log2(float(size)));
}

CANDELA_SHADING_END

#endif
