// A tube (a capsule: a cylinder between two half spheres) as seen from a point: directions drawn nearly uniformly in the
// solid angle that it fills.
//
// One of three ways is picked by chance: the cylinder's side, or the sphere at either end (whose cone is uniform). Whatever
// a drawn direction meets first counts, and its density is the sum over the ways: whoever draws may hit another's part, and
// nothing is drawn that misses the tube.
//
// On the side, in the plane across the axis the azimuth from the receiver is uniform between the two tangents; along the
// axis the sine of the elevation is uniform between the two ends of the line that is met. With d_omega = d(sine)
// d(azimuth) the density is closed.
#ifndef CANDELA_LIGHTS_TUBE_SAMPLING_GLSL
#define CANDELA_LIGHTS_TUBE_SAMPLING_GLSL

#include "sampling.glsl"

CANDELA_SHADING_BEGIN

struct SeenTube {
    vec3 toward;         // unit, across the axis towards it
    vec3 side;           // unit, across the axis and toward
    float across;        // distance of the axis
    float low;           // the cylinder's ends along the axis
    float high;
    float half_azimuth;  // of the side; 0: not seen
    float side_share;    // probability of each way
    float low_share;
    float high_share;
    bool seen;
};

// Distance across the axis at which the endless cylinder is met.
FN float tube_side_distance(SeenTube t, float radius_m, float sine_azimuth) {
    float cosine = sqrt(max(1.0f - square(sine_azimuth), 0.0f));
    float half_chord2 = square(radius_m) - square(t.across * sine_azimuth);
    return t.across * cosine - sqrt(max(half_chord2, 0.0f));
}

// Sine of the elevation of a point `along` the axis and `distance` across it.
FN float sine_elevation(float along, float distance) {
    return along * inversesqrt(max(along * along + distance * distance, 1.0e-30f));
}

FN SeenTube see_tube(vec3 to_center_m, vec3 axis, float half_length_m, float radius_m) {
    SeenTube t;
    float center = dot(to_center_m, axis);
    vec3 across = to_center_m - center * axis;
    t.across = length(across);
    vec3 unused;
    orthonormal_basis(axis, t.toward, unused);
    if (t.across > 0.0f) t.toward = across / t.across;
    t.side = cross(axis, t.toward);
    t.low = center - half_length_m;
    t.high = center + half_length_m;
    t.half_azimuth = 0.0f;
    vec3 nearest = nearest_of_segment(to_center_m, axis, half_length_m);
    t.seen = radius_m > 0.0f && dot(nearest, nearest) > square(radius_m);
    float side = 0.0f;
    float clear2 = (t.across - radius_m) * (t.across + radius_m);
    if (clear2 > 0.0f && half_length_m > 0.0f) {
        t.half_azimuth = atan(radius_m, sqrt(clear2));
        float distance = sqrt(clear2);
        side = 2.0f * t.half_azimuth * (sine_elevation(t.high, distance) - sine_elevation(t.low, distance));
    }
    float low = sphere_solid_angle(to_center_m - half_length_m * axis, radius_m);
    float high = sphere_solid_angle(to_center_m + half_length_m * axis, radius_m);
    float whole = max(side + low + high, 1.0e-30f);
    t.side_share = side / whole;
    t.low_share = low / whole;
    t.high_share = high / whole;
    return t;
}

// Density in 1/sr with which the cylinder's side is drawn in a direction; 0 where another part is met first.
FN float tube_side_pdf(SeenTube t, vec3 direction, vec3 axis, float radius_m) {
    if (!(t.half_azimuth > 0.0f)) return 0.0f;
    float rise = dot(direction, axis);
    float toward = dot(direction, t.toward);
    float across = sqrt(max(square(toward) + square(dot(direction, t.side)), 1.0e-30f));
    float sine_azimuth = dot(direction, t.side) / across;
    if (toward <= 0.0f || abs(sine_azimuth) * t.across > radius_m) return 0.0f;
    float distance = tube_side_distance(t, radius_m, sine_azimuth);
    float low = sine_elevation(t.low, distance);
    float high = sine_elevation(t.high, distance);
    bool met = rise >= low && rise <= high;
    return met ? 1.0f / (2.0f * t.half_azimuth * max(high - low, 1.0e-30f)) : 0.0f;
}

// Density in 1/sr with which an end's sphere is drawn in a direction.
FN float tube_end_pdf(vec3 direction, vec3 to_end_m, float radius_m) {
    return enter_sphere(direction, to_end_m, radius_m) > 0.0f ? pdf_sphere(to_end_m, radius_m) : 0.0f;
}

FN float seen_tube_pdf(SeenTube t, vec3 direction, vec3 to_center_m, vec3 axis, float half_length_m, float radius_m) {
    if (!t.seen) return 0.0f;
    return t.side_share * tube_side_pdf(t, direction, axis, radius_m) +
           t.low_share * tube_end_pdf(direction, to_center_m - half_length_m * axis, radius_m) +
           t.high_share * tube_end_pdf(direction, to_center_m + half_length_m * axis, radius_m);
}

FN float pdf_tube(vec3 direction, vec3 to_center_m, vec3 axis, float half_length_m, float radius_m) {
    return seen_tube_pdf(see_tube(to_center_m, axis, half_length_m, radius_m), direction, to_center_m, axis,
                         half_length_m, radius_m);
}

FN vec3 sample_tube_side(vec2 u, SeenTube t, vec3 axis, float radius_m) {
    float azimuth = (2.0f * u.y - 1.0f) * t.half_azimuth;
    float distance = tube_side_distance(t, radius_m, sin(azimuth));
    float rise = mix(sine_elevation(t.low, distance), sine_elevation(t.high, distance), u.x);
    float across = sqrt(max(1.0f - rise * rise, 0.0f));
    return normalize(across * (cos(azimuth) * t.toward + sin(azimuth) * t.side) + rise * axis);
}

FN LightDirection sample_tube(vec2 u, vec3 to_center_m, vec3 axis, float half_length_m, float radius_m) {
    LightDirection s = no_light_direction();
    SeenTube t = see_tube(to_center_m, axis, half_length_m, radius_m);
    if (!t.seen) return s;
    // u.x picks the way and is stretched to a new number.
    if (u.x < t.side_share) {
        s.direction = sample_tube_side(vec2(u.x / t.side_share, u.y), t, axis, radius_m);
    } else {
        float rest = u.x - t.side_share;
        bool low = rest < t.low_share;
        float again = low ? rest / t.low_share : (rest - t.low_share) / max(t.high_share, 1.0e-30f);
        vec3 to_end = to_center_m + (low ? -half_length_m : half_length_m) * axis;
        s.direction = sample_sphere(vec2(min(again, 1.0f), u.y), to_end, radius_m).direction;
    }
    s.distance_m = enter_tube(s.direction, to_center_m, axis, half_length_m, radius_m);
    // Rounding may put a direction on the rim just outside.
    if (s.distance_m > 0.0f) s.pdf = seen_tube_pdf(t, s.direction, to_center_m, axis, half_length_m, radius_m);
    return s;
}

CANDELA_SHADING_END

#endif
