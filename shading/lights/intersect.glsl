// Where a ray first enters the shape of a light from the side that shines. The ray starts at the receiver, from which all
// positions are measured; direction is unit. The result is the distance in m, or kNoEntry: missed, behind the start, or
// met from the dark side. Shapes that are closed shine outwards only: from within there is nothing.
#ifndef CANDELA_LIGHTS_INTERSECT_GLSL
#define CANDELA_LIGHTS_INTERSECT_GLSL

#include "../language.glsl"

CANDELA_SHADING_BEGIN

CONSTANT float kNoEntry = -1.0f;

// The perpendicular from the centre to the ray in place of the usual discriminant, which has no digits left for a small
// sphere far away (Haines et al. 2019, "Precision Improvements for Ray/Sphere Intersection").
FN float enter_sphere(vec3 direction, vec3 to_center_m, float radius_m) {
    float along = dot(to_center_m, direction);
    vec3 miss = to_center_m - along * direction;
    float radius2 = square(radius_m);
    float half_chord2 = radius2 - dot(miss, miss);
    if (along <= 0.0f || half_chord2 < 0.0f || dot(to_center_m, to_center_m) <= radius2) return kNoEntry;
    float t = along - sqrt(half_chord2);
    return t > 0.0f ? t : kNoEntry;
}

// Distance to the plane through the centre whose bright side looks along unit `shines`.
FN float enter_plane(vec3 direction, vec3 to_center_m, vec3 shines) {
    float towards = -dot(direction, shines);
    float height = -dot(to_center_m, shines);
    return towards > 0.0f && height > 0.0f ? height / towards : kNoEntry;
}

// shines: unit, the way the light travels along its axis; one-sided.
FN float enter_disk(vec3 direction, vec3 to_center_m, vec3 shines, float radius_m) {
    float t = enter_plane(direction, to_center_m, shines);
    vec3 from_center = t * direction - to_center_m;
    return t > 0.0f && dot(from_center, from_center) <= square(radius_m) ? t : kNoEntry;
}

// right, up: unit; shines along cross(up, right), one-sided.
FN float enter_rectangle(vec3 direction, vec3 to_center_m, vec3 right, vec3 up, float half_width_m, float half_height_m) {
    float t = enter_plane(direction, to_center_m, cross(up, right));
    vec3 from_center = t * direction - to_center_m;
    bool inside = abs(dot(from_center, right)) <= half_width_m && abs(dot(from_center, up)) <= half_height_m;
    return t > 0.0f && inside ? t : kNoEntry;
}

// Where a point of a rectangle is in its image, row 0 at the top, as seen by who stands in its light, upright and not
// mirrored: +right is on his left. from_center_m: of the point.
FN vec2 rectangle_image_uv(vec3 from_center_m, vec3 right, vec3 up, float half_width_m, float half_height_m) {
    return vec2(0.5f - 0.5f * dot(from_center_m, right) / half_width_m,
                0.5f - 0.5f * dot(from_center_m, up) / half_height_m);
}

// The vector from the receiver to the nearest point of a line segment.
FN vec3 nearest_of_segment(vec3 to_center_m, vec3 axis, float half_length_m) {
    return to_center_m - axis * clamp(dot(to_center_m, axis), -half_length_m, half_length_m);
}

// A capsule: all that is within radius_m of a segment. It is convex, so there is one entry: on the endless cylinder if
// that is entered between the ends, else on the half sphere at the end that it is entered beyond.
FN float enter_tube(vec3 direction, vec3 to_center_m, vec3 axis, float half_length_m, float radius_m) {
    vec3 nearest = nearest_of_segment(to_center_m, axis, half_length_m);
    if (dot(nearest, nearest) <= square(radius_m)) return kNoEntry;
    float rise = dot(direction, axis);
    vec3 across = direction - rise * axis;
    vec3 center_across = to_center_m - dot(to_center_m, axis) * axis;
    float across2 = dot(across, across);
    float end = rise > 0.0f ? -half_length_m : half_length_m;
    if (across2 > 1.0e-12f) {
        float along = dot(center_across, across) / across2;
        vec3 miss = center_across - along * across;
        float half_chord2 = square(radius_m) - dot(miss, miss);
        if (half_chord2 < 0.0f) return kNoEntry;
        float t = along - sqrt(half_chord2 / across2);
        float height = t * rise - dot(to_center_m, axis);
        if (abs(height) <= half_length_m) return t > 0.0f ? t : kNoEntry;
        end = height > 0.0f ? half_length_m : -half_length_m;
    }
    return enter_sphere(direction, to_center_m + end * axis, radius_m);
}

CANDELA_SHADING_END

#endif
