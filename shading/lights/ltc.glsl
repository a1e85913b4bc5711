// Specular area lights by linearly transformed cosines: Heitz, Dupuy, Hill & Neubelt 2016, "Real-Time Polygonal-Light Shading
// with Linearly Transformed Cosines"; Heitz & Hill 2017, "Real-Time Line- and Disk-Light Shading". The lobe D V cos of
// height-correlated GGX, divided by its directional albedo, is close to a cosine lobe whose directions a matrix has moved;
// the integral over a light is that of a plain cosine over the light seen through the inverse matrix.
//
// Each ltc_<shape> returns that integral, in [0,1]. Times the light's luminance in cd/m^2, times f0 x + f90 y of the table in
// dfg.glsl (the same coordinates), it is the reflected luminance.
//
// Changed from the papers: the matrix is kept in the frame of the mirror direction, whose turn with the view is exact and not
// interpolated, so that a smooth surface mirrors the light where it is. The part of the lobe that leaks below the surface is
// cut off at the surface's horizon and the rest scaled up to one, in closed form; so the fit has all four parameters and a
// light below the surface lights nothing. Both horizons cut the shapes exactly: no proxy sphere, no table of clipped ones.
#ifndef CANDELA_LIGHTS_LTC_GLSL
#define CANDELA_LIGHTS_LTC_GLSL

#include "../basis.glsl"
#include "../dfg.glsl"
#include "elliptic_cone.glsl"
#include "rectangle.glsl"

CANDELA_SHADING_BEGIN

// Texels a side of the table; the grid of dfg.glsl's.
CONSTANT int kLtcSize = kDfgSize;

// The plain cosine's normal.
CONSTANT vec3 kCosineNormal = vec3(0.0f, 0.0f, 1.0f);

// Texture coordinates: those of the table of albedos, so that one pair serves both.
FN vec2 ltc_uv(float NoV, float perceptual_roughness) {
    return dfg_uv(NoV, perceptual_roughness);
}

// The inverse matrix of a texel, up to a factor, for ltc_frame. Rows: the direction across the mirror direction in the plane of
// incidence, the one across both, the normal. x: width in the plane of incidence over that across it; y: shift of the lobe from the
// mirror direction; z: width; w: lean of the cosine's own horizon. y and w are in units of the sine of the view's angle, of
// which they are odd functions. For a smooth surface seen at the normal (1, 0, 2 alpha, 0), whose lobe is D_GGX's own to
// first order.
FN mat3 ltc_inverse_matrix(vec4 table_texel) {
    return mat3(vec3(table_texel.x, 0.0f, table_texel.w), vec3(0.0f, 1.0f, 0.0f),
                vec3(table_texel.y, 0.0f, table_texel.z));
}

struct LtcFrame {
    mat3 to_cosine;  // from world directions to those of the plain cosine about z
    vec3 horizon;    // the surface's normal among the latter: directions under this plane are below the surface
    float scale;     // 1 over the share of the cosine that is above both horizons, and over pi
};

// n and v: unit; v at or above the horizon.
FN LtcFrame ltc_frame(mat3 inverse_matrix, vec3 n, vec3 v) {
    float NoV = dot(n, v);
    vec3 away = n * NoV - v;  // where the mirror direction leans
    float sine = length(away);
    vec3 any;
    vec3 other;
    orthonormal_basis(n, any, other);
    vec3 t = sine > 1.0e-6f ? away / sine : any;
    float across = inverse_matrix[0].x;
    float shift = inverse_matrix[2].x * sine;
    vec2 row0 = vec2(across * NoV + shift * sine, shift * NoV - across * sine);  // along t and n
    vec2 row2 = vec2(inverse_matrix[0].z * sine, inverse_matrix[2].z);
    LtcFrame frame;
    frame.to_cosine = transpose(mat3(row0.x * t + row0.y * n, cross(n, t), row2.x * t + row2.y * n));
    frame.horizon = normalize(vec3(-row2.x, 0.0f, row0.x));
    // Half the hemisphere's projected area, and half that of the other half, turned by the angle between the planes.
    frame.scale = 2.0f * INV_PI / (1.0f + frame.horizon.z);
    return frame;
}

