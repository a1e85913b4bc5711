// Lights with extent. Diffuse light is their illuminance times the diffuse lobe, taken in one direction that represents
// them; highlights are linearly transformed cosines or the lobe at a representative point.
//
// Kinds whose outlines are alike are one group and share their code: a polygon, an ellipse, a capsule. The group is a constant where
// these functions are called; within it is_kind() tells the kinds apart that the scene has.
#ifndef CANDELA_AREA_LIGHTS_GLSL
#define CANDELA_AREA_LIGHTS_GLSL

#include "lights/disk.glsl"
#include "lights/isotropic_line.glsl"
#include "lights/line.glsl"
#include "lights/ltc.glsl"
#include "lights/rectangle.glsl"
#include "lights/representative_point.glsl"
#include "lights/sampling.glsl"
#include "lights/sphere.glsl"
#include "lights/tube.glsl"

// C++: AreaDiffuseTechnique, AreaSpecularTechnique.
const int kAreaDiffuseExact = 0;
const int kAreaDiffuseStructured = 1;
const int kAreaDiffuseFormFactor = 2;
const int kAreaDiffuseRepresentativePoint = 3;
const int kAreaDiffuseDrobot = 4;
const int kAreaDiffuseLightPosition = 5;
const int kAreaDiffuseFiveTimes = 6;
const int kAreaSpecularLtc = 0;
const int kAreaSpecularRepresentativePoint = 1;
const int kAreaSpecularDominantDirection = 2;
const int kAreaSpecularWidening = 3;
const int kAreaSpecularDominantNormalized = 4;
const int kAreaSpecularTeachingPage = 5;
const int kAreaDirectionLightPosition = 1;

// First and last kind of each group; LightKind in C++ keeps them together.
const uint kCapsules = 0u;  // line, tube
const uint kEllipses = 1u;  // sun, sphere, disk
const uint kPolygons = 2u;  // rectangle, triangle
const uint kAreaKinds = (1u << kLightLine) | (1u << kLightTube) | (1u << kLightSun) | (1u << kLightSphere) |
                        (1u << kLightDisk) | (1u << kLightRectangle) | (1u << kLightTriangle);

// A line is a tube of the thickness below which punctual lights end, where only its highlight is concerned.
const float kLineRadius_m = 0.5 * kPunctualMinDistance_m;

// Rougher than this the sun is a direction to the lobe, narrower it is an image.
const float kSunImageAlpha = 0.02;

// C++: kLightImages.
const bool kLightPictures = (kLightKinds & (1u << 16u)) != 0u;

// False at compile time where the scene has no light of the kind.
bool is_kind(int kind, int which) { return (kLightKinds & (1u << uint(which))) != 0u && kind == which; }

// A light in the receiver's frame, turned to it; black where it shines away. Positions in m from the receiver.
struct AreaLight {
    vec3 nit;  // window included; of a line cd
    vec3 to_center_m;
    vec3 direction;  // unit, the way it shines
    vec3 right;
    vec3 up;
    float half_width_m;
    float half_height_m;
    float radius_m;
    float area_m2;  // of polygons
    float extent2;  // polygon_projected_solid_angle's
    bool turned;    // it shows its back
    // What the receiver sees of it. Of polygons the corners in rectangle_corners' order; of ellipses (x, y, z) the centre and
    // two conjugate radii.
    vec3 outline[4];
};

void turn_to_receiver(Light light, inout AreaLight a) {
    a.turned = dot(a.direction, a.to_center_m) > 0.0;
    if (a.turned) {
        if ((light.links.x & kLightTwoSided) == 0) a.nit = vec3(0.0);
        a.direction = -a.direction;
    }
}

void place_triangle(Light light, vec3 position, inout AreaLight a) {
    vec3 p = light.position_range.xyz - position;
    vec3 q = light.direction_a.xyz - position;
    vec3 r = light.right_b.xyz - position;
    vec3 twice_area = cross(q - p, r - p);
    float area2_m2 = length(twice_area);
    a.direction = twice_area / max(area2_m2, 1.0e-20);
    a.to_center_m = p;  // any point of the plane tells the side
    turn_to_receiver(light, a);
    a.outline[0] = p;
    a.outline[1] = a.turned ? q : r;
    a.outline[2] = a.turned ? r : q;
    a.outline[3] = a.outline[2];
    a.to_center_m = (p + q + r) * (1.0 / 3.0);
    a.area_m2 = 0.5 * area2_m2;
    a.extent2 = INV_PI * a.area_m2;
    a.radius_m = sqrt(a.extent2);  // of the disk of the same area
}

