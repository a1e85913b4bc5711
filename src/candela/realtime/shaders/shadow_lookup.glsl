// Who stands between a surface point and a light: lookups of the shadow atlas. C++: shadow_views.hpp. Includers declare
// `uniform sampler2D shadow_atlas` and include frame.glsl.
//
// A lookup gives a point of the surface that the light sees there. It is in the way when it stands above the receiver's
// own plane and on the light's side of it. The plane is what other shadow maps have a bias for: a plane cannot shadow
// itself however coarse the texels are, and nothing has to be pushed away from it, so no shadow leaves its caster.
//
// A texel shows a point beside the way that was asked for. Next to an edge that is a point of something else: beyond a wall, or
// of the wall's own foot. So a lookup has three answers: something is in the way, nothing is, or that it cannot tell. What
// cannot tell does not vote, else rooms whose walls are thinner than a texel would be lit along their edges.
#ifndef CANDELA_SHADOW_LOOKUP_GLSL
#define CANDELA_SHADOW_LOOKUP_GLSL

#include "basis.glsl"
#include "shadow_points.glsl"

// C++: ShadowKind. Functions take the kind as a parameter: where it is a constant, only its own code is compiled.
const uint kShadowCascades = 0u;
const uint kShadowPerspective = 1u;
const uint kShadowCube = 2u;

struct ShadowRecord {
    vec4 right;
    vec4 up;
    vec4 forward;
    vec4 texels;
    vec4 numbers;
    vec4 extent;
    uvec4 faces;
    uvec4 unused;
};
// Of every light; distant ones have one a cascade, the others use the first.
const int kRecordsPerLight = 4;

// Heights above the receiver's plane that are taken for the plane itself, as a share of the distance and in texels: what
// float depth and curved surfaces make of a plane.
const float kPlaneSlope = 0.002;
const float kPlaneTexels = 0.05;
const float kPlaneLeast_m = 1e-4;
// Facets of a smooth surface do not rise more steeply than this.
const float kBulgeSlope = 0.3;
// A distant light at this cosine and below has a disc that the surface's own horizon cuts: what hides the rest of it stands above
// the plane by less than a texel. There the receiver is lifted off its surface by some texels instead.
const float kGrazingCosine = 0.03;
const float kGrazingTexels = 2.0;
// What stands on the receiver's plane, or so many texels above it along the way to the light, may go on down to it between the
// texels that show it and those that show the plane.
const float kContactTexels_deep = 1.0;
// Ways that spread over fewer texels all look about the receiver: there lookups may not be able to tell.
const float kNarrowTexels = 2.0;
// What is that near in the way stands at the receiver's own edge: texels of the way to the light. There it must be ahead by so
// many times of what it is aside, or stand between light and camera.
const float kNearTexels = 4.0;
const float kAheadByAside = 1.7;
// Where no lookup can tell, what is so many texels nearer to the light hides it, wherever it stands: under a light along the
// surface a wall far away is no higher above the plane than a texel is wide.
const float kBlindTexels = 8.0;
// With the light as steep as that on the plane (tangent of the angle to its normal) nothing is before or behind.
const float kSteepTangent = 0.1;
// Nothing is as far as that; its square is a float.
const float kNoDepth = 1e-12;

// A receiver in the frame of one record, where z is the depth from the light.
struct ShadowReceiver {
    vec3 point;
    vec3 normal;        // unit
    vec3 to_light;      // to the middle of the light; distant lights: 1 m of that way
    vec3 progress;      // its product with a way is the share of to_light that the way has covered
    vec3 along;         // to_light's part within the receiver's plane; 0 for a light straight above it
    vec3 across;        // along, turned about the normal by a right angle
    vec3 view_across;   // so is the way to the camera
    float texel_m;      // size of a texel at the receiver
    float texel_share;  // of the way to the light
    float slack;        // m
    float bulge;        // m that facets of the same smooth surface may rise
    float grazing_m;    // of a distant light along the surface: what is so far in the way hides it, wherever it stands; else 0
};
// What shines: from its middle to its edges.
struct ShadowExtent {
    vec3 x;
    vec3 y;
};

// Per-pixel numbers in [0,1): neighbours differ most (Jimenez 2014, "Next Generation Post Processing in Call of Duty:
// Advanced Warfare"). Another sample of the same pixel goes on along a sequence, so that stills converge.
float shadow_noise(ivec2 pixel, uint dimension) {
    vec2 p = vec2(pixel) + 5.588238 * float(dimension);
    float n = fract(52.9829189 * fract(dot(p, vec2(0.06711056, 0.00583715))));
    return fract(n + kSpreadAround * float(frame.random.x));
}

