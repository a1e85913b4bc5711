// Who stands between a surface point and a light: lookups of the shadow atlas. C++: shadow_views.hpp.
//
// A lookup gives a point of the surface that the light sees there. It is in the way when it stands above the receiver's
// own plane and on the light's side of it. The plane is what other shadow maps have a bias for: a plane cannot shadow
// itself however coarse the texels are, and nothing has to be pushed away from it, so no shadow leaves its caster.
#ifndef CANDELA_SHADOWS_GLSL
#define CANDELA_SHADOWS_GLSL

#include "basis.glsl"
#include "lights.glsl"

// C++: shadow_kind_bits(), what some light needs; ShadowFilterTechnique. What none needs is not compiled: a software device
// runs both sides of a branch.
#ifdef CANDELA_WITHOUT_SHADOWS
const uint kShadowKinds = 0u;
#else
layout(constant_id = 19) const uint kShadowKinds = 0u;
#endif
layout(constant_id = 20) const int kShadowFilter = 0;
const int kFilterPcss = 0;

// C++: ShadowKind and ShadowShape.
const uint kShadowCascades = 1u;
const uint kShadowPerspective = 2u;
const uint kShadowCube = 4u;
const uint kShadowSoft = 8u;
const uint kShadowPoint = 16u;
const int kShapePoint = 0;
const int kShapeFacingDisc = 1;
const int kShapeDisc = 2;
const int kShapeRectangle = 3;
const int kShapeTube = 4;

struct ShadowRecord {
    vec4 right;
    vec4 up;
    vec4 forward;
    vec4 texels;
    vec4 numbers;
    vec4 extent;
    uvec4 faces;
};
layout(set = 0, binding = 10, std430) readonly buffer ShadowRecords { ShadowRecord shadow_records[]; };
layout(set = 0, binding = 11) uniform sampler2D shadow_atlas;

const uint kSearchTaps = 12u;
const uint kFilterTaps = 16u;

// Heights above the receiver's plane that are taken for the plane itself, as a share of the distance and in texels: what
// float depth and curved surfaces make of a plane.
const float kPlaneSlope = 0.01;
const float kPlaneTexels = 0.05;
const float kPlaneLeast_m = 1e-4;
// Facets of a smooth surface do not rise more steeply than this.
const float kBulgeSlope = 0.3;

// A receiver in the frame of one record, where z is the depth from the light.
struct ShadowReceiver {
    uint kind;
    ShadowRecord record;
    vec3 point;
    vec3 normal;       // unit
    vec3 to_light;     // to the middle of the light; distant lights: 1 m of that way
    vec3 x;            // from the middle to the edge of the light
    vec3 y;
    vec3 progress;     // its product with a way is the share of to_light that the way has covered
    float slack;       // m
    float bulge;       // m that facets of the same smooth surface may rise
};

// Fractions of multiples of these are spread evenly: the golden ratio's, and the plastic ratio's, which keeps step with no
// multiple of the first (Roberts 2018, "The Unreasonable Effectiveness of Quasirandom Sequences").
const float kSpreadAround = 0.6180339887;
const float kSpreadAlong = 0.7548776662;

// Per-pixel numbers in [0,1): neighbours differ most (Jimenez 2014, "Next Generation Post Processing in Call of Duty:
// Advanced Warfare"). Another sample of the same pixel goes on along a sequence, so that stills converge.
float shadow_noise(ivec2 pixel, uint dimension) {
    vec2 p = vec2(pixel) + 5.588238 * float(dimension);
    float n = fract(52.9829189 * fract(dot(p, vec2(0.06711056, 0.00583715))));
    return fract(n + kSpreadAround * float(frame.random.x));
}

// The atlas at a texel's middle: the point of the surface seen there, in the record's frame. False when there is none.
bool surface_in_cascade(ShadowRecord r, vec2 offset, out vec3 surface) {
    if (any(greaterThanEqual(abs(offset), vec2(r.numbers.z)))) return false;
    vec2 texel = floor(r.texels.zw + offset);
    float d = texelFetch(shadow_atlas, ivec2(texel), 0).r;
    surface = vec3((texel + 0.5 - r.texels.zw) / r.texels.xy, (1.0 - d) * r.numbers.x);
    return d > 0.0;
}

