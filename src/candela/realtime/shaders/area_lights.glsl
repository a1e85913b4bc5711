// Lights with extent. Diffuse light is their illuminance times the diffuse lobe, taken in one direction that represents
// them; highlights are linearly transformed cosines or the lobe at a representative point. The kind is a constant where
// these functions are called, so that every call keeps only its own kind's code.
#ifndef CANDELA_AREA_LIGHTS_GLSL
#define CANDELA_AREA_LIGHTS_GLSL

#include "lights/disk.glsl"
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

const uint kAreaKinds = (1u << kLightLine) | (1u << kLightSun) | (1u << kLightSphere) | (1u << kLightDisk) |
                        (1u << kLightRectangle) | (1u << kLightTube) | (1u << kLightTriangle);

// A line is a tube of the thickness below which punctual lights end, where only its highlight is concerned.
const float kLineRadius_m = 0.5 * kPunctualMinDistance_m;

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
    vec3 corners[3];  // of a triangle, in the order in which rectangle_corners has a rectangle's
};

AreaLight triangle_light(Light light, vec3 position) {
    AreaLight a;
    a.nit = light.color_type.rgb;
    a.corners[0] = light.position_range.xyz - position;
    a.corners[1] = light.direction_a.xyz - position;
    a.corners[2] = light.right_b.xyz - position;
    vec3 twice_area = cross(a.corners[1] - a.corners[0], a.corners[2] - a.corners[0]);
    float area2_m2 = length(twice_area);
    a.direction = twice_area / max(area2_m2, 1.0e-20);
    if (dot(a.direction, a.corners[0]) > 0.0) {
        if ((light.links.x & kLightTwoSided) == 0) a.nit = vec3(0.0);
        a.direction = -a.direction;
    } else {
        vec3 swap = a.corners[1];
        a.corners[1] = a.corners[2];
        a.corners[2] = swap;
    }
    a.to_center_m = (a.corners[0] + a.corners[1] + a.corners[2]) * (1.0 / 3.0);
    a.radius_m = sqrt(0.5 * INV_PI * area2_m2);  // of the disk of the same area
    return a;
}

AreaLight area_light(int kind, Light light, vec3 position) {
    if (kind == kLightTriangle) return triangle_light(light, position);
    AreaLight a;
    a.nit = light.color_type.rgb;
    a.direction = light.direction_a.xyz;
    a.right = light.right_b.xyz;
    a.half_width_m = light.direction_a.w;
    a.half_height_m = light.right_b.w;
    a.radius_m = light.right_b.w;
    if (kind == kLightSun) {
        // The sphere at 1 m that fills the sun's disc. Limb darkening changes what is seen of it, not its illuminance.
        a.to_center_m = -a.direction;
        a.radius_m = sin(light.right_b.w);
        a.nit *= sun_nit_from_lx(1.0, 2.0 * light.right_b.w);
        return a;
    }
    a.to_center_m = light.position_range.xyz - position;
    a.nit *= window_attenuation(length(a.to_center_m), light.position_range.w);
    if (kind == kLightLine) a.radius_m = kLineRadius_m;
    if (kind == kLightDisk || kind == kLightRectangle) {
        if (dot(a.direction, a.to_center_m) > 0.0) {
            if ((light.links.x & kLightTwoSided) == 0) a.nit = vec3(0.0);
            a.direction = -a.direction;
        }
        a.up = cross(a.right, a.direction);
    }
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
        case kAreaDiffuseFiveTimes: return rectangle_projected_solid_angle_five_times(n, c, a.right, a.up, w, h);
        default: return rectangle_projected_solid_angle(n, c, a.right, a.up, w, h);
    }
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
        default: return tube_projected_solid_angle_frostbite(n, a.to_center_m, a.right, a.half_width_m, a.radius_m);
    }
}

// lx per unit of AreaLight::nit on a surface of normal n.
float area_illuminance(int kind, vec3 n, AreaLight a) {
    if (kind == kLightLine) return line_illuminance(n, a.to_center_m, a.right, a.half_width_m);
    if (kind == kLightDisk) return disk_illuminance(n, a);
    if (kind == kLightRectangle) return rectangle_illuminance(n, a);
    if (kind == kLightTube) return tube_illuminance(n, a);
    if (kind == kLightTriangle) return triangle_projected_solid_angle(n, a.corners[0], a.corners[1], a.corners[2]);
    return sphere_illuminance(n, a);
}

// The direction in which lobes are taken that are evaluated once for the whole light; n . l > 0. Frostbite 4.7.4.
vec3 area_direction(int kind, vec3 n, AreaLight a) {
    if (kAreaDiffuse == kAreaDiffuseLightPosition || kind == kLightTriangle) {
        return direction_above_horizon(n, direction_of(a.to_center_m));
    }
    if (kind == kLightDisk) return disk_representative_direction(n, a.to_center_m, a.direction, a.radius_m);
    if (kind == kLightRectangle) {
        return rectangle_representative_direction(n, a.to_center_m, a.right, a.up, a.half_width_m, a.half_height_m);
    }
    if (kind == kLightTube || kind == kLightLine) {
        return tube_representative_direction(n, a.to_center_m, a.right, a.half_width_m, a.radius_m);
    }
    return sphere_representative_direction(n, a.to_center_m, a.radius_m);
}

// Where a line's highlight has a luminance, its cd become that of the thin tube that gives them.
float highlight_nit(int kind, AreaLight a) {
    return kind == kLightLine ? 1.0 / tube_projected_area(kLineRadius_m, 2.0 * a.half_width_m) : 1.0;
}

#include "area_highlights.glsl"

void add_area_light(int kind, Light light, SurfacePoint p, inout Lit lit) {
    AreaLight a = area_light(kind, light, p.position);
    float lx_per_nit = area_illuminance(kind, p.g.normal, a);
    // Triangles of emissive surfaces have no shadow maps.
    if (kShadowKinds != 0u && kind != kLightTriangle && lx_per_nit * max_component(a.nit) > 0.0) {
        a.nit *= light_visibility(light, p.position, p.facet, normalize(a.to_center_m), p.pixel);
    }
    vec3 l = area_direction(kind, p.g.normal, a);
    vec3 h = normalize(p.v + l);
    float NoL = saturate(dot(p.g.normal, l));
    float lobe = diffuse_lobe(techniques(), p.NoV, NoL, saturate(dot(l, h)), p.g.surface.perceptual_roughness);
    vec3 illuminance_lx = a.nit * lx_per_nit;
    lit.direct_diffuse += p.prepared.diffuse * p.area.under_layers * lobe * illuminance_lx;
    lit.direct_specular += a.nit * highlight_nit(kind, a) * area_highlights(kind, p, a, lx_per_nit);
    if (kShadeLayers) {
        lit.direct_specular += p.g.surface.sheen_color * illuminance_lx *
                               (p.area.under_coat * evaluate_sheen(p.NoV, NoL, saturate(dot(p.g.normal, h)),
                                                                   p.g.surface.sheen_perceptual_roughness));
    }
}

// What of the surface all area lights need.
void prepare_area_lights(inout SurfacePoint p) {
    Surface s = p.g.surface;
    // An emissive surface is a light on itself. Off it on the viewer's side, further than the depth buffer's rounding: on the
    // other side a light that shines both ways would fill the hemisphere.
    p.position += p.g.normal * (1.0e-5 * distance(p.position, frame.camera_position.xyz));
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
        p.area.coat *= dfg.x + dfg.y;
        p.area.coat_ltc = ltc_inverse_matrix(texel);
    }
}

#endif
