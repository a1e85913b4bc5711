// The elliptic cone of directions that an ellipse fills, wherever it lies: what is seen of a disk or a sphere after a linear
// map of the directions. Its projected solid angle is disk.glsl's.
#ifndef CANDELA_LIGHTS_ELLIPTIC_CONE_GLSL
#define CANDELA_LIGHTS_ELLIPTIC_CONE_GLSL

#include "disk.glsl"

CANDELA_SHADING_BEGIN

// disk.glsl's cone with its axes, which are right-handed and orthonormal: the directions
// axis + minor cos(t) first + major sin(t) second.
struct OrientedCone {
    EllipticCone cone;
    vec3 first;
    vec3 second;
    vec3 axis;
};

// Largest root of l^3 + c2 l^2 + c1 l + c0, all of whose roots are real, from `upper`, which is not below it. Laguerre's
// method: from there it falls monotonically, and cubically at the end.
FN float largest_root_of_real_cubic(float c2, float c1, float c0, float upper) {
    float root = upper;
    for (int i = 0; i < 5; ++i) {
        float value = ((root + c2) * root + c1) * root + c0;
        float slope = (3.0f * root + 2.0f * c2) * root + c1;
        float bend = 6.0f * root + 2.0f * c2;
        float under_root = max(4.0f * slope * slope - 6.0f * value * bend, 0.0f);
        float denominator = slope + sqrt(under_root);
        if (value <= 0.0f || denominator <= 0.0f) break;
        root -= 3.0f * value / denominator;
    }
    return root;
}

// The unit vector with (p p^T + q q^T - r r^T + shift 1) v = 0, where that matrix has rank 2: the largest column of its adjugate.
FN vec3 null_vector(vec3 p, vec3 q, vec3 r, float shift) {
    float scale = 1.0f / shift;  // the adjugate of what has large entries leaves a float's range
    vec3 row0 = scale * (p * p.x + q * q.x - r * r.x) + vec3(1.0f, 0.0f, 0.0f);
    vec3 row1 = scale * (p * p.y + q * q.y - r * r.y) + vec3(0.0f, 1.0f, 0.0f);
    vec3 row2 = scale * (p * p.z + q * q.z - r * r.z) + vec3(0.0f, 0.0f, 1.0f);
    vec3 m12 = cross(row1, row2);
    vec3 m20 = cross(row2, row0);
    vec3 m01 = cross(row0, row1);
    vec3 best = abs(m12.x) > abs(m20.y) ? m12 : m20;
    best = max(abs(m12.x), abs(m20.y)) > abs(m01.z) ? best : m01;
    float size = length(best);
    return size > 0.0f ? best / size : normalize(r);
}

// The cone of the ellipse ellipse_center + cos(t) ellipse_u + sin(t) ellipse_w (u and w conjugate, not necessarily orthogonal). Its principal axes are the
// eigenvectors of u u^T + w w^T - center center^T, whose eigenvalues but for the sign are the parameters of the three quadrics
// through the receiver that are confocal with the ellipse; one is negative and belongs to the axis. Heitz & Hill 2017,
// "Real-Time Line- and Disk-Light Shading", take the eigenvectors of the inverse form instead; here the better
// conditioned one of the two is used, and the widths come from invariants that are sums of squares.
FN OrientedCone oriented_cone(vec3 n, vec3 ellipse_center, vec3 ellipse_u, vec3 ellipse_w) {
    // Only directions count: of size 1, the squares of squares below stay within a float's range.
    float size2 = dot(ellipse_center, ellipse_center) + dot(ellipse_u, ellipse_u) + dot(ellipse_w, ellipse_w);
    float to_one = inversesqrt(max(size2, 1.0e-30f));
    vec3 center = ellipse_center * to_one;
    vec3 u = ellipse_u * to_one;
    vec3 w = ellipse_w * to_one;
    vec3 uw = cross(u, w);
    vec3 wc = cross(w, center);
    vec3 cu = cross(center, u);
    float volume = dot(uw, center);
    float trace = dot(u, u) + dot(w, w) - dot(center, center);
    float minors = dot(uw, uw) - dot(wc, wc) - dot(cu, cu);
    float volume2 = volume * volume;
    // Of an ellipse seen from within its own plane nothing is seen, and the root is 0 / 0.
    float along = max(largest_root_of_real_cubic(trace, minors, -volume2, dot(center, center)), 1.0e-30f);
    float product = volume2 / along;
    bool direct = product < along * along;
    float shift = direct ? along : product;
    OrientedCone o;
    o.axis = direct ? null_vector(u, w, center, shift) : null_vector(wc, cu, uw, shift);
    o.axis = dot(o.axis, center) < 0.0f ? -o.axis : o.axis;

    // The plane across the axis: two eigenvalues, the smaller one from the product of all.
    vec3 s = abs(o.axis.z) < 0.5f ? vec3(0.0f, 0.0f, 1.0f) : vec3(1.0f, 0.0f, 0.0f);
    s = normalize(s - dot(s, o.axis) * o.axis);
    vec3 t = cross(o.axis, s);
    vec3 on_s = vec3(dot(s, u), dot(s, w), dot(s, center));
    vec3 on_t = vec3(dot(t, u), dot(t, w), dot(t, center));
    float ss = on_s.x * on_s.x + on_s.y * on_s.y - on_s.z * on_s.z;
    float tt = on_t.x * on_t.x + on_t.y * on_t.y - on_t.z * on_t.z;
    float st = on_s.x * on_t.x + on_s.y * on_t.y - on_s.z * on_t.z;
    float half_difference = 0.5f * (ss - tt);
    float spread = sqrt(half_difference * half_difference + st * st);
    float wide2 = max(0.5f * (ss + tt) + spread, 1.0e-30f);
    float narrow2 = min(product / wide2, wide2);
    // Eigenvector of the larger one, from the row that does not cancel.
    vec2 v = half_difference > 0.0f ? vec2(half_difference + spread, st) : vec2(st, spread - half_difference);
    float length_v = length(v);
    v = length_v > 0.0f ? v / length_v : vec2(1.0f, 0.0f);
    o.second = v.x * s + v.y * t;
    o.first = cross(o.second, o.axis);
    o.cone.normal = vec3(dot(n, o.first), dot(n, o.second), dot(n, o.axis));
    o.cone.minor = sqrt(narrow2 / along);
    o.cone.major = sqrt(wide2 / along);
    return o;
}

