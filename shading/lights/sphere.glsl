// Spheres, and disks that face the receiver, as area lights: illuminance per luminance, that is the projected solid angle
// in sr. Both look like a circular cone from the receiver, which is all that counts.
// Source: Lagarde & de Rousiers 2014 ("Frostbite"), sections 4.7.2.2 and 4.7.2.4; the tilted patch to sphere of Martinez,
// "Radiative view factors".
#ifndef CANDELA_LIGHTS_SPHERE_GLSL
#define CANDELA_LIGHTS_SPHERE_GLSL

#include "contour.glsl"

CANDELA_SHADING_BEGIN

// atan(t) - t for t >= 0, with its digits where t is small.
FN float atan_minus_argument(float t) {
    float t2 = t * t;
    float series = t * t2 * (-1.0f / 3.0f + t2 * (1.0f / 5.0f + t2 * (-1.0f / 7.0f + t2 * (1.0f / 9.0f - t2 / 11.0f))));
    return t < 0.3f ? series : half_turn_angle(t, 1.0f) - t;
}

// Circular cone of directions whose axis is at cos_theta to the normal and whose half angle has the squared sine
// sin2_sigma, in (0, 1]: the relations of Frostbite listing 10 with the horizon. Written anew so that nothing cancels: the
// listing takes the arc tangent of t = w tan(sigma) less about the same number, and has no digits left at the size of the
// sun. No sin(theta) either, so that no angle needs a guard.
FN float cone_projected_solid_angle(float cos_theta, float sin2_sigma) {
    if (cos_theta * cos_theta >= sin2_sigma) return PI * sin2_sigma * max(cos_theta, 0.0f);
    float w = sqrt(1.0f - cos_theta * cos_theta / sin2_sigma);
    float cot_sigma = sqrt(max(1.0f - sin2_sigma, 0.0f) / sin2_sigma);
    // What just rises over the horizon is the difference of larger numbers, left in the fifth power of w.
    float c2_sigma = 1.0f - sin2_sigma;
    if (cos_theta < 0.0f && w * w < 0.04f * c2_sigma)
        return square(w * w) * w / (cot_sigma * square(cot_sigma)) *
               (2.0f / 15.0f + w * w * (4.0f / 21.0f - 4.0f / (35.0f * c2_sigma)));
    float visible_half_angle = half_turn_angle(w, -cot_sigma * cos_theta);
    float arc;
    if (cot_sigma > 0.1f) {
        float t = w / cot_sigma;
        arc = atan_minus_argument(t) + t * sin2_sigma;
    } else {
        arc = half_turn_angle(w, cot_sigma) - w * cot_sigma * sin2_sigma;
    }
    return max(sin2_sigma * cos_theta * visible_half_angle + arc, 0.0f);
}

// Exact above, across and below the horizon. A receiver inside of the sphere counts as one on its surface, the nearest
// place where a lamp can be seen from: Frostbite's "do not let objects penetrate".
FN float sphere_projected_solid_angle(vec3 n, vec3 to_center_m, float radius_m) {
    float distance2 = max(dot(to_center_m, to_center_m), 1.0e-30f);
    float cos_theta = clamp(dot(n, to_center_m) * inversesqrt(distance2), -1.0f, 1.0f);
    return cone_projected_solid_angle(cos_theta, min(square(radius_m) / distance2, 1.0f));
}

// Quilez 2006 ("Sphere ambient occlusion") as in Frostbite listing 7: without the horizon, right while the sphere is above.
FN float sphere_projected_solid_angle_no_horizon(vec3 n, vec3 to_center_m, float radius_m) {
    float distance2 = max(dot(to_center_m, to_center_m), 1.0e-30f);
    float cosine = saturate(dot(n, to_center_m) * inversesqrt(distance2));
    return PI * square(radius_m) / max(square(radius_m), distance2) * cosine;
}

// Frostbite listing 14: beyond five times its diameter a light is a point.
FN float sphere_projected_solid_angle_five_times(vec3 n, vec3 to_center_m, float radius_m) {
    float distance2 = dot(to_center_m, to_center_m);
    if (distance2 < 100.0f * square(radius_m)) return sphere_projected_solid_angle(n, to_center_m, radius_m);
    return PI * square(radius_m) * max(dot(n, to_center_m), 0.0f) * inversesqrt(distance2) / distance2;
}

// A direction for BRDFs that are evaluated once per light (Frostbite section 4.7.4), at n . l > 0: l moved up by what it
// lacks. Some light comes in wherever this is asked for, so its mean direction is above the horizon.
FN vec3 direction_above_horizon(vec3 n, vec3 l) {
    return normalize(l + n * max(0.02f - dot(n, l), 0.0f));
}

// The middle in elevation of what is visible of the sphere: its centre while it is above the horizon. Own choice of the
// point that represents the sphere for a diffuse BRDF; Frostbite has one for rectangles only.
FN vec3 sphere_representative_direction(vec3 n, vec3 to_center_m, float radius_m) {
    vec3 l = direction_of(to_center_m);
    float sin_sigma = min(radius_m / max(length(to_center_m), 1.0e-15f), 1.0f);
    float height = dot(n, l);
    if (height >= sin_sigma) return direction_above_horizon(n, l);
    // Half way between the horizon and the highest point of the cone, the sum of two unit directions.
    vec3 level = l - n * height;
    float level_length = length(level);
    if (level_length < 1.0e-6f) return n;
    vec3 horizon = level / level_length;
    float cos_sigma = sqrt(1.0f - sin_sigma * sin_sigma);
    vec3 highest = n * (height * cos_sigma + level_length * sin_sigma) +
                   horizon * (level_length * cos_sigma - height * sin_sigma);
    return direction_above_horizon(n, direction_of(highest + horizon));
}

CANDELA_SHADING_END

#endif