// The lobe in 1/sr, D V cos over its albedo, of a unit direction l.
FN float ltc_density(LtcFrame frame, vec3 n, vec3 l) {
    vec3 p = frame.to_cosine * l;
    float length2 = dot(p, p);
    float above = dot(n, l) > 0.0f ? max(p.z, 0.0f) : 0.0f;
    return frame.scale * above * abs(determinant(frame.to_cosine)) / (length2 * length2);
}
FN float ltc_density(mat3 inverse_matrix, vec3 n, vec3 v, vec3 l) {
    return ltc_density(ltc_frame(inverse_matrix, n, v), n, l);
}

// Radius in m of the disc with the second moments of a rectangle, and of a cylinder (half_length_m without its ends), that a lobe
// sees in place of it. Own.
FN float rectangle_spreading_radius(float half_width_m, float half_height_m) {
    return sqrt((half_width_m * half_width_m + half_height_m * half_height_m) * (2.0f / 3.0f));
}
FN float tube_spreading_radius(float half_length_m, float radius_m) {
    return sqrt(half_length_m * half_length_m * (2.0f / 3.0f) + radius_m * radius_m);
}

// Factor on the integral over a light, from what the fit misses at its middle. The fit is one of whole lobes: in one direction it is
// off by up to a factor of ten in the tails and by half near grazing views, which lights smaller than the lobe show.
// true_density, fitted_density: D V cos over its albedo at the light's middle, in 1/sr; light, mirror: unit directions to
// it and of the reflected view; NoL: of the former; angular_radius: of a disc with the light's second moments, about rad.
// It is the quotient of both for a small light and 1 for one as wide as what separates it from the lobe's peak, or as the lobe. Own; the
// widths by the errors of heitz2016_area_lights.
FN float ltc_small_light_factor(float true_density, float fitted_density, float alpha, float NoL, vec3 light, vec3 mirror,
                                float angular_radius) {
    vec3 off_peak = light - mirror;
    float lobe_width = alpha / (1.0f + 0.8f * alpha);
    float width = sqrt(lobe_width * lobe_width + dot(off_peak, off_peak));
    float exponent = 1.0f - smoothstep(0.0f, 1.1f, angular_radius / width);
    // The middle of a light that the horizon cuts stands for less of it.
    exponent *= saturate(NoL / max(angular_radius, 1.0e-6f));
    return pow(clamp(true_density / max(fitted_density, 1.0e-6f), 0.02f, 50.0f), exponent);
}

// The outline of what is left of a convex light above the surface's horizon, walked counterclockwise, and its part
// above the cosine's horizon.
struct LtcOutline {
    vec3 leaves_surface;
    vec3 returns_surface;
    vec3 leaves_cosine;
    vec3 returns_cosine;
    float sr;  // so far, under the cosine
};

FN LtcOutline ltc_outline_begin() {
    LtcOutline outline;
    outline.leaves_surface = vec3(0.0f);
    outline.returns_surface = vec3(0.0f);
    outline.leaves_cosine = vec3(0.0f);
    outline.returns_cosine = vec3(0.0f);
    outline.sr = 0.0f;
    return outline;
}

// Height above the cosine's horizon, for the decision of what is above. Where the view is at the normal both horizons are one,
// and a crossing of the first lies on the second but for rounding: it counts as above for every piece that it belongs to.
FN float ltc_height(vec3 p) {
    return p.z + 1.0e-5f * (abs(p.x) + abs(p.y));
}

// An edge that is known to be above the surface.
FN void ltc_outline_cut_edge(INOUT(LtcOutline) o, vec3 from, vec3 to) {
    o.sr += contour_edge_above(kCosineNormal, from, to, ltc_height(from), ltc_height(to), o.leaves_cosine,
                               o.returns_cosine);
}