bool surface_in_pyramid(ShadowRecord r, vec2 offset, out vec3 surface) {
    if (any(greaterThanEqual(abs(offset), vec2(r.numbers.z)))) return false;
    vec2 texel = floor(r.texels.zw + offset);
    float d = texelFetch(shadow_atlas, ivec2(texel), 0).r;
    float z = r.numbers.x / max(d, 1e-30);
    surface = vec3((texel + 0.5 - r.texels.zw) / r.texels.xy * z, z);
    return d > 0.0;
}

// Face 2 * axis is towards +axis, the next one towards -axis; both count texels along the two axes that follow.
bool surface_in_cube(ShadowRecord r, vec3 way, vec2 jitter_texels, out vec3 surface) {
    vec3 a = abs(way);
    int axis = a.x >= max(a.y, a.z) ? 0 : a.y >= a.z ? 1 : 2;
    vec3 turned = axis == 0 ? way : axis == 1 ? way.yzx : way.zxy;
    uint corner = (axis == 0 ? r.faces.x : axis == 1 ? r.faces.y : r.faces.z) >> (turned.x < 0.0 ? 16u : 0u);
    vec2 first = vec2(corner & 0xffu, (corner >> 8u) & 0xffu) * 64.0;
    float half_face = r.numbers.z;
    vec2 offset = turned.yz / abs(turned.x) * half_face + jitter_texels + half_face;
    vec2 texel = clamp(floor(offset), vec2(0.0), vec2(2.0 * half_face - 1.0));
    float d = texelFetch(shadow_atlas, ivec2(first + texel), 0).r;
    float z = r.numbers.x / max(d, 1e-30);
    vec3 seen = vec3(sign(turned.x), (texel + 0.5) / half_face - 1.0) * z;
    surface = axis == 0 ? seen : axis == 1 ? seen.zxy : seen.yzx;
    return d > 0.0;
}

bool surface_seen(ShadowReceiver receiver, vec3 at, vec2 jitter_texels, out vec3 surface) {
    const uint kinds = kShadowKinds & (kShadowCascades | kShadowPerspective | kShadowCube);
    if (kinds == kShadowCascades || ((kinds & kShadowCascades) != 0u && receiver.kind == kShadowCascades)) {
        return surface_in_cascade(receiver.record, at.xy * receiver.record.texels.xy + jitter_texels, surface);
    }
    if ((kinds & ~kShadowCascades) == kShadowCube || ((kinds & kShadowCube) != 0u && receiver.kind == kShadowCube)) {
        return surface_in_cube(receiver.record, at, jitter_texels, surface);
    }
    return surface_in_pyramid(receiver.record, at.xy / at.z * receiver.record.texels.xy + jitter_texels, surface);
}

// Whether the surface that the light sees on its way to `at` is between the receiver and the light; and how far along.
bool in_the_way(ShadowReceiver receiver, vec3 at, vec2 jitter_texels, out float share) {
    share = 0.0;
    vec3 surface;
    if (!surface_seen(receiver, at, jitter_texels, surface)) return false;
    // Seen from a cube's centre, towards the end of a long tube, what is farther than the receiver is across is not on the
    // way to it.
    if (receiver.kind == kShadowCube && dot(surface, receiver.point - surface) < 0.0) return false;
    vec3 way = surface - receiver.point;
    share = dot(way, receiver.progress);
    float height = dot(way, receiver.normal);
    // The longest side stands for the distance: a root in every lookup costs more than the tolerance is worth.
    vec3 sides = abs(way);
    float distance_m = max(sides.x, max(sides.y, sides.z));
    return share > 0.0 && height > receiver.slack + kPlaneSlope * distance_m + min(receiver.bulge, kBulgeSlope * distance_m);
}