vec3 to_frame(ShadowRecord r, vec3 v) { return vec3(dot(r.right.xyz, v), dot(r.up.xyz, v), dot(r.forward.xyz, v)); }

// facet: unit normal of the facet that the receiver lies on, without normal maps and interpolation; w: m that other facets
// of the same smooth surface may rise above its plane.
ShadowReceiver shadow_receiver(uint kind, ShadowRecord record, vec3 position_m, vec4 facet) {
    ShadowReceiver r;
    r.point = to_frame(record, position_m) + vec3(record.right.w, record.up.w, record.forward.w);
    r.normal = to_frame(record, facet.xyz);
    r.bulge = facet.w;
    if (kind == kShadowCascades) {
        r.to_light = vec3(0.0, 0.0, -1.0);
        r.progress = vec3(0.0, 0.0, -1.0);
        r.texel_m = record.numbers.w;
        r.grazing_m = abs(r.normal.z) < kGrazingCosine ? kGrazingTexels * record.numbers.w : 0.0;
        r.point += r.normal * r.grazing_m;
    } else {
        r.grazing_m = 0.0;
        r.to_light = vec3(0.0, 0.0, record.numbers.y) - r.point;
        // Blockers are sorted by planes across the pyramid, or across the way to the light.
        r.progress = kind == kShadowCube ? r.to_light / max(dot(r.to_light, r.to_light), 1e-12)
                                         : vec3(0.0, 0.0, 1.0 / min(r.to_light.z, -1e-6));
        r.texel_m = record.numbers.w * length(r.point);
    }
    r.texel_share = r.texel_m * length(r.progress);
    r.slack = kPlaneLeast_m + kPlaneTexels * r.texel_m;
    float upwards = dot(r.to_light, r.normal);
    r.along = r.to_light - upwards * r.normal;
    if (dot(r.along, r.along) < kSteepTangent * kSteepTangent * upwards * upwards) r.along = vec3(0.0);
    r.across = cross(r.normal, r.along);
    r.view_across = cross(r.normal, to_frame(record, view_direction(position_m)));
    return r;
}

ShadowExtent shadow_extent(int shape, ShadowRecord record, vec3 to_light) {
    ShadowExtent e = ShadowExtent(vec3(record.extent.x, 0.0, 0.0), vec3(0.0, record.extent.y, 0.0));
    if (shape == kShapeFacingDisc) {
        orthonormal_basis(to_light * inversesqrt(max(dot(to_light, to_light), 1e-12)), e.x, e.y);
        e.x *= record.extent.x;
        e.y *= record.extent.y;
    }
    if (shape == kShapeTube) {
        vec3 across = cross(vec3(1.0, 0.0, 0.0), to_light);
        e.y = across * (inversesqrt(max(dot(across, across), 1e-12)) * record.extent.y);
    }
    return e;
}

// The face of a cube that holds a way: 2 * axis is towards +axis, the next one towards -axis; both count texels along the
// two axes that follow. `way` comes back with the face's own axes first and second and its depth third, which is positive.
struct CubeFace {
    int axis;
    float side;  // of the axis
    vec2 first;  // texel of the atlas
};
vec3 into_face(CubeFace f, vec3 v) {
    vec3 turned = f.axis == 0 ? v.yzx : f.axis == 1 ? v.zxy : v;
    return vec3(turned.xy, turned.z * f.side);
}
vec3 out_of_face(CubeFace f, vec3 v) {
    vec3 turned = vec3(v.xy, v.z * f.side);
    return f.axis == 0 ? turned.zxy : f.axis == 1 ? turned.yzx : turned;
}
CubeFace cube_face(ShadowRecord r, vec3 way) {
    vec3 a = abs(way);
    CubeFace f;
    f.axis = a.x >= max(a.y, a.z) ? 0 : a.y >= a.z ? 1 : 2;
    f.side = (f.axis == 0 ? way.x : f.axis == 1 ? way.y : way.z) < 0.0 ? -1.0 : 1.0;
    uint corner = (f.axis == 0 ? r.faces.x : f.axis == 1 ? r.faces.y : r.faces.z) >> (f.side < 0.0 ? 16u : 0u);
    f.first = vec2(corner & 0xffu, (corner >> 8u) & 0xffu) * 64.0;
    return f;
}