// Selections, no branches: an edge below the surface shrinks to a point.
FN void ltc_outline_edge(INOUT(LtcOutline) o, LtcFrame frame, vec3 from, vec3 to) {
    float height_from = dot(frame.horizon, from);
    float height_to = dot(frame.horizon, to);
    bool from_above = height_from >= 0.0f;
    bool to_above = height_to >= 0.0f;
    bool crosses = from_above != to_above;
    vec3 crossing = horizon_crossing(from, to, height_from, crosses ? height_to : height_from - 1.0f);
    o.leaves_surface = crosses && from_above ? crossing : o.leaves_surface;
    o.returns_surface = crosses && to_above ? crossing : o.returns_surface;
    vec3 cut_to = to_above ? to : (from_above ? crossing : vec3(0.0f));
    vec3 cut_from = from_above ? from : (to_above ? crossing : vec3(0.0f));
    ltc_outline_cut_edge(o, cut_from, cut_to);
}

// An arc that is known to be above the surface; begin, end: the points of its ends.
FN void ltc_outline_cut_arc(INOUT(LtcOutline) o, OrientedCone c, vec2 from, vec2 to, vec3 begin, vec3 end) {
    RimPieces r = rim_above(c.cone, c.cone.normal, from, to, ltc_height(begin) >= 0.0f, ltc_height(end) >= 0.0f);
    if (r.has0) o.sr += elliptic_cone_arc(c.cone, r.from0, r.to0);
    if (r.has1) o.sr += elliptic_cone_arc(c.cone, r.from1, r.to1);
    if (r.leaves) o.leaves_cosine = oriented_cone_point(c, r.down);
    if (r.returns) o.returns_cosine = oriented_cone_point(c, r.up);
}

// Counterclockwise from begin to end, two directions on the cone.
FN void ltc_outline_arc(INOUT(LtcOutline) o, LtcFrame frame, OrientedCone c, vec3 begin, vec3 end) {
    vec3 horizon = vec3(dot(frame.horizon, c.first), dot(frame.horizon, c.second), dot(frame.horizon, c.axis));
    bool ends_above = dot(frame.horizon, end) >= 0.0f;
    RimPieces r = rim_above(c.cone, horizon, oriented_cone_parameter(c, begin), oriented_cone_parameter(c, end),
                            dot(frame.horizon, begin) >= 0.0f, ends_above);
    vec3 down = oriented_cone_point(c, r.down);
    vec3 up = oriented_cone_point(c, r.up);
    if (r.has0) ltc_outline_cut_arc(o, c, r.from0, r.to0, begin, r.leaves ? down : end);
    if (r.has1) ltc_outline_cut_arc(o, c, r.from1, r.to1, up, ends_above ? end : down);
    if (r.leaves) o.leaves_surface = down;
    if (r.returns) o.returns_surface = up;
}

// Closes the outline along the surface, cut by the cosine's horizon, and then along that: in its plane, for between nearly
// opposite directions any height would turn the edge out of it.
FN float ltc_outline_end(LtcOutline outline, LtcFrame frame) {
    LtcOutline o = outline;
    ltc_outline_cut_edge(o, o.leaves_surface, o.returns_surface);
    vec3 leaves = vec3(o.leaves_cosine.x, o.leaves_cosine.y, 0.0f);
    vec3 returns = vec3(o.returns_cosine.x, o.returns_cosine.y, 0.0f);
    return saturate(frame.scale * (o.sr + contour_edge(kCosineNormal, leaves, returns)));
}

// A convex polygon of four corners in the frame, of which neighbours may be one.
FN float ltc_quad(LtcFrame frame, vec3 p0, vec3 p1, vec3 p2, vec3 p3) {
    LtcOutline o = ltc_outline_begin();
    ltc_outline_edge(o, frame, p0, p1);
    ltc_outline_edge(o, frame, p1, p2);
    ltc_outline_edge(o, frame, p2, p3);
    ltc_outline_edge(o, frame, p3, p0);
    return ltc_outline_end(o, frame);
}

// Rectangle of uniform luminance that shines to where right x up points away from. Heitz et al. 2016.
FN float ltc_rectangle(mat3 inverse_matrix, vec3 n, vec3 v, vec3 to_center_m, vec3 right, vec3 up, float half_width_m,
                       float half_height_m) {
    LtcFrame frame = ltc_frame(inverse_matrix, n, v);
    vec3 center = frame.to_cosine * to_center_m;
    vec3 x = frame.to_cosine * (right * half_width_m);
    vec3 y = frame.to_cosine * (up * half_height_m);
    return ltc_quad(frame, center - x - y, center + x - y, center + x + y, center - x + y);
}

