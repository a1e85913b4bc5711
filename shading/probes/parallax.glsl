// Where a local light probe is read: its picture was taken from one point, and stands for a sphere or a box about it. All
// positions and directions are in the proxy's own frame, whose origin is its middle.
#ifndef CANDELA_PROBES_PARALLAX_GLSL
#define CANDELA_PROBES_PARALLAX_GLSL

#include "../language.glsl"

CANDELA_SHADING_BEGIN

CONSTANT int kProxySphere = 0;
CONSTANT int kProxyBox = 1;

// m along the unit direction from a point inside a sphere about the origin to its surface: the far root, as Lagarde & de
// Rousiers 2014, appendix F, listing F.1 takes it.
FN float sphere_exit_m(vec3 position, vec3 direction, float radius_m) {
    float half_b = dot(position, direction);
    // As the distance of the ray from the centre, which does not cancel for points near the surface.
    vec3 beside = position - half_b * direction;
    return max(sqrt(max(square(radius_m) - dot(beside, beside), 0.0f)) - half_b, 0.0f);
}

// The same for a box about the origin: the nearest of the planes that the ray leaves by (listing F.2).
FN float box_exit_m(vec3 position, vec3 direction, vec3 half_size_m) {
    // A direction along a face never leaves by it; the guard keeps 0/0 out when it runs within the face.
    float x_m = (half_size_m.x - (direction.x < 0.0f ? -position.x : position.x)) / max(abs(direction.x), 1.0e-12f);
    float y_m = (half_size_m.y - (direction.y < 0.0f ? -position.y : position.y)) / max(abs(direction.y), 1.0e-12f);
    float z_m = (half_size_m.z - (direction.z < 0.0f ? -position.z : position.z)) / max(abs(direction.z), 1.0e-12f);
    return max(min(x_m, min(y_m, z_m)), 0.0f);
}

// The nearest point of the proxy. A surface that lies on the proxy, or a little behind it, is corrected as if it were
// there: from outside a ray may miss the proxy, and the reflection would end in a line.
FN vec3 nearest_in_proxy(int shape, vec3 position, vec3 half_size_m) {
    if (shape == kProxyBox) return clamp(position, -half_size_m, half_size_m);
    float distance_m = length(position);
    return distance_m > half_size_m.x ? position * (half_size_m.x / distance_m) : position;
}

// Lagarde & de Rousiers 2014, section 4.9.3, listing 25: the width of the lobe that from the probe's place covers what the
// lobe at the surface covers. Perceptual roughness in and out; never above what it was.
FN float distance_based_roughness(float to_surface_m, float to_probe_m, float perceptual_roughness) {
    float seen_from_probe = to_surface_m * perceptual_roughness / max(to_probe_m, 1.0e-6f);
    return mix(min(seen_from_probe, perceptual_roughness), perceptual_roughness, perceptual_roughness);
}

struct ProbeLookup {
    vec3 direction;  // not unit
    float perceptual_roughness;
};

// Lagarde & de Rousiers 2014, appendix F: the direction and roughness to read a probe with that was taken at `capture`.
// dominant: unit, of the lobe. Changed: the corrected direction is made unit before it is blended towards the dominant one;
// the paper blends a vector in metres, so that the blend depends on the size of the room. And the blend is by alpha squared:
// by perceptual roughness, as in the paper, a fifth of the way at 0.2 moves reflections from their place (candela validate,
// frostbite_figure61: four times the error).
FN ProbeLookup probe_lookup(int shape, vec3 half_size_m, vec3 capture, vec3 position, vec3 dominant, float perceptual_roughness) {
    vec3 from = nearest_in_proxy(shape, position, half_size_m);
    float exit_m = shape == kProxyBox ? box_exit_m(from, dominant, half_size_m) : sphere_exit_m(from, dominant, half_size_m.x);
    vec3 corrected = from + exit_m * dominant - capture;
    float to_probe_m = max(length(corrected), 1.0e-6f);
    ProbeLookup lookup;
    lookup.direction = mix(corrected / to_probe_m, dominant, square(square(perceptual_roughness)));
    lookup.perceptual_roughness = distance_based_roughness(exit_m, to_probe_m, perceptual_roughness);
    return lookup;
}

// m by which a point is outside of a box about the origin; 0 inside.
FN float outside_box_m(vec3 position, vec3 half_size_m) {
    return length(max(abs(position) - half_size_m, vec3(0.0f)));
}

// Soft border of a probe's influence: 1 within, 0 from its limit on, over fade_m. Lagarde & de Rousiers 2014, appendix F,
// listings F.1 and F.2, with the smoothstep. Changed: the limit is `margin_m` beyond the proxy, because floor and walls lie
// on the proxy and would be without reflection; with margin 0 it is the paper's.
FN float probe_influence(int shape, vec3 position, vec3 half_size_m, float margin_m, float fade_m) {
    float inside = 0.0f;
    float fade = max(fade_m, 1.0e-4f);
    if (shape == kProxyBox) {
        vec3 full = max(half_size_m + vec3(margin_m - fade), vec3(0.0f));
        inside = 1.0f - saturate(outside_box_m(position, full) / fade);
    } else {
        inside = saturate((half_size_m.x + margin_m - length(position)) / fade);
    }
    return smoothstep(0.0f, 1.0f, inside);
}

CANDELA_SHADING_END

#endif
