// The specular half of area_lights.glsl: what a base lobe, and a coat, reflect of a light, per cd/m^2.
#ifndef CANDELA_AREA_HIGHLIGHTS_GLSL
#define CANDELA_AREA_HIGHLIGHTS_GLSL

vec3 area_ltc(uint group, Light light, LtcFrame lobe, AreaLight a) {
    if (group == kPolygons) {
        vec3 p0 = lobe.to_cosine * a.outline[0];
        vec3 p1 = lobe.to_cosine * a.outline[1];
        vec3 p2 = lobe.to_cosine * a.outline[2];
        vec3 p3 = lobe.to_cosine * a.outline[3];
        return picture_seen(group, light, a.turned, kCosineNormal, p0, p1, p2, p3) * ltc_quad(lobe, p0, p1, p2, p3);
    }
    if (group == kCapsules) return vec3(ltc_capsule(lobe, a.to_center_m, a.right, a.half_width_m, a.radius_m));
    return vec3(ltc_ellipse(lobe, a.outline[0], a.outline[1], a.outline[2]));
}

// Frostbite has found no normalization for disks and rectangles (4.7.5) and takes none; Karis has neither shape.
const bool kFlatNormalized = kAreaSpecular != kAreaSpecularDominantDirection;

// The point that stands for the light in a lobe about `mirror`, and the lobe's normalization.
vec3 area_highlight_point(uint group, int kind, AreaLight a, vec3 v, vec3 mirror, float alpha, out float normalization) {
    float distance_m = length(a.to_center_m);
    normalization = 1.0;
    // The page has lights of no other shape, and no normalization.
    if (kAreaSpecular == kAreaSpecularTeachingPage && is_kind(kind, kLightSphere)) {
        return representative_direction_TeachingPage(a.to_center_m / distance_m, v, mirror, a.radius_m / distance_m);
    }
    if (is_kind(kind, kLightSun)) {
        // The sun is so small that there is nothing to take back (Frostbite 4.6).
        float angular_radius_rad = atan(a.radius_m, sqrt(1.0 - square(a.radius_m)));
        return representative_direction_of_sun(a.to_center_m, mirror, angular_radius_rad);
    }
    if (is_kind(kind, kLightRectangle)) {
        if (kFlatNormalized) {
            normalization = representative_point_rectangle_normalization(alpha, a.half_width_m, a.half_height_m, distance_m);
        }
        return representative_point_rectangle(a.to_center_m, a.right, a.up, a.half_width_m, a.half_height_m, mirror);
    }
    if (group == kCapsules) {
        float radius_m = is_kind(kind, kLightLine) ? 0.0 : a.radius_m;
        normalization = representative_point_tube_normalization(alpha, a.half_width_m, radius_m, distance_m);
        return representative_point_tube(a.to_center_m, a.right, a.half_width_m, radius_m, mirror);
    }
    bool flat_one = group == kPolygons || is_kind(kind, kLightDisk);
    if (kFlatNormalized || !flat_one) {
        normalization = representative_point_sphere_normalization(alpha, a.radius_m, distance_m);
    }
    if (flat_one) {
        return representative_point_disk(a.to_center_m, a.direction, a.radius_m, mirror);
    }
    return representative_point_sphere(a.to_center_m, mirror, a.radius_m);
}

// One lobe: a base's f0 and f90 with the albedo of its lobe, or a coat's.
struct AreaLobe {
    mat3 ltc;
    vec3 n;
    float perceptual_roughness;
    float alpha;
    vec3 albedo;  // with Fresnel
    vec3 f0;
    vec3 f90;
};

// Radius in m of the disc that spreads a lobe as much as the shape does: equal second moments. Own.
float spreading_radius(uint group, int kind, AreaLight a) {
    if (is_kind(kind, kLightTriangle)) {
        vec3 p = a.outline[0] - a.to_center_m;
        vec3 q = a.outline[1] - a.to_center_m;
        vec3 r = a.outline[2] - a.to_center_m;
        return sqrt((dot(p, p) + dot(q, q) + dot(r, r)) * (1.0 / 6.0));
    }
    if (group == kPolygons) return rectangle_spreading_radius(a.half_width_m, a.half_height_m);
    if (group == kCapsules) {
        float radius_m = is_kind(kind, kLightLine) ? 0.0 : a.radius_m;
        return tube_spreading_radius(a.half_width_m, radius_m);
    }
    return a.radius_m;
}

// Angular radius of a light over alpha up to which it is a point to the lobe, and from which on it is a shape.
const float kPointToLobe = 0.1;
const float kShapeToLobe = 0.4;

// What of a highlight by LTC is that of a point: transformed cosines are a fit, off by up to a fifth at one direction, so that
// light of small shapes would not tend to that of a point.
float point_share(uint group, int kind, AreaLight a, float alpha) {
    if (is_kind(kind, kLightSun)) return alpha < kSunImageAlpha ? 0.0 : 1.0;
    float angle_rad = spreading_radius(group, kind, a) / length(a.to_center_m);
    return 1.0 - smoothstep(kPointToLobe, kShapeToLobe, angle_rad / alpha);
}