// Triangle of uniform luminance, its corners in the order of rectangle_corners: their cross product points away from where it
// shines.
FN float ltc_triangle(mat3 inverse_matrix, vec3 n, vec3 v, vec3 a, vec3 b, vec3 c) {
    LtcFrame frame = ltc_frame(inverse_matrix, n, v);
    vec3 last = frame.to_cosine * c;
    return ltc_quad(frame, frame.to_cosine * a, frame.to_cosine * b, last, last);
}

// Whether the surface's horizon leaves all of a cone or nothing; value: what that gives.
FN bool ltc_cone_in_one_piece(LtcFrame frame, OrientedCone c, OUT(float) value) {
    vec3 horizon = vec3(dot(frame.horizon, c.first), dot(frame.horizon, c.second), dot(frame.horizon, c.axis));
    float p = length(vec2(c.cone.minor * horizon.x, c.cone.major * horizon.y));
    value = horizon.z >= p ? saturate(frame.scale * elliptic_cone_projected_solid_angle(c.cone)) : 0.0f;
    return abs(horizon.z) >= p;
}

// A whole cone of directions.
FN float ltc_cone(LtcFrame frame, OrientedCone c) {
    float whole;
    if (ltc_cone_in_one_piece(frame, c, whole)) return whole;
    LtcOutline o = ltc_outline_begin();
    vec3 begin = oriented_cone_point(c, vec2(1.0f, 0.0f));
    vec3 end = oriented_cone_point(c, vec2(-1.0f, 0.0f));
    // A loop, for its body is long: unrolled it is slower and takes the driver longer.
    for (int i = 0; i < 2; ++i) {
        ltc_outline_arc(o, frame, c, begin, end);
        vec3 turned = begin;
        begin = end;
        end = turned;
    }
    return ltc_outline_end(o, frame);
}

// What is seen of an ellipse center_m + cos(t) u_m + sin(t) w_m, wherever it lies: the round lights' one way in.
FN float ltc_ellipse(LtcFrame frame, vec3 center_m, vec3 u_m, vec3 w_m) {
    return ltc_cone(frame, oriented_cone(kCosineNormal, frame.to_cosine * center_m, frame.to_cosine * u_m,
                                         frame.to_cosine * w_m));
}

// One-sided disk, `direction` (unit) being the way it shines. Heitz & Hill 2017.
FN float ltc_disk(mat3 inverse_matrix, vec3 n, vec3 v, vec3 to_center_m, vec3 direction, float radius_m) {
    if (dot(direction, to_center_m) >= 0.0f) return 0.0f;
    vec3 t;
    vec3 b;
    orthonormal_basis(direction, t, b);
    return ltc_ellipse(ltc_frame(inverse_matrix, n, v), to_center_m, t * radius_m, b * radius_m);
}

// The circle that is seen of a sphere, as an ellipse. At its surface, or within, half of all directions; one part in a thousand less, for a
// cone's sake.
FN void sphere_outline(vec3 to_center_m, float radius_m, OUT(vec3) center, OUT(vec3) u, OUT(vec3) w) {
    float distance_m = max(length(to_center_m), 1.0e-20f);
    vec3 axis = to_center_m / distance_m;
    float sine = min(radius_m / distance_m, 0.9999995f);
    vec3 t;
    vec3 b;
    orthonormal_basis(axis, t, b);
    center = axis * sqrt((1.0f - sine) * (1.0f + sine));
    u = t * sine;
    w = b * sine;
}
FN OrientedCone ltc_sphere_cone(mat3 to_cosine, vec3 to_center_m, float radius_m) {
    vec3 center;
    vec3 u;
    vec3 w;
    sphere_outline(to_center_m, radius_m, center, u, w);
    return oriented_cone(kCosineNormal, to_cosine * center, to_cosine * u, to_cosine * w);
}

