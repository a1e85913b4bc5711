// Tubes as area lights: capsules, that is cylinders between the centres of two half spheres. Illuminance per luminance,
// that is the projected solid angle in sr.
#ifndef CANDELA_LIGHTS_TUBE_GLSL
#define CANDELA_LIGHTS_TUBE_GLSL

#include "contour.glsl"
#include "line.glsl"
#include "rectangle.glsl"
#include "sphere.glsl"

CANDELA_SHADING_BEGIN

// An arc of a circular cone of directions: points cos_sigma axis + sin_sigma (cos t u + sin t v), t within
// [-half_turn, half_turn], whose cosine and sine are `end`. normal: the receiver's along u, v and axis.
struct ConeArc {
    vec3 normal;
    float cos_sigma;
    float sin_sigma;
    vec2 end;
    float half_turn;
};

FN float cone_arc_piece(ConeArc arc, vec2 from, vec2 to, float turn) {
    float edges = arc.normal.x * (to.y - from.y) - arc.normal.y * (to.x - from.x);
    return 0.5f * arc.sin_sigma * (arc.sin_sigma * arc.normal.z * turn - arc.cos_sigma * edges);
}

// What of the arc lies above the horizon. starts_above, ends_above: whether its ends do, as the neighbouring edges have
// it. Where the arc goes below and where it comes back are written as cosine and sine to `leaves` and `returns`.
FN float cone_arc_above(ConeArc arc, bool starts_above, bool ends_above, OUT(vec2) leaves, OUT(vec2) returns,
                        OUT(bool) does_leave, OUT(bool) does_return) {
    // The whole circle is above within delta of its highest point.
    vec2 slope = arc.sin_sigma * vec2(arc.normal.x, arc.normal.y);
    float p = length(slope);
    vec2 highest = p > 0.0f ? slope / p : vec2(1.0f, 0.0f);
    float height = arc.cos_sigma * arc.normal.z;
    bool crosses = abs(height) < p;
    float cos_delta = clamp(-height / max(p, 1.0e-30f), -1.0f, 1.0f);
    float sin_delta = sqrt(max(1.0f - cos_delta * cos_delta, 0.0f));
    leaves = vec2(highest.x * cos_delta - highest.y * sin_delta, highest.y * cos_delta + highest.x * sin_delta);
    returns = vec2(highest.x * cos_delta + highest.y * sin_delta, highest.y * cos_delta - highest.x * sin_delta);

    vec2 start = vec2(arc.end.x, -arc.end.y);
    if (starts_above == ends_above) {
        // A dip or a rise within the arc has its lowest or highest point there.
        bool inside = crosses && (starts_above ? -highest.x : highest.x) > arc.end.x;
        does_leave = inside;
        does_return = inside;
        float sum = starts_above ? cone_arc_piece(arc, start, arc.end, 2.0f * arc.half_turn) : 0.0f;
        if (!inside) return sum;
        vec2 from = starts_above ? leaves : returns;
        vec2 to = starts_above ? returns : leaves;
        float turn = 2.0f * half_turn_angle(sin_delta, starts_above ? -cos_delta : cos_delta);
        float piece = cone_arc_piece(arc, from, to, turn);
        return starts_above ? sum - piece : piece;
    }
    does_leave = starts_above;
    does_return = ends_above;
    vec2 from = starts_above ? start : returns;
    vec2 to = starts_above ? leaves : arc.end;
    float turn = full_turn_angle(from.x * to.y - from.y * to.x, from.x * to.x + from.y * to.y);
    // Rounding may put the crossing just outside of the arc.
    return cone_arc_piece(arc, from, to, turn > arc.half_turn + PI ? 0.0f : turn);
}

// The outer arc of one end's sphere with centre (x, y, 0); side: -1 for the end at lower x, 1 for the other. The receiver
// is outside of the endless cylinder.
FN float tube_end_above(vec3 n, float x, float y, float radius_m, float side, bool starts_above, bool ends_above,
                        INOUT(vec3) leaves, INOUT(vec3) returns) {
    float distance_m = sqrt(x * x + y * y);
    vec3 axis = vec3(x, y, 0.0f) / distance_m;
    vec3 u = side * vec3(y, -x, 0.0f) / distance_m;
    vec3 v = vec3(0.0f, 0.0f, -side);
    ConeArc arc;
    arc.normal = vec3(dot(n, u), dot(n, v), dot(n, axis));
    arc.sin_sigma = radius_m / distance_m;
    float tangent_m = sqrt(max(x * x + y * y - radius_m * radius_m, 0.0f));
    arc.cos_sigma = tangent_m / distance_m;
    // The arc ends where the two planes touch this sphere that pass through the receiver and touch the cylinder.
    float sine = distance_m * sqrt(max(y * y - radius_m * radius_m, 0.0f));
    float cosine = side * x * radius_m;
    arc.end = vec2(cosine, sine) * inversesqrt(max(sine * sine + cosine * cosine, 1.0e-37f));
    arc.half_turn = half_turn_angle(sine, cosine);
    vec2 down;
    vec2 up;
    bool does_leave;
    bool does_return;
    float sum = cone_arc_above(arc, starts_above, ends_above, down, up, does_leave, does_return);
    // On the sphere, as far away as the edges' points.
    if (does_leave) leaves = tangent_m * (arc.cos_sigma * axis + arc.sin_sigma * (down.x * u + down.y * v));
    if (does_return) returns = tangent_m * (arc.cos_sigma * axis + arc.sin_sigma * (up.x * u + up.y * v));
    return sum;
}

