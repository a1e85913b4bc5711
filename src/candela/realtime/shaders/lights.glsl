// The lights of the scene. C++: LightBlock in gpu_scene.cpp.
#ifndef CANDELA_LIGHTS_GLSL
#define CANDELA_LIGHTS_GLSL

#include "lights/punctual.glsl"

struct Light {
    vec4 position_range;  // m; w = window radius in m
    vec4 color_type;      // rgb * (cd, lx or cd/m^2); w = type
    vec4 direction_a;     // unit, the way the light travels; w by type:
                          //   spot cosine of the inner half angle, frustum tangent of half the horizontal angle,
                          //   line, tube half length in m, rectangle half width in m, sun cosine of the angular radius
    vec4 right_b;         // unit; w by type: spot cosine of the outer half angle, frustum tangent of half the vertical
                          //   angle, rectangle half height in m, sphere, disk, tube radius in m
    ivec4 links;          // x kTwoSided | ..., y row of the profile or layer of the image, z shadow; -1: none
};

// C++: scene::LightType.
const int kLightPoint = 0;
const int kLightSpot = 1;
const int kLightDirectional = 2;
const int kLightFrustum = 3;
const int kLightLine = 4;
const int kLightSun = 5;
const int kLightSphere = 6;
const int kLightDisk = 7;
const int kLightRectangle = 8;
const int kLightTube = 9;

// Of links.x.
const int kLightTwoSided = 1;
const int kLightLimbDarkening = 2;

// Direction to the light and the illuminance per channel (lx) that it gives on a plane facing it.
vec3 perpendicular_illuminance(Light light, vec3 position, out vec3 l) {
    int type = int(light.color_type.w);
    if (type == kLightDirectional || type == kLightSun) {
        l = -light.direction_a.xyz;
        return light.color_type.rgb;
    }
    vec3 to_light = light.position_range.xyz - position;
    l = to_light * inversesqrt(max(dot(to_light, to_light), 1e-12));
    float range_m = light.position_range.w;
    float attenuation = distance_attenuation(to_light, range_m);
    if (type == kLightSpot) {
        float cos_angle = dot(-l, light.direction_a.xyz);
        attenuation *= angle_attenuation(cos_angle, light.direction_a.w, light.right_b.w);
    }
    return light.color_type.rgb * attenuation;
}

#endif
