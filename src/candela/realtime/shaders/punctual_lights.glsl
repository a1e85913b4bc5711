// Lights without extent: they need no estimate, their integral is one product.
#ifndef CANDELA_PUNCTUAL_LIGHTS_GLSL
#define CANDELA_PUNCTUAL_LIGHTS_GLSL

#include "lights/photometric.glsl"

// Intensity in cd along -l: the profile's, turned with the light.
float profile_intensity(Light light, vec3 l) {
    vec3 up = cross(light.right_b.xyz, light.direction_a.xyz);
    vec3 local = vec3(-dot(l, light.right_b.xyz), -dot(l, up), dot(l, light.direction_a.xyz));
    PhotometricTaps taps = photometric_taps(local, light.links.w & 0xffff, light.links.w >> 16);
    vec4 cd = vec4(light_tables[light.links.y + taps.index.x], light_tables[light.links.y + taps.index.y],
                   light_tables[light.links.y + taps.index.z], light_tables[light.links.y + taps.index.w]);
    return dot(cd, taps.weight);
}

// The kind is a constant where this is called, so that every call keeps only its own kind's code.
void add_punctual_light(int kind, Light light, SurfacePoint p, inout Lit lit) {
    vec3 l;
    vec3 perpendicular_lx = perpendicular_illuminance(kind, light, p.position, l);
    if (kind == kLightPhotometric) perpendicular_lx *= profile_intensity(light, l);
    float NoL = saturate(dot(p.g.normal, l));
    vec3 diffuse;
    vec3 specular;
    evaluate(p, techniques(), l, NoL, diffuse, specular);
    if (kind == kLightDirectional && kSunByLobe && (!kNormalMapped || above_surface(p.g.surface_normal, l))) {
        specular = sun_specular(p, l) / max(NoL, 1.0e-6);
    }
    vec3 illuminance_lx = perpendicular_lx * NoL;
    if (kShadowKinds != 0u && max_component(illuminance_lx) > 0.0) {
        illuminance_lx *= light_visibility(light, p.position, p.facet, l, p.pixel);
    }
    lit.direct_diffuse += diffuse * illuminance_lx;
    lit.direct_specular += specular * illuminance_lx;
}

#endif
