#include <benchmark/benchmark.h>

#include <array>

#include "shading/bsdf.glsl"
#include "shading/sampling.glsl"
#include "shading/sequence.glsl"
#include "shading/tone_curves.glsl"

namespace candela::shading {
namespace {

/// One point to be shaded. A power of two of them, so that no branch predictor learns the one input by heart.
struct Case {
    Surface surface;
    vec3 v;
    vec3 l;
    vec2 u;
    float NoH = 0.0f;
    float LoH = 0.0f;
    float alpha = 0.0f;
};

constexpr std::size_t kCases = 1024;

std::array<Case, kCases> make_cases() {
    std::array<Case, kCases> cases{};
    for (uint i = 0; i < kCases; ++i) {
        const auto pair = [i](uint dimension) { return sobol_owen_pair(i, dimension, 1u); };
        Case& c = cases[i];
        c.v = sample_uniform_hemisphere(pair(0));
        c.l = sample_uniform_hemisphere(pair(1));
        c.u = pair(2);
        const vec3 h = normalize(c.v + c.l);
        c.NoH = h.z;
        c.LoH = dot(c.l, h);
        Surface& s = c.surface;
        s.base_color = vec3(pair(3).x, pair(3).y, pair(4).x);
        s.metallic = pair(4).y;
        s.perceptual_roughness = 0.045f + 0.955f * pair(5).x;
        s.dielectric_f0 = vec3(0.04f);
        s.dielectric_f90 = vec3(1.0f);
        c.alpha = alpha_from_perceptual_roughness(s.perceptual_roughness);
    }
    return cases;
}

/// Times `work` on one case after the other.
template <class Work>
void over_cases(benchmark::State& state, Work work) {
    static const auto cases = make_cases();
    std::size_t i = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(work(cases[i]));
        i = (i + 1) % kCases;
    }
}

void distribution(benchmark::State& state) {
    over_cases(state, [](const Case& c) { return D_GGX(c.NoH, c.alpha); });
}
BENCHMARK(distribution)->Name("D_GGX");

void V_correlated(benchmark::State& state) {
    over_cases(state, [](const Case& c) { return V_SmithGGXCorrelated(c.v.z, c.l.z, c.alpha); });
}
BENCHMARK(V_correlated)->Name("V_SmithGGXCorrelated");

void V_schlick(benchmark::State& state) {
    over_cases(state, [](const Case& c) {
        return V_SchlickSmith(c.v.z, c.l.z, k_analytic(c.surface.perceptual_roughness));
    });
}
BENCHMARK(V_schlick)->Name("V_SchlickSmith");

void fresnel_schlick(benchmark::State& state) {
    over_cases(state, [](const Case& c) { return F_Schlick(c.surface.base_color, vec3(1.0f), c.LoH); });
}
BENCHMARK(fresnel_schlick)->Name("F_Schlick");

void fresnel_gaussian(benchmark::State& state) {
    over_cases(state, [](const Case& c) { return F_SphericalGaussian(c.surface.base_color, c.LoH); });
}
BENCHMARK(fresnel_gaussian)->Name("F_SphericalGaussian");

const vec4 kDfg(0.6f, 0.2f, 1.0f, 0.0f);  // of a middling roughness; its values do not change the time

void standard(benchmark::State& state, BsdfTechniques techniques) {
    over_cases(state, [&](const Case& c) {
        return evaluate_standard(c.surface, techniques, c.v.z, c.l.z, c.NoH, c.LoH, kDfg);
    });
}
BENCHMARK_CAPTURE(standard, best, techniques_best())->Name("evaluate_standard/best");
BENCHMARK_CAPTURE(standard, frostbite, techniques_frostbite())->Name("evaluate_standard/frostbite");
BENCHMARK_CAPTURE(standard, ue4, techniques_ue4())->Name("evaluate_standard/ue4");

/// `layers`: 0 none, 1 clear coat, 2 also sheen and anisotropy.
void layered(benchmark::State& state) {
    const vec3 n(0.0f, 0.0f, 1.0f);
    over_cases(state, [&](const Case& c) {
        Surface s = c.surface;
        s.coat_perceptual_roughness = 0.1f;
        s.sheen_perceptual_roughness = 0.5f;
        if (state.range(0) >= 1) s.coat = 1.0f;
        if (state.range(0) >= 2) {
            s.sheen_color = vec3(0.3f);
            s.anisotropy = 0.5f;
        }
        return evaluate_layered(s, techniques_best(), n, vec3(1, 0, 0), vec3(0, 1, 0), n, c.v, c.l, kDfg);
    });
}
BENCHMARK(layered)->Name("evaluate_layered")->ArgName("layers")->DenseRange(0, 2);

void visible_normal(benchmark::State& state) {
    over_cases(state, [](const Case& c) { return sample_ggx_vndf(c.u, c.v, c.alpha); });
}
BENCHMARK(visible_normal)->Name("sample_ggx_vndf");

void visible_normal_density(benchmark::State& state) {
    over_cases(state, [](const Case& c) { return pdf_ggx_vndf(c.v, normalize(c.v + c.l), c.alpha); });
}
BENCHMARK(visible_normal_density)->Name("pdf_ggx_vndf");

void sobol(benchmark::State& state) {
    uint i = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(sobol_owen_pair(i, i & 7u, 1u));
        ++i;
    }
}
BENCHMARK(sobol)->Name("sobol_owen_pair");

void tone(benchmark::State& state, int kind) {
    over_cases(state, [kind](const Case& c) { return tone_curve(kind, c.surface.base_color * 4.0f); });
}
BENCHMARK_CAPTURE(tone, none, kToneNone)->Name("tone_curve/none");
BENCHMARK_CAPTURE(tone, aces, kToneAces)->Name("tone_curve/aces");
BENCHMARK_CAPTURE(tone, agx, kToneAgx)->Name("tone_curve/agx");
BENCHMARK_CAPTURE(tone, neutral, kToneNeutral)->Name("tone_curve/neutral");

}  // namespace
}  // namespace candela::shading
