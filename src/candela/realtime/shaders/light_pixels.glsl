// The body of the lighting pass: a workgroup is a tile of one shading class; the G-buffer is read once, all light is
// summed in 32 bit, and the result is written pre-exposed (Frostbite 5.2). Includers say how a surface is lit:
// light_surface(), defined after this file because it may read the images here, LIGHT_FORMAT of the light buffer, and
// whether the surface's position is needed (kNeedsPosition).
#ifndef CANDELA_LIGHT_PIXELS_GLSL
#define CANDELA_LIGHT_PIXELS_GLSL

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 11) const uint kShadingClass = 1u;
layout(constant_id = 12) const bool kHasEmissive = false;
layout(constant_id = 13) const bool kWriteAovs = false;

layout(set = 0, binding = kShadingBindings + 0) uniform usampler2D gbuffer_image;
layout(set = 0, binding = kShadingBindings + 1) uniform usampler2D layers_image;
layout(set = 0, binding = kShadingBindings + 2) uniform sampler2D depth_image;
layout(set = 0, binding = kShadingBindings + 3, LIGHT_FORMAT) uniform image2D light_image;
layout(set = 0, binding = kShadingBindings + 4, std430) readonly buffer Tiles {
    uvec4 dispatch[kClassCount];
    uint list[];
} tiles;
layout(set = 0, binding = kShadingBindings + 5, rgba32f) writeonly uniform image2D direct_diffuse_image;
layout(set = 0, binding = kShadingBindings + 6, rgba32f) writeonly uniform image2D direct_specular_image;
layout(set = 0, binding = kShadingBindings + 7, rgba32f) writeonly uniform image2D indirect_diffuse_image;
layout(set = 0, binding = kShadingBindings + 8, rgba32f) writeonly uniform image2D indirect_specular_image;
layout(set = 0, binding = kShadingBindings + 9, rgba32f) writeonly uniform image2D emissive_image;
layout(set = 0, binding = kShadingBindings + 10, rgba16f) writeonly uniform image2D unlit_image;
layout(set = 0, binding = kShadingBindings + 11) uniform usampler2D surface_normal_image;

Lit light_surface(GBuffer g, vec3 position, vec3 v, uvec2 pixel);

void write_aovs(ivec2 pixel, Lit lit, vec3 emissive_nit) {
    imageStore(direct_diffuse_image, pixel, vec4(lit.direct_diffuse, 1.0));
    imageStore(direct_specular_image, pixel, vec4(lit.direct_specular, 1.0));
    imageStore(indirect_diffuse_image, pixel, vec4(lit.indirect_diffuse, 1.0));
    imageStore(indirect_specular_image, pixel, vec4(lit.indirect_specular, 1.0));
    imageStore(emissive_image, pixel, vec4(emissive_nit, 1.0));
}

// Luminance in cd/m^2 of the suns' discs in a direction. Suns stand together in the list of lights.
vec3 suns_seen(vec3 direction) {
    vec3 sum_nit = vec3(0.0);
    for (int i = frame.lights.w; i < frame.size.z && int(lights[i].color_type.w) == kLightSun; ++i) {
        Light sun = lights[i];
        bool seen = (sun.links.x & kLightVisible) != 0 && meets_sun(direction, -sun.direction_a.xyz, sun.right_b.w);
        bool darkened = (sun.links.x & kLightLimbDarkening) != 0;
        float nit_per_lx = sun_nit_from_lx(direction, -sun.direction_a.xyz, sun.right_b.w, darkened);
        sum_nit += seen ? sun.color_type.rgb * nit_per_lx : vec3(0.0);
    }
    return sum_nit;
}

void main() {
    uint tile = tiles.list[kShadingClass * uint(frame.tiles.z) + gl_WorkGroupID.x];
    ivec2 pixel = ivec2(tile & 0xffffu, tile >> 16u) * 8 + ivec2(gl_LocalInvocationID.xy);
    if (any(greaterThanEqual(pixel, frame.size.xy))) return;
    float depth = texelFetch(depth_image, pixel, 0).r;

    if (kShadingClass == kClassBackground) {
        if (depth != 0.0) return;
        if (kCapturesProbe) {
            // Of the sky a probe only says that it is there: the distant light has it finer and newer.
            imageStore(light_image, pixel, vec4(0.0));
            return;
        }
        vec3 luminance_nit = vec3(0.0);
        if (kHasEnvironment) {
            luminance_nit = sample_background(background_map, to_environment(pixel_ray(pixel))) *
                            (frame.environment.z * frame.environment.w);
        }
        if ((kLightKinds & (1u << uint(kLightSun))) != 0u) luminance_nit += suns_seen(normalize(pixel_ray(pixel)));
        imageStore(light_image, pixel, vec4(pre_exposed(luminance_nit), 1.0));
        if (kWriteAovs) write_aovs(pixel, kNoLight, vec3(0.0));
        return;
    }

    uvec4 words = texelFetch(gbuffer_image, pixel, 0);
    if (shading_class(depth, words) != kShadingClass) return;

    if (kShadingClass == kClassUnlit) {
        if (kCapturesProbe) {
            // It occludes what is behind it, and gives no light.
            imageStore(light_image, pixel, vec4(0.0, 0.0, 0.0, 1.0));
            return;
        }
        bool emitter = words.w == kEmitterMark;
        vec3 stored = imageLoad(light_image, pixel).rgb;
        vec3 emissive_nit = emitter ? stored * frame.exposure.y : vec3(0.0);
        if (frame.tiles.w != 0 && !emitter) {
            // Alpha of the light buffer is the fraction of the pixel that shows light.
            imageStore(unlit_image, pixel, vec4(stored, 1.0));
            imageStore(light_image, pixel, vec4(0.0));
        }
        if (kWriteAovs) write_aovs(pixel, kNoLight, emissive_nit);
        return;
    }

    GBuffer g = unpack_gbuffer(words);
    if (kNormalMapped) {
        g.surface_normal = octahedral_decode(unpackSnorm2x16(texelFetch(surface_normal_image, pixel, 0).x));
    }
    if (kShadeLayers) unpack_layers(texelFetch(layers_image, pixel, 0), g);
    vec3 position = kNeedsPosition ? world_position(vec2(pixel) + 0.5, depth) : vec3(0.0);
    Lit lit = light_surface(g, position, -normalize(pixel_ray(pixel)), uvec2(pixel));
    lit = Lit(without_nan(lit.direct_diffuse), without_nan(lit.direct_specular), without_nan(lit.indirect_diffuse),
              without_nan(lit.indirect_specular));
    vec3 sum = (lit.direct_diffuse + lit.direct_specular + lit.indirect_diffuse + lit.indirect_specular) * frame.exposure.x;
    vec3 emissive = kHasEmissive ? imageLoad(light_image, pixel).rgb : vec3(0.0);
    sum += emissive;
    imageStore(light_image, pixel, vec4(min(sum, vec3(frame.exposure.w)), 1.0));
    if (kWriteAovs) write_aovs(pixel, lit, emissive * frame.exposure.y);
}

#endif