// The point of the surface that the light sees on its way to `at`, at a texel's middle; far behind everything where it
// sees none. outside: of the map.
vec3 surface_seen(uint kind, ShadowRecord r, vec3 at, vec2 jitter_texels, out bool outside) {
    outside = false;
    if (kind == kShadowCube) {
        CubeFace f = cube_face(r, at);
        vec3 way = into_face(f, at);
        float half_face = r.numbers.z;
        vec2 offset = way.xy / way.z * half_face + jitter_texels + half_face;
        vec2 texel = clamp(floor(offset), vec2(0.0), vec2(2.0 * half_face - 1.0));
        float d = texelFetch(shadow_atlas, ivec2(f.first + texel), 0).r;
        float z = r.numbers.x / max(d, kNoDepth);
        return out_of_face(f, vec3((texel + 0.5) / half_face - 1.0, 1.0) * z);
    }
    vec2 on_tile = kind == kShadowCascades ? at.xy : at.xy / at.z;
    vec2 offset = on_tile * r.texels.xy + jitter_texels;
    outside = any(greaterThanEqual(abs(offset), vec2(r.numbers.z)));
    vec2 texel = floor(r.texels.zw + offset);
    float d = outside ? 0.0 : texelFetch(shadow_atlas, ivec2(texel), 0).r;
    vec2 middle = (texel + 0.5 - r.texels.zw) / r.texels.xy;
    if (kind == kShadowCascades) return vec3(middle, (1.0 - d) * r.numbers.x);
    float z = r.numbers.x / max(d, kNoDepth);
    return vec3(middle * z, z);
}

// What a lookup on the way to `at` says of the receiver.
struct Sight {
    bool hides;   // something is in the way
    bool tells;   // that, or that nothing is
    bool blind;   // as far as depth alone goes, something is
    float share;  // how far along the way to the light what it shows is
};
// narrow: the lookup is about the receiver itself. nearest: share of the nearest of what is known to be in the way.
//
// What rises above the plane is in the way when it stands before the receiver, and that is judged at its foot, straight below it
// on the plane: the foot of a wall behind the receiver is behind it, however the texels lean over. At the edge between two
// surfaces that foot may be aside; then the other surface is in the way if the camera, which sees the receiver, is on its other
// side than the light is. What shows a point below the
// plane looks past the receiver's surface, and what shows the plane as near as the foot of something in the way may show
// that foot. Nor can it be told what is outside of the map. On smooth surfaces, whose own facets rise and fall, all that does not hide shows.
Sight look(uint kind, ShadowRecord record, ShadowReceiver receiver, vec3 at, vec2 jitter_texels, bool narrow, float nearest) {
    bool outside;
    vec3 surface = surface_seen(kind, record, at, jitter_texels, outside);
    vec3 way = surface - receiver.point;
    Sight s;
    s.share = dot(way, receiver.progress);
    float height = dot(way, receiver.normal);
    // The longest side stands for the distance: a root in every lookup costs more than the tolerance is worth.
    vec3 sides = abs(way);
    float distance_m = max(sides.x, max(sides.y, sides.z));
    float tolerance_m = receiver.slack + kPlaneSlope * distance_m + min(receiver.bulge, kBulgeSlope * distance_m);
    // Seen from a cube's centre, towards the end of a long tube, what is farther than the receiver is across is not on the
    // way to it.
    bool beyond = kind == kShadowCube && dot(surface, way) > 0.0;
    bool before = receiver.grazing_m > 0.0 && s.share > receiver.grazing_m;
    bool rises = height > tolerance_m;
    float ahead = dot(way, receiver.along);
    float aside = dot(way, receiver.across);
    bool near = s.share < kNearTexels * receiver.texel_share;
    bool apart = aside * dot(way, receiver.view_across) < 0.0 || ahead > kAheadByAside * abs(aside) || !near;
    bool stands = rises && (!narrow || (ahead >= 0.0 && (apart || receiver.along == vec3(0.0))));
    s.hides = s.share > 0.0 && (stands || before) && !beyond;
    float foot = nearest - kContactTexels_deep * receiver.texel_share;
    bool shows = !rises && height > -tolerance_m && s.share < foot;
    bool far_before = s.share > kBlindTexels * receiver.texel_share;
    s.tells = s.hides || (!outside && (shows || !narrow || (receiver.bulge > 0.0 && !far_before)));
    s.blind = far_before && !outside;
    return s;
}

