#include "candela/measure/dfg_lookup.hpp"

#include <algorithm>

#include "candela/measure/numerics.hpp"

namespace candela::measure {

using namespace shading;

DfgLookup::DfgLookup(DfgKind kind) {
    for (uint y = 0; y < uint(kDfgSize); ++y) {
        for (uint x = 0; x < uint(kDfgSize); ++x) {
            const vec2 at = dfg_parameters(x, y);
            texels_.push_back(kind == DfgKind::smith_correlated
                                  ? integrate_ggx_albedo(at.x, at.y, kDfgSamples)
                                  : integrate_ggx_albedo_ue4(at.x, at.y, kDfgSamples));
        }
    }
}

vec2 DfgLookup::read(float NoV, float perceptual_roughness) const {
    const vec2 at = dfg_uv(NoV, perceptual_roughness) * float(kDfgSize) - vec2(0.5f);
    const int x = std::clamp(int(at.x), 0, kDfgSize - 2);
    const int y = std::clamp(int(at.y), 0, kDfgSize - 2);
    const vec2 f = at - vec2(float(x), float(y));
    const auto texel = [&](int dx, int dy) {
        return texels_[std::size_t(y + dy) * std::size_t(kDfgSize) + std::size_t(x + dx)];
    };
    return mix(mix(texel(0, 0), texel(1, 0), f.x), mix(texel(0, 1), texel(1, 1), f.x), f.y);
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
