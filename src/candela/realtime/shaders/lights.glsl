// The lights of the scene. C++: LightBlock in light_list.hpp.
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

// C++: LightKind in light_list.hpp; the first ten are those of scene::LightType.
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
const uint kEndOfLights = 0u;

// Of links.x.
const int kLightTwoSided = 1;
const int kLightLimbDarkening = 2;

// Of lights without extent: the direction to the light and the illuminance per channel (lx) that it gives on a plane
// facing it. What needs no profile, no angle, no distance does without when `kind` is a constant.
vec3 perpendicular_illuminance(int kind, Light light, vec3 position, out vec3 l) {
    if (kind == kLightDirectional || kind == kLightSun) {
        l = -light.direction_a.xyz;
        return light.color_type.rgb;
    }
    vec3 to_light = light.position_range.xyz - position;
    l = to_light * inversesqrt(max(dot(to_light, to_light), 1e-12));
    float attenuation = distance_attenuation(to_light, light.position_range.w);
    if (kind == kLightSpot) {
        float cos_angle = dot(-l, light.direction_a.xyz);
        attenuation *= angle_attenuation(cos_angle, light.direction_a.w, light.right_b.w);
    }
    if (kind == kLightFrustum) {
        // Through the opening of the pyramid, one metre from its apex.
        float along = -dot(to_light, light.direction_a.xyz);
        float x = abs(dot(to_light, light.right_b.xyz));
        float y = abs(dot(to_light, cross(light.right_b.xyz, light.direction_a.xyz)));
        bool inside = x <= along * light.direction_a.w && y <= along * light.right_b.w;
        attenuation = inside ? attenuation : 0.0;
    }
    return light.color_type.rgb * attenuation;
}

#endif