// Percentage-closer soft shadows (Fernando 2005): first how far away what is in the way is on average, then the share of
// the light that it hides at that distance. Changed: both look along ways to points of the light's real shape, so the
// kernel is that shape seen through the blockers (for a light of width w, w (d_r - d_b) / d_b on the receiver), and
// points below the receiver's horizon do not count, which keeps the gradient of wrap lighting (Frostbite 4.10.4, Figure 68).
//
// What a search for blockers has found.
struct Blockers {
    float lookups;  // that found something
    float share;    // how far along, their sum
    float nearest;  // how far along the nearest one to the receiver is
};
const Blockers kNoBlockers = Blockers(0.0, 0.0, 1e30);
void add_sight(Sight s, inout Blockers found) {
    found.lookups += s.hides ? 1.0 : 0.0;
    found.share += s.hides ? s.share : 0.0;
    found.nearest = s.hides ? min(found.nearest, s.share) : found.nearest;
}

// How many texels ways to the light's points are apart at that share of them.
float spread_texels(uint kind, ShadowReceiver r, ShadowExtent e, float way) {
    float size = sqrt(min(dot(e.x, e.x), dot(e.y, e.y)));
    return way * size / (r.texel_m * (kind == kShadowCascades ? 1.0 : max(1.0 - way, 0.05)));
}

void search_blockers(uint kind, int shape, ShadowRecord record, ShadowReceiver r, uint first, uint stride, uint lookups,
                     vec2 turn, float shift, inout Blockers found) {
    ShadowExtent e = shadow_extent(shape, record, r.to_light);
    float farthest = kind == kShadowCascades ? r.point.z : 0.95;
    LightPoints points = light_points(shape, first, stride, lookups, turn);
    for (uint i = 0u; i < lookups; ++i) {
        vec2 p = next_point(shape, stride, points);
        float way = farthest * fract(float(first + i * stride) * kSpreadAlong + shift);
        bool narrow = spread_texels(kind, r, e, way) < kNarrowTexels;
        vec3 at = r.point + way * (r.to_light + p.x * e.x + p.y * e.y);
        add_sight(look(kind, record, r, at, vec2(0.0), narrow, 1e30), found);
    }
}

// The share of the light that is seen past blockers at that share of the way; 0 without lookups.
float filter_visibility(uint kind, int shape, ShadowRecord record, ShadowReceiver r, float way, float nearest, uint first,
                        uint stride, uint lookups, vec2 turn) {
    ShadowExtent e = shadow_extent(shape, record, r.to_light);
    // What hides the middle of the light hides as much of it as it does from where it stands, whatever else is farther away.
    for (uint i = 0u; i < min(lookups, 1u); ++i) {
        Sight s = look(kind, record, r, r.point, vec2(0.0), true, nearest);
        nearest = s.hides ? min(nearest, s.share) : nearest;
        way = s.hides ? min(way, s.share) : way;
    }
    // The map is not known better than to a texel: where the kernel is smaller, its points are spread over one.
    float kernel_texels = spread_texels(kind, r, e, way);
    float spread = clamp(1.0 - 0.5 * kernel_texels, 0.0, 1.0);
    bool narrow = kernel_texels < kNarrowTexels;
    float seen = 0.0;
    float told = 0.0;
    float open = 0.0;
    float all = 0.0;
    float deepest = 1e30;
    LightPoints points = light_points(shape, first, stride, lookups, turn);
    for (uint i = 0u; i < lookups; ++i) {
        vec2 p = next_point(shape, stride, points);
        vec3 to_point = r.to_light + p.x * e.x + p.y * e.y;
        float weight = max(dot(r.normal, to_point), 0.0);
        Sight s = look(kind, record, r, r.point + way * to_point, p * spread, narrow, nearest);
        all += weight;
        open += s.blind ? 0.0 : weight;
        told += s.tells ? weight : 0.0;
        seen += s.tells && !s.hides ? weight : 0.0;
        nearest = s.hides ? min(nearest, s.share) : nearest;
        deepest = s.tells && !s.hides ? min(deepest, s.share) : deepest;
    }
    float foot = nearest - kContactTexels_deep * r.texel_share;
    if (narrow && r.bulge <= 0.0 && deepest >= foot) seen = 0.0;
    return told > 0.0 ? seen / told : all > 0.0 ? open / all : 0.0;
}