FN vec3 oriented_cone_point(OrientedCone o, vec2 t) {
    return o.axis + (o.cone.minor * t.x) * o.first + (o.cone.major * t.y) * o.second;
}

// Cosine and sine of the parameter t of a direction on the cone.
FN vec2 oriented_cone_parameter(OrientedCone o, vec3 direction) {
    vec2 t = vec2(dot(direction, o.first) * o.cone.major, dot(direction, o.second) * o.cone.minor);
    return t * inversesqrt(max(dot(t, t), 1.0e-37f));
}

FN float turn_between(vec2 from, vec2 to) {
    return full_turn_angle(from.x * to.y - from.y * to.x, dot(from, to));
}

// What an arc of the rim, counterclockwise from `from` to `to` (cosine and sine of t), has above a plane through the receiver: up
// to two arcs.
struct RimPieces {
    vec2 from0;
    vec2 to0;
    vec2 from1;
    vec2 to1;
    bool has0;
    bool has1;
    vec2 down;  // where the rim goes below the plane
    vec2 up;    // where it comes back
    bool leaves;
    bool returns;
};

// normal: the plane's, along the cone's axes, of any length; the rim's height over it is p cos(t - highest) + normal.z. Whether the
// arc's ends are above is for the caller to say, in the same way for every piece of an outline that has this end.
FN RimPieces rim_above(EllipticCone cone, vec3 normal, vec2 from, vec2 to, bool starts_above, bool ends_above) {
    vec2 slope = vec2(cone.minor * normal.x, cone.major * normal.y);
    float p = length(slope);
    RimPieces r;
    r.from0 = from;
    r.to0 = to;
    r.from1 = from;
    r.to1 = to;
    r.up = from;
    r.down = to;
    r.has0 = starts_above;
    r.has1 = false;
    r.leaves = false;
    r.returns = false;
    if (starts_above == ends_above && abs(normal.z) >= p) return r;
    vec2 highest = p > 0.0f ? slope / p : vec2(1.0f, 0.0f);
    float c = clamp(-normal.z / max(p, 1.0e-30f), -1.0f, 1.0f);
    float s = sqrt((1.0f - c) * (1.0f + c));
    float turn = turn_between(from, to);
    // A dip or a rise between two ends on the same side has its extreme within the arc.
    vec2 extreme = starts_above ? vec2(-highest.x, -highest.y) : highest;
    bool inside = starts_above == ends_above && turn_between(from, extreme) < turn;
    r.up = vec2(highest.x * c + highest.y * s, highest.y * c - highest.x * s);
    r.down = vec2(highest.x * c - highest.y * s, highest.y * c + highest.x * s);
    r.leaves = inside || (starts_above && !ends_above);
    r.returns = inside || (!starts_above && ends_above);
    r.to0 = r.leaves ? r.down : to;
    r.from1 = r.up;
    r.to1 = ends_above ? to : r.down;
    r.has1 = r.returns;
    // Rounding may put a crossing just outside of the arc: what is left is nothing, not almost a full turn.
    r.has0 = r.has0 && turn_between(r.from0, r.to0) <= turn + 0.1f;
    r.has1 = r.has1 && turn_between(r.from1, r.to1) <= turn + 0.1f;
    return r;
}

CANDELA_SHADING_END

#endif
