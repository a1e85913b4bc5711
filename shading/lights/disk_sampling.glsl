// A disk as seen from a point: directions drawn nearly uniformly in the solid angle that it fills.
//
// From any point a circle is an elliptic cone. In that cone's own frame the disk is an ellipse about the axis, with half
// axes a and b at distance 1, and the part of its solid angle within d_phi is 1 - cos(theta(phi)), where tan(theta) is the
// ellipse's radius r(phi). Guillen et al. 2017 ("Area-Preserving Parameterizations for Spherical Ellipses") draw phi in
// exact proportion to that, with a numeric inversion. Here it is drawn from the circle-to-ellipse map of another ellipse,
// whose squared half axes are 1 - cos(theta) at the two ends: in proportion at four azimuths, near it everywhere (the
// density leaves the uniform one by at most 6 %), and its density is closed. Within an azimuth cos(theta) is uniform.
#ifndef CANDELA_LIGHTS_DISK_SAMPLING_GLSL
#define CANDELA_LIGHTS_DISK_SAMPLING_GLSL

#include "sampling.glsl"

CANDELA_SHADING_BEGIN

// The cone through a disk's rim.
struct DiskCone {
    vec3 axis;   // unit
    vec3 major;  // unit, in the plane of symmetry of point and disk
    vec3 minor;  // unit
    float a;     // tangent of the half angle along major
    float b;     // and along minor
    bool seen;   // false: the disk is dark or edge-on
};

// The plane of symmetry holds the disk's normal and the way to its centre. The generators in it meet the rim at its
// nearest and farthest points, and the axis halves the angle between them.
FN DiskCone disk_cone(vec3 to_center_m, vec3 shines, float radius_m) {
    DiskCone c;
    float height = -dot(to_center_m, shines);
    vec3 in_plane = to_center_m + height * shines;
    float in_plane2 = dot(in_plane, in_plane);
    vec3 w;
    vec3 unused;
    orthonormal_basis(shines, w, unused);
    // Straight above the centre every plane is one of symmetry.
    if (in_plane2 > 1.0e-12f * height * height) w = in_plane * inversesqrt(in_plane2);
    vec3 far_rim = to_center_m + radius_m * w;
    vec3 near_rim = to_center_m - radius_m * w;
    float to_far = length(far_rim);
    float to_near = length(near_rim);
    c.seen = height > 1.0e-6f * max(to_far, to_near) && radius_m > 0.0f;
    c.axis = normalize(far_rim * to_near + near_rim * to_far);
    c.minor = cross(shines, w);
    c.major = cross(c.minor, c.axis);
    // tan of half the angle between the two, by whichever form does not cancel.
    float sine = 2.0f * radius_m * height;
    float cosine = dot(to_center_m, to_center_m) - square(radius_m);
    float lengths = to_far * to_near;
    c.a = cosine > 0.0f ? sine / (lengths + cosine) : (lengths - cosine) / max(sine, 1.0e-30f);
    // The chord at right angles through the point where the axis meets the disk.
    float sum = to_far + to_near;
    float shift = -4.0f * square(radius_m) * dot(to_center_m, w) / (sum * sum);
    vec3 middle = to_center_m + shift * w;
    c.b = sqrt(max((radius_m - shift) * (radius_m + shift), 0.0f)) / length(middle);
    return c;
}

// 1 - cos of an angle whose squared tangent is known.
FN float one_minus_cos_of_tangent(float tangent2) {
    float secant = sqrt(1.0f + tangent2);
    return tangent2 / (secant * (secant + 1.0f));
}

// Density in 1/sr at the azimuth of squared cosine cos2 from the major axis.
FN float disk_cone_pdf(float a, float b, float cos2) {
    float sin2 = 1.0f - cos2;
    float a2 = a * a;
    float b2 = b * b;
    float radius2 = a2 * b2 / max(a2 * sin2 + b2 * cos2, 1.0e-30f);
    float p2 = one_minus_cos_of_tangent(a2);
    float q2 = one_minus_cos_of_tangent(b2);
    float azimuth = sqrt(p2 * q2) / (TWO_PI * max(p2 * sin2 + q2 * cos2, 1.0e-30f));
    return azimuth / max(one_minus_cos_of_tangent(radius2), 1.0e-30f);
}

FN float pdf_disk(vec3 direction, vec3 to_center_m, vec3 shines, float radius_m) {
    DiskCone c = disk_cone(to_center_m, shines, radius_m);
    if (!c.seen) return 0.0f;
    float x = dot(direction, c.major);
    float y = dot(direction, c.minor);
    float across2 = x * x + y * y;
    return disk_cone_pdf(c.a, c.b, across2 > 0.0f ? x * x / across2 : 1.0f);
}

// shines: unit, the way the light travels along its axis; one-sided.
FN LightDirection sample_disk(vec2 u, vec3 to_center_m, vec3 shines, float radius_m) {
    LightDirection s = no_light_direction();
    DiskCone c = disk_cone(to_center_m, shines, radius_m);
    if (!c.seen) return s;
    float phi = TWO_PI * u.y;
    // p cos and q sin of the circle's angle are along the azimuth that is drawn.
    float x = sqrt(one_minus_cos_of_tangent(c.a * c.a)) * cos(phi);
    float y = sqrt(one_minus_cos_of_tangent(c.b * c.b)) * sin(phi);
    float cos2 = x * x / max(x * x + y * y, 1.0e-30f);
    float to_unit = inversesqrt(max(x * x + y * y, 1.0e-30f));
    float radius2 = square(c.a * c.b) / max(square(c.a) * (1.0f - cos2) + square(c.b) * cos2, 1.0e-30f);
    float v = u.x * one_minus_cos_of_tangent(radius2);
    float sine = sqrt(max(v * (2.0f - v), 0.0f)) * to_unit;
    s.direction = normalize(x * sine * c.major + y * sine * c.minor + (1.0f - v) * c.axis);
    s.distance_m = enter_plane(s.direction, to_center_m, shines);
    if (s.distance_m > 0.0f) s.pdf = disk_cone_pdf(c.a, c.b, cos2);
    return s;
}

CANDELA_SHADING_END

#endif