void place_rectangle(Light light, inout AreaLight a) {
    turn_to_receiver(light, a);
    a.up = cross(a.right, a.direction);
    a.area_m2 = 4.0 * a.half_width_m * a.half_height_m;
    a.extent2 = square(a.half_width_m) + square(a.half_height_m);
    RectangleCorners c = rectangle_corners(a.to_center_m, a.right, a.up, a.half_width_m, a.half_height_m);
    a.outline[0] = c.p0;
    a.outline[1] = c.p1;
    a.outline[2] = c.p2;
    a.outline[3] = c.p3;
}

void place_ellipse(int kind, Light light, inout AreaLight a) {
    if (is_kind(kind, kLightSun)) {
        // The sphere at 1 m that fills the sun's disc. Limb darkening changes what is seen of it, not its illuminance.
        a.to_center_m = -a.direction;
        a.radius_m = sin(light.right_b.w);
        a.nit = light.color_type.rgb * sun_nit_from_lx(1.0, 2.0 * light.right_b.w);
    }
    sphere_outline(a.to_center_m, a.radius_m, a.outline[0], a.outline[1], a.outline[2]);
    if (is_kind(kind, kLightDisk)) {
        turn_to_receiver(light, a);
        a.up = cross(a.right, a.direction);
        a.outline[0] = a.to_center_m;
        a.outline[1] = a.right * a.radius_m;
        a.outline[2] = a.up * a.radius_m;
    }
}

AreaLight area_light(uint group, int kind, Light light, vec3 position) {
    AreaLight a;
    a.direction = light.direction_a.xyz;
    a.right = light.right_b.xyz;
    a.half_width_m = light.direction_a.w;
    a.half_height_m = light.right_b.w;
    a.radius_m = light.right_b.w;
    a.to_center_m = light.position_range.xyz - position;
    a.nit = light.color_type.rgb;
    if (group == kPolygons && is_kind(kind, kLightTriangle)) {
        place_triangle(light, position, a);
        return a;
    }
    a.nit *= window_attenuation(length(a.to_center_m), light.position_range.w);
    if (group == kPolygons) place_rectangle(light, a);
    if (group == kEllipses) {
        place_ellipse(kind, light, a);
        if (is_kind(kind, kLightDisk)) a.nit *= disk_cone(light, a.to_center_m, a.direction);
    }
    if (is_kind(kind, kLightLine)) a.radius_m = kLineRadius_m;
    return a;
}

float rectangle_illuminance(vec3 n, AreaLight a) {
    vec3 c = a.to_center_m;
    float w = a.half_width_m;
    float h = a.half_height_m;
    switch (kAreaDiffuse) {
        case kAreaDiffuseStructured: return rectangle_projected_solid_angle_structured(n, c, a.right, a.up, w, h);
        case kAreaDiffuseFormFactor: return rectangle_projected_solid_angle_arvo(n, c, a.right, a.up, w, h);
        case kAreaDiffuseRepresentativePoint:
            return rectangle_projected_solid_angle_simplified(n, c, a.right, a.up, w, h);
        case kAreaDiffuseDrobot: return rectangle_projected_solid_angle_drobot(n, c, a.right, a.up, w, h);
        case kAreaDiffuseLightPosition: return rectangle_projected_solid_angle_position(n, c, a.right, a.up, w, h);
        default: return rectangle_projected_solid_angle_five_times(n, c, a.right, a.up, w, h);
    }
}
float polygon_illuminance(int kind, vec3 n, AreaLight a) {
    if (kAreaDiffuse != kAreaDiffuseExact && is_kind(kind, kLightRectangle)) return rectangle_illuminance(n, a);
    return polygon_projected_solid_angle(n, a.to_center_m, -a.area_m2 * a.direction, a.extent2, a.outline[0],
                                         a.outline[1], a.outline[2], a.outline[3]);
}
float sphere_illuminance(vec3 n, AreaLight a) {
    switch (kAreaDiffuse) {
        case kAreaDiffuseFormFactor:
        case kAreaDiffuseLightPosition: return sphere_projected_solid_angle_no_horizon(n, a.to_center_m, a.radius_m);
        case kAreaDiffuseFiveTimes: return sphere_projected_solid_angle_five_times(n, a.to_center_m, a.radius_m);
        default: return sphere_projected_solid_angle(n, a.to_center_m, a.radius_m);
    }
}
float disk_illuminance(vec3 n, AreaLight a) {
    switch (kAreaDiffuse) {
        case kAreaDiffuseStructured:
        case kAreaDiffuseRepresentativePoint:
        case kAreaDiffuseDrobot: return disk_projected_solid_angle_frostbite(n, a.to_center_m, a.direction, a.radius_m);
        case kAreaDiffuseFormFactor:
        case kAreaDiffuseLightPosition:
            return disk_projected_solid_angle_no_horizon(n, a.to_center_m, a.direction, a.radius_m);
        case kAreaDiffuseFiveTimes:
            return disk_projected_solid_angle_five_times(n, a.to_center_m, a.direction, a.radius_m);
        default: return disk_projected_solid_angle(n, a.to_center_m, a.direction, a.radius_m);
    }
}
float tube_illuminance(vec3 n, AreaLight a) {
    switch (kAreaDiffuse) {
        case kAreaDiffuseExact: return tube_projected_solid_angle(n, a.to_center_m, a.right, a.half_width_m, a.radius_m);
        case kAreaDiffuseFiveTimes:
            return tube_projected_solid_angle_five_times(n, a.to_center_m, a.right, a.half_width_m, a.radius_m);
        case kAreaDiffuseLightPosition:
            return lamp_tube_projected_solid_angle(n, a.to_center_m, a.right, a.half_width_m, a.radius_m);
        default: return tube_projected_solid_angle_frostbite(n, a.to_center_m, a.right, a.half_width_m, a.radius_m);
    }
}

