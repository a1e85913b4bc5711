// How each kind of light adds to what a surface point shows. The kind is a constant where these are called, so that
// every call keeps only its own kind's code.
#ifndef CANDELA_AREA_LIGHTS_GLSL
#define CANDELA_AREA_LIGHTS_GLSL

// A light without extent needs no estimate: its integral is one product.
void add_punctual_light(int kind, Light light, SurfacePoint p, inout Lit lit) {
    vec3 l;
    vec3 perpendicular_lx = perpendicular_illuminance(kind, light, p.position, l);
    float NoL = saturate(dot(p.g.normal, l));
    vec3 diffuse;
    vec3 specular;
    evaluate(p, l, NoL, diffuse, specular);
    vec3 illuminance_lx = perpendicular_lx * NoL;
    lit.direct_diffuse += diffuse * illuminance_lx;
    lit.direct_specular += specular * illuminance_lx;
}
void add_punctual_light(Light light, SurfacePoint p, inout Lit lit) {
    add_punctual_light(int(light.color_type.w), light, p, lit);
}

// Projected area in m^2 of a light towards a point far from it, in direction -l of the light.
float area_towards(int kind, Light light, vec3 l) {
    float facing = -dot(light.direction_a.xyz, l);
    if ((light.links.x & kLightTwoSided) != 0) facing = abs(facing);
    if (kind == kLightRectangle) return 4.0 * light.direction_a.w * light.right_b.w * max(facing, 0.0);
    if (kind == kLightDisk) return PI * square(light.right_b.w) * max(facing, 0.0);
    float across = length(cross(light.right_b.xyz, l));
    if (kind == kLightTube) return square(light.right_b.w) * PI + 4.0 * light.direction_a.w * light.right_b.w * across;
    if (kind == kLightLine) return across;
    return PI * square(light.right_b.w);
}

// A light with extent as if all of it were at its centre.
void add_area_light(int kind, Light light, SurfacePoint p, inout Lit lit) {
    vec3 l;
    vec3 perpendicular_lx = perpendicular_illuminance(kLightPoint, light, p.position, l) * area_towards(kind, light, l);
    float NoL = saturate(dot(p.g.normal, l));
    vec3 diffuse;
    vec3 specular;
    evaluate(p, l, NoL, diffuse, specular);
    lit.direct_diffuse += diffuse * (perpendicular_lx * NoL);
    lit.direct_specular += specular * (perpendicular_lx * NoL);
}

#endif