// Point i of the light, in units of x and y, from a Fibonacci spiral or lattice turned by the pixel's own numbers.
vec2 light_point(bool round_shape, uint i, uint count, vec2 turn) {
    float along = (float(i) + turn.y) / float(count);
    float around = fract(float(i) * kSpreadAround + turn.x);
    if (!round_shape) return vec2(around, along) * 2.0 - 1.0;
    return sqrt(along) * vec2(cos(TWO_PI * around), sin(TWO_PI * around));
}

// Percentage-closer soft shadows (Fernando 2005): first how far away what is in the way is on average, then the share of
// the light that it hides at that distance. Changed: both look along ways to points of the light's real shape, so the
// kernel is that shape seen through the blockers (for a light of width w, w (d_r - d_b) / d_b on the receiver), and
// points below the receiver's horizon do not count, which keeps the gradient of wrap lighting (Frostbite 4.10.4, Figure 68).
float soft_visibility(ShadowReceiver r, bool round_shape, ivec2 pixel) {
    vec2 turn = vec2(shadow_noise(pixel, 0u), shadow_noise(pixel, 1u));
    float shift = shadow_noise(pixel, 2u);
    float farthest = r.kind == kShadowCascades ? r.point.z : 0.95;
    float blockers = 0.0;
    float share_sum = 0.0;
    for (uint i = 0u; i < kSearchTaps; ++i) {
        vec2 p = light_point(round_shape, i, kSearchTaps, turn);
        float way = farthest * fract(float(i) * kSpreadAlong + shift);
        float share;
        if (in_the_way(r, r.point + way * (r.to_light + p.x * r.x + p.y * r.y), vec2(0.0), share)) {
            blockers += 1.0;
            share_sum += share;
        }
    }
    if (blockers == 0.0) return 1.0;
    float way = share_sum / blockers;
    // The map is not known better than to a texel: where the kernel is smaller, its points are spread over one.
    float depth = r.kind == kShadowCascades ? 1.0 : length(r.point + way * r.to_light);
    float kernel_texels = way * sqrt(min(dot(r.x, r.x), dot(r.y, r.y))) / (r.record.numbers.w * depth);
    float spread = clamp(1.0 - 0.5 * kernel_texels, 0.0, 1.0);
    float seen = 0.0;
    float all = 0.0;
    for (uint i = 0u; i < kFilterTaps; ++i) {
        vec2 p = light_point(round_shape, i, kFilterTaps, turn.yx);
        vec3 to_point = r.to_light + p.x * r.x + p.y * r.y;
        float weight = max(dot(r.normal, to_point), 0.0);
        all += weight;
        float share;
        if (!in_the_way(r, r.point + way * to_point, p * spread, share)) seen += weight;
    }
    return all > 0.0 ? seen / all : 1.0;
}

// A light without extent: the four texels about the way to it, by how near they are.
float point_visibility(ShadowReceiver r, vec3 at) {
    vec2 offset;
    if (r.kind != kShadowCube) {
        offset = (r.kind == kShadowCascades ? at.xy : at.xy / at.z) * r.record.texels.xy;
    } else {
        vec3 a = abs(at);
        vec3 turned = a.x >= max(a.y, a.z) ? at : a.y >= a.z ? at.yzx : at.zxy;
        offset = turned.yz / abs(turned.x) * r.record.numbers.z;
    }
    // Tiles have their middle on a corner of four texels.
    vec2 high = fract(offset + 0.5);
    vec2 low = 1.0 - high;
    float share;
    float seen = 0.0;
    if (!in_the_way(r, at, vec2(-0.5, -0.5), share)) seen += low.x * low.y;
    if (!in_the_way(r, at, vec2(0.5, -0.5), share)) seen += high.x * low.y;
    if (!in_the_way(r, at, vec2(-0.5, 0.5), share)) seen += low.x * high.y;
    if (!in_the_way(r, at, vec2(0.5, 0.5), share)) seen += high.x * high.y;
    return seen;
}

vec3 to_frame(ShadowRecord r, vec3 v) { return vec3(dot(r.right.xyz, v), dot(r.up.xyz, v), dot(r.forward.xyz, v)); }