float line_lx(vec3 n, AreaLight a) {
    if (kAreaDiffuse != kAreaDiffuseLightPosition) return line_illuminance(n, a.to_center_m, a.right, a.half_width_m);
    return lamp_line_illuminance(n, a.to_center_m, a.right, a.half_width_m);
}

// Whether a group's kinds are all one, so that the others' code need not run.
bool only_kind(uint group, int which) {
    uint kinds = group == kCapsules ? (1u << kLightLine) | (1u << kLightTube)
                                    : (1u << kLightSun) | (1u << kLightSphere) | (1u << kLightDisk);
    return (kLightKinds & kinds) == (1u << uint(which));
}

// lx per unit of AreaLight::nit on a surface of normal n.
float area_illuminance(uint group, int kind, vec3 n, AreaLight a) {
    if (group == kPolygons) return polygon_illuminance(kind, n, a);
    if (group == kCapsules) {
        float of_line = is_kind(kind, kLightLine) ? line_lx(n, a) : 0.0;
        if (only_kind(group, kLightLine)) return of_line;
        return is_kind(kind, kLightLine) ? of_line : tube_illuminance(n, a);
    }
    float of_disk = is_kind(kind, kLightDisk) ? disk_illuminance(n, a) : 0.0;
    if (only_kind(group, kLightDisk)) return of_disk;
    return is_kind(kind, kLightDisk) ? of_disk : sphere_illuminance(n, a);
}

// The direction in which lobes are taken that are evaluated once for the whole light; n . l > 0. Frostbite 4.7.4.
vec3 area_direction(uint group, int kind, vec3 n, AreaLight a) {
    if (kAreaDirection == kAreaDirectionLightPosition || is_kind(kind, kLightTriangle)) {
        return direction_above_horizon(n, direction_of(a.to_center_m));
    }
    if (is_kind(kind, kLightDisk)) return disk_representative_direction(n, a.to_center_m, a.direction, a.radius_m);
    if (group == kPolygons) {
        return rectangle_representative_direction(n, a.to_center_m, a.right, a.up, a.half_width_m, a.half_height_m);
    }
    if (group == kCapsules) {
        return tube_representative_direction(n, a.to_center_m, a.right, a.half_width_m, a.radius_m);
    }
    return sphere_representative_direction(n, a.to_center_m, a.radius_m);
}

// Where a line's highlight has a luminance, its cd become that of the thin tube that gives them.
float highlight_nit(int kind, AreaLight a) {
    return is_kind(kind, kLightLine) ? 1.0 / tube_projected_area(kLineRadius_m, 2.0 * a.half_width_m) : 1.0;
}

#include "light_pictures.glsl"

// What a picture makes of a lobe: the cosine about `axis` sees the corners. From behind it is that of the front, seen through.
vec3 picture_seen(uint group, Light light, bool turned, vec3 axis, vec3 p0, vec3 p1, vec3 p2, vec3 p3) {
    if (!kLightPictures || group != kPolygons) return vec3(1.0);
    vec3 spot = rectangle_image_spot(axis, p0, p1, p2, p3);
    return read_picture(light, vec3(spot.x, turned ? 1.0 - spot.y : spot.y, spot.z));
}

