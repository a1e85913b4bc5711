// The specular half of area_lights.glsl: what a base lobe, and a coat, reflect of a light, per cd/m^2.
#ifndef CANDELA_AREA_HIGHLIGHTS_GLSL
#define CANDELA_AREA_HIGHLIGHTS_GLSL

float area_ltc(int kind, mat3 m, vec3 n, vec3 v, AreaLight a) {
    if (kind == kLightDisk) return ltc_disk(m, n, v, a.to_center_m, a.direction, a.radius_m);
    if (kind == kLightRectangle) {
        return ltc_rectangle(m, n, v, a.to_center_m, a.right, a.up, a.half_width_m, a.half_height_m);
    }
    if (kind == kLightTube || kind == kLightLine) {
        return ltc_tube(m, n, v, a.to_center_m, a.right, a.half_width_m, a.radius_m);
    }
    if (kind == kLightTriangle) return ltc_triangle(m, n, v, a.corners[0], a.corners[1], a.corners[2]);
    return ltc_sphere(m, n, v, a.to_center_m, a.radius_m);
}

// The point that stands for the light in a lobe about `mirror`, and the lobe's normalization.
vec3 area_highlight_point(int kind, AreaLight a, vec3 mirror, float alpha, out float normalization) {
    float distance_m = length(a.to_center_m);
    normalization = 1.0;
    if (kind == kLightSun) {
        // The sun is so small that there is nothing to take back (Frostbite 4.6).
        float angular_radius_rad = atan(a.radius_m, sqrt(1.0 - square(a.radius_m)));
        return representative_direction_of_sun(a.to_center_m, mirror, angular_radius_rad);
    }
    if (kind == kLightRectangle) {
        normalization = representative_point_rectangle_normalization(alpha, a.half_width_m, a.half_height_m, distance_m);
        return representative_point_rectangle(a.to_center_m, a.right, a.up, a.half_width_m, a.half_height_m, mirror);
    }
    if (kind == kLightTube || kind == kLightLine) {
        normalization = representative_point_tube_normalization(alpha, a.half_width_m, a.radius_m, distance_m);
        return representative_point_tube(a.to_center_m, a.right, a.half_width_m, a.radius_m, mirror);
    }
    normalization = representative_point_sphere_normalization(alpha, a.radius_m, distance_m);
    if (kind == kLightDisk || kind == kLightTriangle) {
        return representative_point_disk(a.to_center_m, a.direction, a.radius_m, mirror);
    }
    return representative_point_sphere(a.to_center_m, mirror, a.radius_m);
}

// D V of the point, and its direction.
float area_highlight_lobe(int kind, AreaLight a, vec3 n, vec3 v, float alpha, out vec3 l) {
    float normalization;
    vec3 point = a.to_center_m;
    float lobe_alpha = alpha;
    if (kAreaSpecular == kAreaSpecularWidening) {
        normalization = 1.0;
        float width_m = kind == kLightTube || kind == kLightLine || kind == kLightRectangle
                            ? max(a.half_width_m, a.half_height_m) : a.radius_m;
        lobe_alpha = alpha_widened_by_sphere(alpha, width_m, length(point));
    } else {
        vec3 mirror = reflect(-v, n);
        if (kAreaSpecular == kAreaSpecularDominantDirection) mirror = specular_dominant_direction_area(n, mirror, alpha);
        point = area_highlight_point(kind, a, mirror, alpha, normalization);
    }
    l = direction_of(point);
    return normalization * specular_at_point(n, v, point, alpha, lobe_alpha);
}

vec3 base_highlight(int kind, SurfacePoint p, AreaLight a, float lx_per_nit) {
    if (kAreaSpecular == kAreaSpecularLtc) {
        // The lobe's albedo with Fresnel is in the table of the split sum (Hill & Heitz 2016, "LTC Fresnel Approximation", in
        // other words).
        vec3 albedo = p.prepared.specular_f0 * p.dfg.x + p.prepared.specular_f90 * p.dfg.y;
        return albedo * area_ltc(kind, p.area.ltc, p.g.normal, p.v, a);
    }
    vec3 l;
    float lobe = area_highlight_lobe(kind, a, p.g.normal, p.v, p.prepared.alpha, l);
    float LoH = saturate(dot(l, normalize(p.v + l)));
    return specular_fresnel(techniques(), p.prepared.specular_f0, p.prepared.specular_f90, LoH) * (lobe * lx_per_nit);
}

// An anisotropic base has its highlight from area lights as an isotropic one of the same roughness.
vec3 area_highlights(int kind, SurfacePoint p, AreaLight a, float lx_per_nit) {
    if (kind == kLightLine) lx_per_nit /= highlight_nit(kind, a);
    vec3 sum = base_highlight(kind, p, a, lx_per_nit) * p.area.under_layers;
    if (!kShadeLayers) return sum;
    if (kAreaSpecular == kAreaSpecularLtc) {
        return sum + p.area.coat * area_ltc(kind, p.area.coat_ltc, p.g.coat_normal, p.v, a);
    }
    vec3 l;
    float alpha = alpha_from_perceptual_roughness(p.g.surface.coat_perceptual_roughness);
    float lobe = area_highlight_lobe(kind, a, p.g.coat_normal, p.v, alpha, l);
    float coat_lx = area_illuminance(kind, p.g.coat_normal, a) / (kind == kLightLine ? highlight_nit(kind, a) : 1.0);
    return sum + vec3(p.area.coat * lobe * coat_lx);
}

#endif
