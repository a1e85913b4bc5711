// Diffuse reflection, for albedo 1; in 1/sr.
#ifndef CANDELA_DIFFUSE_GLSL
#define CANDELA_DIFFUSE_GLSL

#include "fresnel.glsl"

CANDELA_SHADING_BEGIN

FN float Fd_Lambert() {
    return INV_PI;
}

// Burley 2012, section 5.3. At grazing angles it reflects more than it receives (Frostbite Figure 9a).
FN float Fd_Disney(float NoV, float NoL, float LoH, float perceptual_roughness) {
    float f90 = 0.5f + 2.0f * perceptual_roughness * LoH * LoH;
    return F_Schlick(1.0f, f90, NoL) * F_Schlick(1.0f, f90, NoV) * INV_PI;
}

// Frostbite section 3.1.3, listing 1: bias and factor bring the albedo to at most about 1.
FN float Fd_DisneyRenormalized(float NoV, float NoL, float LoH, float perceptual_roughness) {
    float f90 = 0.5f * perceptual_roughness + 2.0f * perceptual_roughness * LoH * LoH;
    float factor = mix(1.0f, 1.0f / 1.51f, perceptual_roughness);
    return factor * F_Schlick(1.0f, f90, NoL) * F_Schlick(1.0f, f90, NoV) * INV_PI;
}

// Closed form of the directional albedo of (1 + c b(NoL)) (1 + c b(NoV)) / pi with b(x) = (1 - x)^5 and
// c = offset + slope l.v, which both models above are, as 2 LoH^2 = 1 + l.v. Own derivation: the azimuth
// averages l.v to NoL NoV and its square to NoL^2 NoV^2 + (1 - NoL^2)(1 - NoV^2) / 2; what is left are the
// moments 2 x^(k+1) b(x) over [0,1], k = 0, 1, 2: 1/21, 1/84, 1/252.
FN float disney_albedo_integral(float NoV, float offset, float slope) {
    float m0 = 1.0f / 21.0f;
    float m1 = 1.0f / 84.0f;
    float m2 = 1.0f / 252.0f;
    float b = pow5(1.0f - NoV);
    float c = offset + slope * NoV * (2.0f / 3.0f);
    float c_b = offset * m0 + slope * NoV * m1;
    float NoV2 = NoV * NoV;
    float c2_b = offset * offset * m0 + 2.0f * offset * slope * NoV * m1 +
                 slope * slope * (NoV2 * m2 + 0.5f * (1.0f - NoV2) * (m0 - m2));
    return 1.0f + b * c + c_b + b * c2_b;
}

// Directional albedo of Fd_Disney for albedo 1.
FN float albedo_Disney(float NoV, float perceptual_roughness) {
    return disney_albedo_integral(NoV, perceptual_roughness - 0.5f, perceptual_roughness);
}

// Directional albedo of Fd_DisneyRenormalized for albedo 1.
FN float albedo_DisneyRenormalized(float NoV, float perceptual_roughness) {
    float factor = mix(1.0f, 1.0f / 1.51f, perceptual_roughness);
    return factor * disney_albedo_integral(NoV, 1.5f * perceptual_roughness - 1.0f, perceptual_roughness);
}

CANDELA_SHADING_END

#endif
