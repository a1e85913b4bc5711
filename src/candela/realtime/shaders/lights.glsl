// The punctual lights of the scene. C++: LightBlock in gpu_scene.cpp.
#ifndef CANDELA_LIGHTS_GLSL
#define CANDELA_LIGHTS_GLSL

#include "lights/punctual.glsl"

struct Light {
    vec4 position_range;
    vec4 color_intensity;
    vec4 direction_cosines;
    vec4 cos_outer;
};

const int kLightPoint = 0;
const int kLightSpot = 1;
const int kLightDirectional = 2;

// Direction to the light and the illuminance per channel (lx) that it gives on a plane facing it.
vec3 perpendicular_illuminance(Light light, vec3 position, out vec3 l) {
    int type = int(light.color_intensity.w);
    if (type == kLightDirectional) {
        l = -light.direction_cosines.xyz;
        return light.color_intensity.rgb;
    }
    vec3 to_light = light.position_range.xyz - position;
    l = to_light * inversesqrt(max(dot(to_light, to_light), 1e-12));
    float range_m = light.position_range.w;
    float attenuation = distance_attenuation(to_light, range_m);
    if (type == kLightSpot) {
        float cos_angle = dot(-l, light.direction_cosines.xyz);
        attenuation *= angle_attenuation(cos_angle, light.direction_cosines.w, light.cos_outer.x);
    }
    return light.color_intensity.rgb * attenuation;
}

#endif