// Exact, with the horizon. A capsule's outline, seen from outside of the endless cylinder, is two great arcs (the planes
// through the receiver that touch the cylinder) and an arc of each end's circle; seen from inside of that cylinder it is
// the nearer sphere alone. Own derivation. A receiver inside of the capsule counts as one on the nearest sphere's surface.
// Under a thousandth of the distance the outline's halves cancel to four digits and fewer: there the tube is a line and
// half a sphere at each end.
FN float tube_projected_solid_angle(vec3 n, vec3 to_center_m, vec3 axis, float half_length_m, float radius_m) {
    float middle = dot(to_center_m, axis);
    vec3 across = to_center_m - middle * axis;
    float y2 = dot(across, across);
    float start = middle - half_length_m;
    float end = middle + half_length_m;
    float radius2 = radius_m * radius_m;
    if (y2 <= 1.00001f * radius2 || y2 < 1.0e-18f)
        return sphere_projected_solid_angle(n, across + axis * clamp(0.0f, start, end), radius_m);
    if (radius2 < 1.0e-6f * y2)
        return 4.0f * half_length_m * radius_m * line_illuminance(n, to_center_m, axis, half_length_m) +
               0.5f * (sphere_projected_solid_angle(n, across + axis * start, radius_m) +
                       sphere_projected_solid_angle(n, across + axis * end, radius_m));

    // In the frame of the axis, the direction across to it, and the one perpendicular to both.
    float y = sqrt(y2);
    vec3 across_unit = across / y;
    vec3 normal = vec3(dot(n, axis), dot(n, across_unit), dot(n, cross(axis, across_unit)));
    float touch_y = (y2 - radius2) / y;
    float touch_z = radius_m * sqrt(max(1.0f - radius2 / y2, 0.0f));
    vec3 start_low = vec3(start, touch_y, -touch_z);
    vec3 start_high = vec3(start, touch_y, touch_z);
    vec3 end_low = vec3(end, touch_y, -touch_z);
    vec3 end_high = vec3(end, touch_y, touch_z);
    float height_start_low = dot(normal, start_low);
    float height_start_high = dot(normal, start_high);
    float height_end_low = dot(normal, end_low);
    float height_end_high = dot(normal, end_high);

    vec3 leaves = vec3(0.0f);
    vec3 returns = vec3(0.0f);
    float sum = tube_end_above(normal, start, y, radius_m, -1.0f, height_start_low >= 0.0f, height_start_high >= 0.0f,
                               leaves, returns);
    sum += contour_edge_above(normal, start_high, end_high, height_start_high, height_end_high, leaves, returns);
    sum += tube_end_above(normal, end, y, radius_m, 1.0f, height_end_high >= 0.0f, height_end_low >= 0.0f, leaves,
                          returns);
    sum += contour_edge_above(normal, end_low, start_low, height_end_low, height_start_low, leaves, returns);
    return max(sum + contour_edge_on_horizon(normal, leaves, returns), 0.0f);
}

// Frostbite listing 13: a rectangle of the cylinder's length and width that faces the receiver, by structured sampling, and
// a sphere at the axis's nearest point, without the horizon. Inside of the sphere its illuminance stops growing.
FN float tube_projected_solid_angle_frostbite(vec3 n, vec3 to_center_m, vec3 axis, float half_length_m,
                                              float radius_m) {
    float middle = dot(to_center_m, axis);
    vec3 across = to_center_m - middle * axis;
    vec3 forward = across * inversesqrt(max(dot(across, across), 1.0e-20f));
    float cylinder = rectangle_projected_solid_angle_structured(n, to_center_m, axis, cross(forward, axis),
                                                                half_length_m, radius_m);
    vec3 nearest = across + axis * clamp(0.0f, middle - half_length_m, middle + half_length_m);
    return cylinder + sphere_projected_solid_angle_no_horizon(n, nearest, radius_m);
}

// Frostbite section 4.7.3: beyond five times its length a light is a point, here of the outline's area as seen.
FN float tube_projected_solid_angle_five_times(vec3 n, vec3 to_center_m, vec3 axis, float half_length_m,
                                               float radius_m) {
    float distance2 = dot(to_center_m, to_center_m);
    if (distance2 < square(10.0f * (half_length_m + radius_m)))
        return tube_projected_solid_angle(n, to_center_m, axis, half_length_m, radius_m);
    float inverse_distance = inversesqrt(distance2);
    float seen_length_m = 2.0f * half_length_m * length(cross(axis, to_center_m)) * inverse_distance;
    return (2.0f * radius_m * seen_length_m + PI * square(radius_m)) * max(dot(n, to_center_m), 0.0f) *
           inverse_distance / distance2;
}

// A direction for BRDFs that are evaluated once per light. The point of the axis where n . l / distance^2 is largest: its
// derivative along the axis is the quadratic 2 n_axis s^2 + 3 y n_across s - n_axis y^2 = 0, s from the receiver's foot,
// y the distance from the axis. Own derivation; then the sphere there.
FN vec3 tube_representative_direction(vec3 n, vec3 to_center_m, vec3 axis, float half_length_m, float radius_m) {
    float middle = dot(to_center_m, axis);
    vec3 across = to_center_m - middle * axis;
    float y = max(length(across), 1.0e-15f);
    float n_axis = dot(n, axis);
    float n_across = dot(n, across) / y;
    float root = sqrt(9.0f * n_across * n_across + 8.0f * n_axis * n_axis);
    // The root at which n . l > 0; one form for each sign of n_across, so that neither cancels.
    float s = n_across >= 0.0f ? 2.0f * n_axis * y / max(3.0f * n_across + root, 1.0e-15f)
                               : 0.25f * y * (root - 3.0f * n_across) * n_axis / max(n_axis * n_axis, 1.0e-15f);
    vec3 point = across + axis * clamp(s, middle - half_length_m, middle + half_length_m);
    return sphere_representative_direction(n, point, radius_m);
}

CANDELA_SHADING_END

#endif