// The first cascade that holds the point with room for the filter. Near a cascade's edge some pixels, chosen by their
// noise, take the next one, so that no seam shows.
int choose_cascade(int first, vec3 position_m, ivec2 pixel) {
    int count = int(shadow_records[first].faces.w);
    float room = 1.0 - 0.1 * shadow_noise(pixel, 3u);
    for (int i = 0; i < count - 1; ++i) {
        ShadowRecord r = shadow_records[first + i];
        vec2 offset = vec2(dot(r.right.xyz, position_m) + r.right.w, dot(r.up.xyz, position_m) + r.up.w) * r.texels.x;
        if (max(abs(offset.x), abs(offset.y)) < room * (r.numbers.z - 4.0)) return first + i;
    }
    return first + count - 1;
}

uint shadow_kind_of(int type, ShadowRecord r) {
    if (type == kLightDirectional || type == kLightSun) return kShadowCascades;
    return r.faces.x + r.faces.y + r.faces.z == 0u ? kShadowPerspective : kShadowCube;
}

ShadowReceiver shadow_receiver(Light light, int type, ShadowRecord record, vec3 position_m, vec4 facet, vec3 l) {
    ShadowReceiver r;
    r.record = record;
    r.kind = shadow_kind_of(type, record);
    r.point = to_frame(record, position_m) + vec3(record.right.w, record.up.w, record.forward.w);
    r.normal = to_frame(record, facet.xyz);
    r.bulge = facet.w;
    vec3 x = light.right_b.xyz;
    vec3 y = cross(light.right_b.xyz, light.direction_a.xyz);
    int shape = int(record.extent.z);
    if (shape == kShapeFacingDisc) orthonormal_basis(l, x, y);
    if (shape == kShapeTube) {
        vec3 across = cross(x, l);
        y = across * inversesqrt(max(dot(across, across), 1e-12));
    }
    r.x = to_frame(record, x) * record.extent.x;
    r.y = to_frame(record, y) * record.extent.y;
    if (r.kind == kShadowCascades) {
        r.to_light = vec3(0.0, 0.0, -1.0);
        r.progress = vec3(0.0, 0.0, -1.0);
        r.slack = record.numbers.w;
    } else {
        r.to_light = vec3(0.0, 0.0, record.numbers.y) - r.point;
        // Blockers are sorted by planes across the pyramid, or across the way to the light.
        r.progress = r.kind == kShadowCube ? r.to_light / max(dot(r.to_light, r.to_light), 1e-12)
                                           : vec3(0.0, 0.0, 1.0 / min(r.to_light.z, -1e-6));
        r.slack = record.numbers.w * length(r.point);
    }
    r.slack = kPlaneLeast_m + kPlaneTexels * r.slack;
    return r;
}

// Share of the light's illuminance that arrives. facet: unit normal of the facet that the pixel shows, without normal maps
// and interpolation; w: m that other facets of the same smooth surface may rise above its plane. l: unit, to the
// light's centre.
float light_visibility(Light light, vec3 position_m, vec4 facet, vec3 l, ivec2 pixel) {
    int first = light.links.z;
    if (kShadowKinds == 0u || first < 0) return 1.0;
    int type = int(light.color_type.w);
    bool cascades = (kShadowKinds & kShadowCascades) != 0u && (type == kLightDirectional || type == kLightSun);
    if (cascades) first = choose_cascade(first, position_m, pixel);
    ShadowReceiver r = shadow_receiver(light, type, shadow_records[first], position_m, facet, l);
    if (r.kind == kShadowPerspective && r.point.z <= r.record.numbers.y) return 1.0;
    int shape = int(r.record.extent.z);
    bool soft = kShadowFilter == kFilterPcss && (kShadowKinds & kShadowSoft) != 0u;
    bool all_soft = soft && (kShadowKinds & kShadowPoint) == 0u;
    if (all_soft || (soft && shape != kShapePoint)) {
        return soft_visibility(r, shape == kShapeFacingDisc || shape == kShapeDisc, pixel);
    }
    return point_visibility(r, r.point);
}

#endif
