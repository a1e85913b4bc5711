#pragma once

#include <cstdint>

#include "shading/bsdf.glsl"
#include "shading/sampling.glsl"
#include "shading/sequence.glsl"

namespace candela::shading {

/// Local view or light direction with z along the normal.
inline vec3 at_cosine(float cosine, float azimuth_rad = 0.0f) {
    const float sine = std::sqrt(std::fmax(1.0f - cosine * cosine, 0.0f));
    return {sine * std::cos(azimuth_rad), sine * std::sin(azimuth_rad), cosine};
}

/// Reproducible uniform numbers in [0,1).
class Uniform {
  public:
    explicit Uniform(uint seed) : state_(hash_uint(seed)) {}
    float operator()() {
        state_ = hash_combine(state_, ++count_);
        return unit_float(state_);
    }
    vec2 two() {
        const float x = (*this)();
        return {x, (*this)()};
    }
    vec3 hemisphere() { return sample_uniform_hemisphere(two()); }

  private:
    uint state_;
    uint count_ = 0;
};

/// Integral of f(l) NoL over the hemisphere by the balance heuristic over grids of points: one that follows
/// the cosine and one a GGX lobe of each width in `alphas` seen from v. f returns anything that can be added
/// and scaled.
template <class Result, class F>
Result integrate_hemisphere(const vec3& v, std::initializer_list<float> alphas, int side, F f) {
    const auto density = [&](const vec3& l) {
        const vec3 h = normalize(v + l);
        double sum = pdf_cosine_hemisphere(l.z);
        for (const float alpha : alphas) sum += pdf_reflected(pdf_ggx_vndf(v, h, alpha), dot(v, h));
        return sum;
    };
    Result total{};
    const auto add = [&](const vec3& l) {
        if (l.z <= 0.0f) return;
        total += f(l) * (double(l.z) / density(l));
    };
    for (int i = 0; i < side; ++i) {
        for (int j = 0; j < side; ++j) {
            const vec2 u((float(i) + 0.5f) / float(side), (float(j) + 0.5f) / float(side));
            add(sample_cosine_hemisphere(u));
            for (const float alpha : alphas) {
                const vec3 h = sample_ggx_vndf(u, v, alpha);
                add(2.0f * dot(v, h) * h - v);
            }
        }
    }
    return total * (1.0 / (double(side) * double(side)));
}

}  // namespace candela::shading