// A light without extent: the four texels about the way to it, by how near they are. One gather; what the light sees in
// each is judged as look() does it, but that near and before are by depth instead of by the way to the light.
float point_visibility(uint kind, ShadowRecord record, ShadowReceiver r) {
    vec3 point = r.point;
    vec3 normal = r.normal;
    vec3 along = r.along;
    vec3 across = r.across;
    vec3 view_across = r.view_across;
    vec2 center = record.texels.zw;
    if (kind == kShadowCube) {
        CubeFace f = cube_face(record, point);
        point = into_face(f, point);
        normal = into_face(f, normal);
        along = into_face(f, along);
        across = into_face(f, across);
        view_across = into_face(f, view_across);
        center = f.first + record.numbers.z;
    }
    bool parallel = kind == kShadowCascades;
    vec2 offset = (parallel ? point.xy : point.xy / point.z) * record.texels.xy;
    bool outside = kind != kShadowCube && any(greaterThanEqual(abs(offset), vec2(record.numbers.z)));
    float inside = record.numbers.z - 1.0;
    vec2 low = clamp(offset, vec2(-inside), vec2(inside)) - 0.5;
    vec2 corner = floor(low);
    vec2 weight = low - corner;
    // Counter-clockwise from the texel of the lower x and the higher y.
    vec4 d = textureGather(shadow_atlas, (center + corner + 1.0) * record.extent.w);
    vec2 first = (corner + 0.5) / record.texels.xy;
    vec2 second = (corner + 1.5) / record.texels.xy;
    vec4 x = vec4(first.x, second.x, second.x, first.x);
    vec4 y = vec4(second.y, second.y, first.y, first.y);
    vec4 z = parallel ? (1.0 - d) * record.numbers.x : record.numbers.x / max(d, vec4(kNoDepth));
    if (!parallel) {
        x *= z;
        y *= z;
    }
    x -= point.x;
    y -= point.y;
    z -= point.z;
    vec4 height = normal.x * x + normal.y * y + normal.z * z;
    vec4 distance_m = max(max(abs(x), abs(y)), abs(z));
    vec4 tolerance_m = r.slack + kPlaneSlope * distance_m + min(vec4(r.bulge), kBulgeSlope * distance_m);
    vec4 weights = vec4(1.0 - weight.x, weight.x, weight.x, 1.0 - weight.x) *
                   vec4(weight.y, weight.y, 1.0 - weight.y, 1.0 - weight.y);
    vec4 ahead = along.x * x + along.y * y + along.z * z;
    vec4 aside = across.x * x + across.y * y + across.z * z;
    vec4 seen_aside = view_across.x * x + view_across.y * y + view_across.z * z;
    // 1 where what rises stands between light and camera, or far before the receiver.
    vec4 apart = mix(vec4(0.0), vec4(1.0), lessThan(aside * seen_aside, vec4(0.0)));
    apart = mix(apart, vec4(1.0), greaterThanEqual(ahead, kAheadByAside * abs(aside)));
    apart = mix(apart, vec4(1.0), lessThan(z, vec4(-kNearTexels * r.texel_m)));
    bvec4 rises = greaterThan(height, tolerance_m);
    vec4 hidden = mix(vec4(0.0), weights, lessThan(z, vec4(0.0)));
    hidden = mix(vec4(0.0), hidden, rises);
    hidden = mix(vec4(0.0), hidden * apart, greaterThanEqual(ahead, vec4(0.0)));
    vec4 of_blockers = mix(vec4(-1e30), z, greaterThan(hidden, vec4(0.0)));
    float last = max(max(of_blockers.x, of_blockers.y), max(of_blockers.z, of_blockers.w));
    vec4 shown = mix(vec4(0.0), weights, greaterThan(height, -tolerance_m));
    shown = mix(shown, vec4(0.0), rises);
    shown = mix(vec4(0.0), shown, greaterThan(z, vec4(last + kContactTexels_deep * r.texel_m)));
    vec4 open = mix(weights, vec4(0.0), lessThan(z, vec4(-kBlindTexels * r.texel_m)));
    shown = r.bulge > 0.0 ? max(open - hidden, vec4(0.0)) : shown;
    float dark = hidden.x + hidden.y + hidden.z + hidden.w;
    float lit = shown.x + shown.y + shown.z + shown.w;
    if (outside) return 1.0;
    return lit + dark > 0.0 ? lit / (lit + dark) : open.x + open.y + open.z + open.w;
}

// Whether a cascade holds a point with room for the filter. Near its edge some pixels, chosen by their noise, take the
// next one, so that no seam shows.
bool cascade_holds(ShadowRecord r, vec3 position_m, float noise) {
    vec2 offset = vec2(dot(r.right.xyz, position_m) + r.right.w, dot(r.up.xyz, position_m) + r.up.w) * r.texels.xy;
    return max(abs(offset.x), abs(offset.y)) < (1.0 - 0.1 * noise) * (r.numbers.z - 4.0);
}

#endif