// D V of the point, and its direction.
float area_highlight_lobe(uint group, int kind, AreaLight a, AreaLobe lobe, vec3 v, out vec3 l) {
    float normalization = 1.0;
    vec3 n = lobe.n;
    float alpha = lobe.alpha;
    vec3 point = a.to_center_m;
    float lobe_alpha = alpha;
    if (kAreaSpecular == kAreaSpecularLtc) {
        lobe_alpha = alpha_widened_by_disc(alpha, spreading_radius(group, kind, a) / length(point));
    } else if (kAreaSpecular == kAreaSpecularWidening) {
        bool wide = group == kCapsules || is_kind(kind, kLightRectangle);
        lobe_alpha = alpha_widened_by_sphere(alpha, wide ? max(a.half_width_m, a.half_height_m) : a.radius_m,
                                             length(point));
    } else {
        vec3 mirror = reflect(-v, n);
        if (kAreaSpecular == kAreaSpecularDominantDirection || kAreaSpecular == kAreaSpecularDominantNormalized) mirror = specular_dominant_direction_area(n, mirror, alpha);
        point = area_highlight_point(group, kind, a, v, mirror, alpha, normalization);
    }
    l = direction_of(point);
    return normalization * specular_lobe(techniques(), n, v, l, lobe.perceptual_roughness, alpha, lobe_alpha);
}

// ltc_small_light_factor() with Fresnel in both lobes.
float fit_correction(uint group, int kind, AreaLight a, AreaLobe lobe, LtcFrame fit, vec3 v) {
    float distance_m = length(a.to_center_m);
    vec3 l = a.to_center_m / max(distance_m, 1.0e-20);
    float NoL = dot(lobe.n, l);
    float lobe_at_l = NoL * specular_lobe(techniques(), lobe.n, v, l, lobe.perceptual_roughness, lobe.alpha, lobe.alpha);
    vec3 fresnel = specular_fresnel(techniques(), lobe.f0, lobe.f90, saturate(dot(l, normalize(v + l))));
    float albedo = max(dot(lobe.albedo, vec3(1.0)), 1.0e-6);
    return ltc_small_light_factor(dot(fresnel, vec3(lobe_at_l)) / albedo, ltc_density(fit, lobe.n, l), lobe.alpha, NoL, l,
                                  reflect(-v, lobe.n), spreading_radius(group, kind, a) / max(distance_m, 1.0e-20));
}

vec3 area_highlight(uint group, int kind, Light light, SurfacePoint p, AreaLobe lobe, AreaLight a, float lx) {
    vec3 sum = vec3(0.0);
    // Of luminance 1 the disc gives pi sin^2 of its angular radius in lx on a plane that faces it.
    if (is_kind(kind, kLightSun) && kSunByLobe) return sun_specular(p, a.to_center_m) * (PI * square(a.radius_m));
    float as_point = 1.0;
    if (kAreaSpecular == kAreaSpecularLtc) {
        as_point = point_share(group, kind, a, lobe.alpha);
        // The lobe's albedo with Fresnel is in the table of the split sum (Hill & Heitz 2016, "LTC Fresnel Approximation", in
        // other words).
        LtcFrame fit = ltc_frame(lobe.ltc, lobe.n, p.v);
        sum = lobe.albedo * area_ltc(group, light, fit, a) * fit_correction(group, kind, a, lobe, fit, p.v);
        if (as_point <= 0.0) return sum;
    }
    vec3 l;
    float value = area_highlight_lobe(group, kind, a, lobe, p.v, l);
    float LoH = saturate(dot(l, normalize(p.v + l)));
    vec3 mean = kLightPictures && group == kPolygons ? read_picture(light, vec3(0.5, 0.5, 1.0)) : vec3(1.0);
    vec3 at_point = mean * specular_fresnel(techniques(), lobe.f0, lobe.f90, LoH) * (value * lx / highlight_nit(kind, a));
    return as_point < 1.0 ? mix(sum, at_point, as_point) : at_point;
}

// The highlight, per unit of AreaLight::nit. Returns the lx per such unit on the base. An anisotropic base has its highlight
// from area lights as an isotropic one of the same roughness. The coat is a second turn of a loop, so that the code is there
// once. A rectangle's picture is in it as LTC sees it; the other techniques take its mean.
float area_highlights(uint group, int kind, Light light, SurfacePoint p, AreaLight a, out vec3 specular) {
    AreaLobe lobe;
    lobe.perceptual_roughness = p.prepared.perceptual_roughness;
    lobe.ltc = p.area.ltc;
    lobe.n = p.g.normal;
    lobe.alpha = p.prepared.alpha;
    lobe.f0 = p.prepared.specular_f0 * p.area.under_layers;
    lobe.f90 = p.prepared.specular_f90 * p.area.under_layers;
    lobe.albedo = max(lobe.f0 * p.dfg.x + lobe.f90 * p.dfg.y, vec3(0.0));
    float base_lx = 0.0;
    specular = vec3(0.0);
    const int lobes = kShadeLayers ? 2 : 1;
    for (int i = 0; i < lobes; ++i) {
        float lx = area_illuminance(group, kind, lobe.n, a);
        specular += area_highlight(group, kind, light, p, lobe, a, lx);
        base_lx = i == 0 ? lx : base_lx;
        if (kShadeLayers) {
            lobe.ltc = p.area.coat_ltc;
            lobe.n = p.g.coat_normal;
            lobe.perceptual_roughness = p.g.surface.coat_perceptual_roughness;
            lobe.alpha = alpha_from_perceptual_roughness(p.g.surface.coat_perceptual_roughness);
            lobe.albedo = vec3(p.area.coat * p.area.coat_albedo);
            lobe.f0 = vec3(p.area.coat);
            lobe.f90 = vec3(p.area.coat);
        }
    }
    specular *= highlight_nit(kind, a);
    return base_lx;
}

#endif
