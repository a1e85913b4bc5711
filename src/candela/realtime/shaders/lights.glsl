// The lights of the scene. C++: LightBlock in light_block.hpp.
#ifndef CANDELA_LIGHTS_GLSL
#define CANDELA_LIGHTS_GLSL

#include "lights/falloff_windows.glsl"

// Of the profile (C++: FalloffTechnique, Profile::falloff_offset_m2).
layout(constant_id = 26) const int kFalloff = 0;
layout(constant_id = 27) const float kFalloffOffset_m2 = 1.0e-4;

struct Light {
    vec4 position_range;  // m; w = window radius in m. A triangle: its first corner
    vec4 color_type;      // rgb * (cd, lx or cd/m^2); w = kind
    vec4 direction_a;     // unit, the way the light travels; w by kind:
                          //   spot cosine of the inner half angle, frustum tangent of half the horizontal angle,
                          //   line, tube half length in m, rectangle half width in m, sun cosine of the angular radius.
                          // A triangle: its second corner in m
    vec4 right_b;         // unit; w by kind: spot cosine of the outer half angle, frustum tangent of half the vertical
                          //   angle, rectangle half height in m, sphere, disk, tube radius in m, sun angular radius in rad.
                          // A triangle: its third corner in m
    ivec4 links;          // x kLightTwoSided | ..., y first number of the profile's table or the picture's, -1: none, z shadow,
                          //   -1: none, w width | height << 16 of the profile, texels a side of the picture. Of a disk
                          //   with a cone y and w are the bits of the cosines of its inner and outer half angle; y -1: none
};

// C++: LightKind in light_list.hpp; the first ten are those of scene::LightType.
const int kLightPoint = 0;
const int kLightSpot = 1;
const int kLightDirectional = 2;
const int kLightFrustum = 3;
const int kLightLine = 4;
const int kLightTube = 5;
const int kLightSun = 6;
const int kLightSphere = 7;
const int kLightDisk = 8;
const int kLightRectangle = 9;
const int kLightTriangle = 10;
const int kLightPhotometric = 11;

// Of links.x.
const int kLightTwoSided = 1;
const int kLightLimbDarkening = 2;
const int kLightVisible = 4;

// What a disk's cone leaves of its light at a point; direction: unit, the way the side shines that is turned there.
float disk_cone(Light light, vec3 to_center_m, vec3 direction) {
    if (light.links.y < 0) return 1.0;
    return disk_cone_attenuation(to_center_m, direction, light.right_b.w, intBitsToFloat(light.links.y),
                                 intBitsToFloat(light.links.w));
}

// Of lights without extent: the direction to the light and the illuminance per channel (lx) that it gives on a plane
// facing it, without a profile. What needs no distance or angle does without when `kind` is a constant.
vec3 perpendicular_illuminance(int kind, Light light, vec3 position, out vec3 l) {
    if (kind == kLightDirectional) {
        l = -light.direction_a.xyz;
        return light.color_type.rgb;
    }
    vec3 to_light = light.position_range.xyz - position;
    l = to_light * inversesqrt(max(dot(to_light, to_light), 1e-12));
    float attenuation = distance_attenuation(Falloff(kFalloff, kFalloffOffset_m2), to_light, light.position_range.w);
    if (kind == kLightSpot || kind == kLightPhotometric) {
        float cos_angle = dot(-l, light.direction_a.xyz);
        attenuation *= angle_attenuation(cos_angle, light.direction_a.w, light.right_b.w);
    }
    if (kind == kLightFrustum) {
        vec3 up = cross(light.right_b.xyz, light.direction_a.xyz);
        attenuation *= frustum_attenuation(-l, light.direction_a.xyz, light.right_b.xyz, up, light.direction_a.w,
                                           light.right_b.w);
    }
    return light.color_type.rgb * attenuation;
}
vec3 perpendicular_illuminance(Light light, vec3 position, out vec3 l) {
    return perpendicular_illuminance(int(light.color_type.w), light, position, l);
}

#endif