// Sphere: the disk that fills the same directions. Heitz & Hill 2017.
FN float ltc_sphere(mat3 inverse_matrix, vec3 n, vec3 v, vec3 to_center_m, float radius_m) {
    LtcFrame frame = ltc_frame(inverse_matrix, n, v);
    return ltc_cone(frame, ltc_sphere_cone(frame.to_cosine, to_center_m, radius_m));
}

// Capsule: a cylinder of length 2 half_length_m about the unit axis, between two half spheres. tube.glsl's outline (an arc of
// either end's cone and the two planes through the receiver that touch both spheres) through the matrix.
FN float ltc_capsule(LtcFrame frame, vec3 to_center_m, vec3 axis, float half_length_m, float radius_m) {
    float along_m = dot(to_center_m, axis);
    vec3 across = to_center_m - along_m * axis;
    float distance_m = length(across);
    // From within the lengthened cylinder the nearest sphere hides the rest: the outline is its circle, in two halves.
    bool end_on = distance_m <= 1.0001f * radius_m || distance_m <= 0.0f;
    vec3 w = across / max(distance_m, 1.0e-20f);
    float cosine = min(radius_m / max(distance_m, 1.0e-20f), 1.0f);
    float sine = sqrt((1.0f - cosine) * (1.0f + cosine));
    vec3 end1 = to_center_m - half_length_m * axis;
    vec3 end2 = to_center_m + half_length_m * axis;
    vec3 nearest = to_center_m + clamp(-along_m, -half_length_m, half_length_m) * axis;
    vec3 to_touch = (-radius_m * cosine) * w;
    vec3 to_side = (radius_m * sine) * cross(w, axis);
    vec3 begin = frame.to_cosine * (end2 + to_touch - to_side);
    vec3 end = frame.to_cosine * (end2 + to_touch + to_side);
    vec3 next_begin = frame.to_cosine * (end1 + to_touch + to_side);
    vec3 next_end = frame.to_cosine * (end1 + to_touch - to_side);
    vec3 center = end_on ? nearest : end2;
    float turn = 1.0f;
    OrientedCone c;
    LtcOutline o = ltc_outline_begin();
    for (int i = 0; i < 2; ++i) {
        c = ltc_sphere_cone(frame.to_cosine, center, radius_m);
        vec3 here = oriented_cone_point(c, vec2(turn, 0.0f));
        vec3 there = oriented_cone_point(c, vec2(-turn, 0.0f));
        ltc_outline_arc(o, frame, c, end_on ? here : begin, end_on ? there : end);
        ltc_outline_edge(o, frame, end_on ? there : end, end_on ? there : next_begin);
        vec3 first_begin = begin;
        vec3 first_end = end;
        begin = next_begin;
        end = next_end;
        next_begin = first_begin;
        next_end = first_end;
        center = end_on ? nearest : end1;
        turn = -1.0f;
    }
    float whole;
    if (end_on && ltc_cone_in_one_piece(frame, c, whole)) return whole;
    return ltc_outline_end(o, frame);
}
FN float ltc_tube(mat3 inverse_matrix, vec3 n, vec3 v, vec3 to_center_m, vec3 axis, float half_length_m, float radius_m) {
    return ltc_capsule(ltc_frame(inverse_matrix, n, v), to_center_m, axis, half_length_m, radius_m);
}

// A line without thickness, per metre of radius: its integral times the radius is a thin tube's. Heitz & Hill 2017 integrate
// along the line; here it is a tube of a thousandth of the distance, which no lobe of this model resolves (its
// half width is 2 kMinAlpha) and whose outline's two long edges still differ by four digits.
FN float ltc_line(mat3 inverse_matrix, vec3 n, vec3 v, vec3 to_center_m, vec3 axis, float half_length_m) {
    float along_m = clamp(-dot(to_center_m, axis), -half_length_m, half_length_m);
    float radius_m = 1.0e-3f * max(length(to_center_m + along_m * axis), 1.0e-6f);
    return ltc_tube(inverse_matrix, n, v, to_center_m, axis, half_length_m, radius_m) / radius_m;
}

CANDELA_SHADING_END

#endif
