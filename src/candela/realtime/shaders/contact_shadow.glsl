// Contact shadows: the last centimetres between a surface and what stands on it, which a map's texels are too coarse for, found
// by a short march over what the camera sees. Includers have shadow_lookup.glsl, kShape and receiver_at()'s image.
//
// What the camera sees hides the way behind it for half as deep as the march is long. It must stand above the receiver's own plane,
// as in the map, so that no surface shadows itself.
#ifndef CANDELA_CONTACT_SHADOW_GLSL
#define CANDELA_CONTACT_SHADOW_GLSL

const int kContactSteps = 8;
// The march is so many texels of the map long where they are small, and never longer than that.
const float kContactTexels = 4.0;
const float kContactMost_m = 0.05;
// Its last part fades, so that no shadow ends with an edge.
const float kContactFade = 0.7;
// How deep what the camera sees is taken to be, as a share of the length of the march.
const float kContactThickness = 0.5;

float depth_m(vec3 position_m) { return dot(frame.camera_position.xyz - position_m, frame.camera_backward.xyz); }

// Share of the light that is left. point: of the light's shape, in units of its extent.
float contact_visibility(ShadowRecord record, ShadowReceiver r, vec3 position_m, vec4 facet, vec2 point, float noise) {
    ShadowExtent e = shadow_extent(kShape, record, r.to_light);
    vec3 to_light = r.to_light + point.x * e.x + point.y * e.y;
    vec3 l = normalize(record.right.xyz * to_light.x + record.up.xyz * to_light.y + record.forward.xyz * to_light.z);
    float texel_m = (r.slack - kPlaneLeast_m) / kPlaneTexels;
    float reach_m = min(kContactTexels * texel_m, kContactMost_m);
    vec4 clip = frame.world_to_clip * vec4(position_m, 1.0);
    vec4 clip_step = frame.world_to_clip * vec4(l * reach_m, 0.0);
    float nearest = 1.0;
    for (int i = 0; i < kContactSteps; ++i) {
        float t = (float(i) + noise) / float(kContactSteps);
        vec4 at = clip + t * clip_step;
        vec2 place = (at.xy / at.w * 0.5 + 0.5) * vec2(frame.size.xy);
        bool inside = at.w > 0.0 && all(greaterThanEqual(place, vec2(0.0))) && all(lessThan(place, vec2(frame.size.xy)));
        ivec2 pixel = clamp(ivec2(place), ivec2(0), frame.size.xy - 1);
        uvec4 texel = texelFetch(receiver_image, pixel, 0);
        vec3 seen_m = uintBitsToFloat(texel.xyz);
        vec3 way = seen_m - position_m;
        float distance_m = length(way);
        float tolerance_m = kPlaneLeast_m + kPlaneSlope * distance_m + min(facet.w, kBulgeSlope * distance_m);
        float behind_m = depth_m(position_m + t * reach_m * l) - depth_m(seen_m);
        bool hit = inside && texel.w != kNoReceiver.w && behind_m > 0.0 && behind_m < kContactThickness * reach_m && dot(way, l) > 0.0 && dot(way, facet.xyz) > tolerance_m;
        nearest = hit ? min(nearest, t) : nearest;
    }
    return smoothstep(kContactFade, 1.0, nearest);
}

#endif
