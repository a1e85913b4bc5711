// Which probes of a grid light a point, so that light does not leak through walls. Majercik, Guertin, Nowrouzezahrai &
// McGuire 2019, "Dynamic Diffuse Global Illumination with Ray-Traced Irradiance Fields" (JCGT 8(2)), section 5.
#ifndef CANDELA_PROBES_VOLUME_GLSL
#define CANDELA_PROBES_VOLUME_GLSL

#include "../language.glsl"

CANDELA_SHADING_BEGIN

// Texels a side of a probe's octahedral picture of distances.
CONSTANT int kDistanceSize = 16;

// A probe in front of the surface counts for more than one behind it, which still counts for something: where all are
// behind, something must remain. to_probe: unit. Changed: 0.02 where the authors have 0.2. Through a wall of 6 cm half as much
// leaks (cells of 1 m: 6e-5 of what its lit side has, against 1.1e-4), and the difference to path tracing is nearly the same
// (mean FLIP 0.0743 against 0.0738 in cornell_room, 0.0819 against 0.0818 in two_rooms).
FN float facing_weight(vec3 n, vec3 to_probe) { return square(0.5f * dot(n, to_probe) + 0.5f) + 0.02f; }

// The part of a probe's view towards a point that reaches it: Chebyshev's inequality over the distances seen that way
// (Donnelly & Lauritzen 2006, "Variance Shadow Maps"), cubed against what it lets through. Changed: a deviation of
// `softness_m` is always granted, for the distances are means over texels.
FN float distance_visibility(float mean_m, float mean_square_m2, float distance_m, float softness_m) {
    if (distance_m <= mean_m) return 1.0f;
    float variance = max(mean_square_m2 - square(mean_m), square(softness_m));
    float p = variance / (variance + square(distance_m - mean_m));
    return p * p * p;
}

// Weight of a probe without the trilinear one: never 0, so that weights always have a sum; small ones fall off faster than
// they would, because the eye sees light in the dark.
FN float probe_weight(float facing, float visibility) {
    float w = max(facing * visibility, 1.0e-6f);
    return w < 0.2f ? w * w * w / 0.04f : w;
}

// How much of a point's diffuse light the volume gives: all inside its box, nothing from fade_m outside on.
FN float volume_influence(float outside_m, float fade_m) {
    return 1.0f - smoothstep(0.0f, 1.0f, saturate(outside_m / max(fade_m, 1.0e-4f)));
}

// What of that influence is left where a point beyond the box is not seen by the probes next to it: a volume that ends at a
// wall must not fade out on the wall's other side. seen: mean of those probes' distance_visibility; a quarter is enough, for
// what stands about hides points from some. Within the box there may be nothing better, so all is left; ramp_m, far less
// than a wall, spares a wall on the box itself a seam.
FN float influence_beyond(float outside_m, float seen, float ramp_m) {
    return mix(1.0f, saturate(4.0f * seen), smoothstep(0.0f, 1.0f, saturate(outside_m / max(ramp_m, 1.0e-4f))));
}

CANDELA_SHADING_END

#endif
