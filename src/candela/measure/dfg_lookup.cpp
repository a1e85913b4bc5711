#include "candela/measure/dfg_lookup.hpp"

#include "candela/measure/numerics.hpp"

namespace candela::measure {

using namespace shading;

DfgLookup::DfgLookup(DfgKind kind) : table_(kind == DfgKind::ue4_schlick_smith) {}

vec2 DfgLookup::read(float NoV, float perceptual_roughness) const {
    return vec2(table_.read(NoV, perceptual_roughness));
}

glm::dvec4 dfg_truth(float NoV, float perceptual_roughness, std::uint32_t samples) {
    const float alpha = alpha_from_perceptual_roughness(perceptual_roughness);
    const float k = k_image_based(alpha);
    const vec3 n(0.0f, 0.0f, 1.0f);
    const vec3 v = at_cosine(NoV);
    glm::dvec4 sum(0.0);
    for (std::uint32_t i = 0; i < samples; ++i) {
        const vec3 h = sample_ggx_vndf(centred_hammersley(i, samples), v, alpha);
        const float VoH = dot(v, h);
        const vec3 l = 2.0f * VoH * h - v;
        if (l.z <= 0.0f) continue;
        const float pdf = pdf_reflected(pdf_ggx_vndf(v, h, alpha), VoH);
        const float lobe = D_GGX(n, h, alpha) * l.z / pdf;
        const double correlated = double(lobe * V_SmithGGXCorrelated(v.z, l.z, alpha));
        const double ue4 = double(lobe * V_SchlickSmith(v.z, l.z, k));
        const double fresnel = double(pow5(1.0f - VoH));
        sum += glm::dvec4((1.0 - fresnel) * correlated, fresnel * correlated, (1.0 - fresnel) * ue4,
                          fresnel * ue4);
    }
    return sum / double(samples);
}

}  // namespace candela::measure
