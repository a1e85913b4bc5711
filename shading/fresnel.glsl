// Reflectance of a smooth surface.
#ifndef CANDELA_FRESNEL_GLSL
#define CANDELA_FRESNEL_GLSL

#include "language.glsl"

CANDELA_SHADING_BEGIN

// Schlick 1994 with the reflectance at grazing angle as a parameter: Frostbite section 3.1.2. u = VoH.
FN float F_Schlick(float f0, float f90, float u) {
    return f0 + (f90 - f0) * pow5(1.0f - u);
}
FN vec3 F_Schlick(vec3 f0, vec3 f90, float u) {
    return f0 + (f90 - f0) * pow5(1.0f - u);
}

// Weight that replaces Schlick's fifth power: Karis 2013, equation 5 (spherical Gaussian, after Lagarde
// 2012).
FN float spherical_gaussian_weight(float VoH) {
    return exp2((-5.55473f * VoH - 6.98316f) * VoH);
}
FN vec3 F_SphericalGaussian(vec3 f0, float VoH) {
    return f0 + (vec3(1.0f) - f0) * spherical_gaussian_weight(VoH);
}
// Changed from Karis: f90 is a parameter, so that a material's specular weight can go down to nothing.
FN vec3 F_SphericalGaussian(vec3 f0, vec3 f90, float VoH) {
    return f0 + (f90 - f0) * spherical_gaussian_weight(VoH);
}

// Unpolarized Fresnel of a boundary between dielectrics. cos_i in [0,1]; ior > 0 = transmitted side over
// incident side. 1 at total internal reflection. Born & Wolf, section 1.5.2.
FN float F_DielectricExact(float cos_i, float ior) {
    float sin2_t = (1.0f - cos_i) * (1.0f + cos_i) / (ior * ior);
    if (sin2_t >= 1.0f) return 1.0f;
    float cos_t = sqrt(1.0f - sin2_t);
    float parallel = (ior * cos_i - cos_t) / (ior * cos_i + cos_t);
    float perpendicular = (cos_i - ior * cos_t) / (cos_i + ior * cos_t);
    return 0.5f * (parallel * parallel + perpendicular * perpendicular);
}

// Unpolarized Fresnel of a conductor with complex index eta + i k, relative to the incident side. cos_i in
// [0,1]. Born & Wolf, section 14.2, solved for |a + i b|^2 = eta^2 - k^2 - sin^2 + 2 i eta k.
FN vec3 F_ConductorExact(float cos_i, vec3 eta, vec3 k) {
    float cos2 = cos_i * cos_i;
    float sin2 = 1.0f - cos2;
    vec3 real_part = eta * eta - k * k - vec3(sin2);
    vec3 modulus = sqrt(real_part * real_part + 4.0f * eta * eta * k * k);
    // Of a and b the larger one from the sum, the smaller from a b = eta k: the difference would cancel.
    vec3 larger = sqrt(max(0.5f * (modulus + abs(real_part)), vec3(1.0e-20f)));
    vec3 a = mix(eta * k / larger, larger, step(vec3(0.0f), real_part));
    vec3 a_twice = 2.0f * cos_i * a;
    vec3 s = modulus + vec3(cos2);
    vec3 perpendicular = (s - a_twice) / (s + a_twice);
    vec3 p = cos2 * modulus + vec3(sin2 * sin2);
    vec3 parallel = perpendicular * (p - a_twice * sin2) / (p + a_twice * sin2);
    return 0.5f * (perpendicular + parallel);
}

// No real material reflects less than 2 % head-on, so a smaller f0 means baked micro-occlusion and takes the
// grazing reflectance down with it: Frostbite section 4.10.3, listing 27 (Schueler).
FN float f90_from_f0(vec3 f0) {
    return saturate(50.0f * dot(f0, vec3(0.33f)));
}

// Normal-incidence reflectance against vacuum. ior >= 0; 0 gives 1, as KHR_materials_ior wants.
FN float f0_from_ior(float ior) {
    return square((ior - 1.0f) / (ior + 1.0f));
}

// Artists' reflectance in [0,1], 0.5 = 4 %: Frostbite section 3.2.1.
FN float f0_from_reflectance(float reflectance) {
    return 0.16f * reflectance * reflectance;
}

CANDELA_SHADING_END

#endif