#include "area_highlights.glsl"

// Part of the light above the surface's own plane, by its extent along the normal.
float area_above_surface(uint group, AreaLight a, vec3 surface_normal) {
    float height = dot(surface_normal, a.to_center_m);
    float extent;
    if (group == kPolygons) {
        vec4 heights = surface_normal * mat4x3(a.outline[0], a.outline[1], a.outline[2], a.outline[3]);
        float low = min(min(heights.x, heights.y), min(heights.z, heights.w));
        float high = max(max(heights.x, heights.y), max(heights.z, heights.w));
        height = 0.5 * (high + low);
        extent = 0.5 * (high - low);
    } else if (group == kCapsules) {
        extent = abs(dot(surface_normal, a.right)) * a.half_width_m + a.radius_m;
    } else {
        // Of spheres and suns in another unit than to_center_m.
        height = dot(surface_normal, a.outline[0]);
        extent = length(vec2(dot(surface_normal, a.outline[1]), dot(surface_normal, a.outline[2])));
    }
    return saturate(0.5 + 0.5 * height / max(extent, 1.0e-20));
}

void add_area_light(uint group, int kind, Light light, SurfacePoint p, inout Lit lit) {
    AreaLight a = area_light(group, kind, light, p.position);
    vec3 specular;
    float lx_per_nit = area_highlights(group, kind, light, p, a, specular);
    vec3 l = area_direction(group, kind, p.g.normal, a);
    vec3 h = normalize(p.v + l);
    float NoL = saturate(dot(p.g.normal, l));
    float lobe = diffuse_lobe(techniques(), p.NoV, NoL, saturate(dot(l, h)), p.g.surface.perceptual_roughness);
    vec3 seen = picture_seen(group, light, a.turned, p.g.normal, a.outline[0], a.outline[1], a.outline[2],
                             a.outline[3]);
    vec3 diffuse = seen * p.prepared.diffuse * (p.area.under_layers * lobe * lx_per_nit);
    if (kShadeLayers) {
        specular += seen * p.g.surface.sheen_color *
                    (lx_per_nit * p.area.under_coat *
                     evaluate_sheen(p.NoV, NoL, saturate(dot(p.g.normal, h)), p.g.surface.sheen_perceptual_roughness));
    }
    if (kNormalMapped) a.nit *= area_above_surface(group, a, p.g.surface_normal);
    // Triangles of emissive surfaces have no shadow maps.
    if (kShadowKinds != 0u && !is_kind(kind, kLightTriangle) && max_component(a.nit) > 0.0) {
        a.nit *= light_visibility(light, p.position, p.facet, normalize(a.to_center_m), p.pixel);
    }
    lit.direct_diffuse += a.nit * diffuse;
    lit.direct_specular += a.nit * specular;
}

// What of the surface all area lights need.
void prepare_area_lights(inout SurfacePoint p) {
    Surface s = p.g.surface;
    // An emissive surface is a light on itself. Off it on the viewer's side, further than the depth buffer's rounding: on the
    // other side a light that shines both ways would fill the hemisphere.
    p.position += p.g.surface_normal * (1.0e-5 * distance(p.position, frame.camera_position.xyz));
    if (kAreaSpecular == kAreaSpecularLtc) {
        p.area.ltc = ltc_inverse_matrix(textureLod(ltc_table, ltc_uv(p.NoV, s.perceptual_roughness), 0.0));
    }
    p.area.under_coat = 1.0;
    p.area.under_layers = 1.0;
    if (!kShadeLayers) return;
    float coat_NoV = clamp(dot(p.g.coat_normal, p.v), 1.0e-4, 1.0);
    p.area.under_coat = coat_transmittance(s.coat, coat_NoV);
    p.area.under_layers = p.area.under_coat;
    if (max_component(s.sheen_color) > 0.0) {
        p.area.under_layers *=
            sheen_transmittance(s.sheen_color, sheen_directional_albedo(p.NoV, s.sheen_perceptual_roughness));
    }
    p.area.coat = coat_reflectance(s.coat, coat_NoV);
    if (kAreaSpecular == kAreaSpecularLtc) {
        vec4 dfg = directional_albedo(coat_NoV, s.coat_perceptual_roughness);
        vec4 texel = textureLod(ltc_table, ltc_uv(coat_NoV, s.coat_perceptual_roughness), 0.0);
        p.area.coat_albedo = dfg.x + dfg.y;
        p.area.coat_ltc = ltc_inverse_matrix(texel);
    }
}

#endif
