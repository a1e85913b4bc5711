#include "candela/measure/split_sum.hpp"

#include <array>

#include "candela/measure/dfg_lookup.hpp"
#include "candela/measure/numerics.hpp"
#include "candela/measure/spheres.hpp"
#include "shading/basis.glsl"

namespace candela::measure {
namespace {

using namespace shading;

constexpr std::array<float, 5> kRoughness{0.1f, 0.3f, 0.5f, 0.7f, 0.9f};
constexpr uint kReferenceSamples = 2048;
constexpr uint kFilterSamples = 2048;
constexpr int kDiameter = 56;

/// A soft-edged patch of light: 1 within `inner` of its axis, 0 beyond `outer` (cosines).
float patch(const vec3& direction, const vec3& axis, float outer, float inner) {
    return smoothstep(outer, inner, dot(direction, axis));
}

/// The environment: dusk over a brown floor, a window, two lamps; peak 60 times the sky. 1 = display white.
vec3 environment(const vec3& d) {
    const float up = saturate(d.y);
    vec3 light = mix(vec3(0.55f, 0.42f, 0.32f), vec3(0.12f, 0.2f, 0.42f), sqrt(up));
    const float floor = smoothstep(0.02f, -0.06f, d.y);
    light = mix(light, vec3(0.13f, 0.09f, 0.06f), floor);
    light += vec3(5.0f, 5.6f, 6.5f) * patch(d, normalize(vec3(-0.7f, 0.5f, 0.5f)), 0.93f, 0.95f);
    light += vec3(24.0f, 17.0f, 9.0f) * patch(d, normalize(vec3(0.6f, 0.6f, 0.55f)), 0.990f, 0.994f);
    light += vec3(3.0f, 0.8f, 0.5f) * patch(d, normalize(vec3(0.3f, 0.15f, -0.9f)), 0.95f, 0.98f);
    return light;
}

struct Frame {
    vec3 t;
    vec3 b;
    vec3 n;
    explicit Frame(const vec3& normal) : t(0.0f), b(0.0f), n(normal) { orthonormal_basis(n, t, b); }
    [[nodiscard]] vec3 world(const vec3& local) const { return to_world(local, t, b, n); }
    [[nodiscard]] vec3 local(const vec3& w) const { return to_local(w, t, b, n); }
};

/// Reflected light, and what the first half of the samples alone gives, to estimate noise.
struct Reference {
    vec3 all{0.0f};
    vec3 half{0.0f};
};

Reference reference(const vec3& n, const vec3& v, float alpha, const vec3& f0, uint seed) {
    const Frame frame(n);
    const vec3 view = frame.local(v);
    const float k = k_image_based(alpha);
    Reference out;
    for (uint i = 0; i < kReferenceSamples; ++i) {
        const vec3 h = sample_ggx_vndf(sobol_owen(i, seed), view, alpha);
        const float VoH = dot(view, h);
        const vec3 l = 2.0f * VoH * h - view;
        if (l.z <= 0.0f) continue;
        const float pdf = pdf_reflected(pdf_ggx_vndf(view, h, alpha), VoH);
        const float lobe = D_GGX(vec3(0, 0, 1), h, alpha) * V_SchlickSmith(view.z, l.z, k) * l.z / pdf;
        const vec3 light = environment(frame.world(l)) * F_Schlick(f0, vec3(1.0f), VoH) * lobe;
        out.all += light;
        if (i < kReferenceSamples / 2) out.half += light;
    }
    out.all /= float(kReferenceSamples);
    out.half /= float(kReferenceSamples / 2);
    return out;
}

/// The first sum of equation 7 with light directions of the lobe around n seen from v. `weighted`: by n.l, as
/// the paper's PrefilterEnvMap has it; equation 7 is printed without.
vec3 first_sum(const vec3& n, const vec3& v, float alpha, uint seed, bool weighted) {
    const Frame frame(n);
    const vec3 view = frame.local(v);
    vec3 sum(0.0f);
    float weight = 0.0f;
    for (uint i = 0; i < kFilterSamples; ++i) {
        const vec3 h = sample_ggx_ndf(sobol_owen(i, seed), alpha);
        const vec3 l = 2.0f * dot(view, h) * h - view;
        if (l.z <= 0.0f) continue;
        const float share = weighted ? l.z : 1.0f;
        sum += environment(frame.world(l)) * share;
        weight += share;
    }
    return weight > 0.0f ? sum / weight : vec3(0.0f);
}

constexpr int kRows = 4;  ///< reference, equation 7 as printed, weighted by n.l, with n = v

struct Errors {
    std::array<double, kRows>
        mean{};  ///< of rows 1 to 3 against row 0, relative; [0]: noise of the reference
};

double luma(const vec3& c) {
    return double(luminance(c));
}

/// Values of a column, one vector a row, in the same order of pixels.
Errors errors_of(const std::array<std::vector<vec3>, kRows>& rows, const std::vector<vec3>& half) {
    Errors out;
    double scale = 0.0;
    for (std::size_t i = 0; i < rows[0].size(); ++i) {
        scale += luma(rows[0][i]);
        // Half of the samples differs from the whole by as much as the whole differs from the truth.
        out.mean[0] += std::abs(luma(half[i]) - luma(rows[0][i]));
        for (std::size_t row = 1; row < kRows; ++row)
            out.mean[row] += std::abs(luma(rows[row][i]) - luma(rows[0][i]));
    }
    for (double& m : out.mean) m /= scale;
    return out;
}

}  // namespace

Findings split_sum_figure(const SplitSumMaterial& material) {
    const DfgLookup table(DfgKind::ue4_schlick_smith);
    const vec3 v(0.0f, 0.0f, 1.0f);
    std::array<std::array<std::vector<vec3>, kRows>, kRoughness.size()> values;
    std::array<std::vector<vec3>, kRoughness.size()> halves;
    uint pixel = 0;
    const auto shade = [&](int row, int column, const vec3& n) {
        const float roughness = kRoughness[std::size_t(column)];
        const float alpha = alpha_from_perceptual_roughness(roughness);
        const uint seed = hash_uint(++pixel);
        vec3 value(0.0f);
        if (row == 0) {
            const Reference r = reference(n, v, alpha, material.f0, seed);
            halves[std::size_t(column)].push_back(r.half);
            value = r.all;
        } else {
            const vec2 ab = table.read(n.z, roughness);
            const vec3 mirror = reflect(-v, n);
            const vec3 light = row == 3 ? first_sum(mirror, mirror, alpha, seed, true)
                                        : first_sum(n, v, alpha, seed, row == 2);
            value = light * (material.f0 * ab.x + vec3(ab.y));
        }
        values[std::size_t(column)][std::size_t(row)].push_back(value);
        return value * material.display_scale;
    };
    Findings out;
    Panel picture = sphere_grid(kRows, int(kRoughness.size()), kDiameter, shade);
    picture.zoom = 2;
    picture.title = "Reference, split sum as printed, weighted by n.l, weighted with n = v";
    picture.caption = "Top to bottom; roughness 0.1, 0.3, 0.5, 0.7, 0.9 from left to right.";
    out.pictures = {picture};

    std::array<Series, kRows> series{Series{"noise of half the reference", {}, {}, Stroke::dotted},
                                     Series{"split sum as printed", {}, {}},
                                     Series{"weighted by n.l", {}, {}, Stroke::solid},
                                     Series{"weighted, with n = v", {}, {}, Stroke::dashed}};
    std::array<double, kRows> mean{};
    std::array<double, kRows> worst{};
    Table numbers{"Mean error in % of the mean of the reference",
                  {"roughness", "split sum as printed", "weighted by n.l", "weighted, with n = v",
                   "noise of half the reference"},
                  {}};
    for (std::size_t column = 0; column < kRoughness.size(); ++column) {
        const Errors e = errors_of(values[column], halves[column]);
        for (std::size_t row = 0; row < kRows; ++row) {
            series[row].x.push_back(double(kRoughness[column]));
            series[row].y.push_back(100.0 * e.mean[row]);
            mean[row] += 100.0 * e.mean[row] / double(kRoughness.size());
            worst[row] = std::max(worst[row], 100.0 * e.mean[row]);
        }
        numbers.rows.push_back({number(double(kRoughness[column])), fixed(100.0 * e.mean[1], 2),
                                fixed(100.0 * e.mean[2], 2), fixed(100.0 * e.mean[3], 2),
                                fixed(100.0 * e.mean[0], 2)});
    }
    out.plots = {{"Mean error over a sphere",
                  "",
                  {"perceptual roughness", 0.0, 1.0},
                  {"% of the mean of the reference"},
                  {series[1], series[2], series[3], series[0]}}};
    out.tables = {numbers};
    out.text =
        "Over the five spheres of " + material.name + " equation 7 as printed is off by " +
        number(mean[1], 2) + " % on average and weighted by n.l, as the paper's PrefilterEnvMap is, by " +
        number(mean[2], 2) + " %; the whole approximation, with n = v, by " + number(mean[3], 2) +
        " %: the assumption n = v is the larger source of error, as the paper says. " + material.weighting;
    out.measured = {
        at_most("split sum as printed, mean error over all spheres", mean[1],
                100.0 * material.bounds.printed_mean, "%"),
        at_most("split sum weighted by n.l, mean error over all spheres", mean[2],
                100.0 * material.bounds.weighted_mean, "%"),
        within("weighted by n.l over as printed", mean[2] / mean[1],
               material.bounds.weighted_over_printed - 0.05, material.bounds.weighted_over_printed + 0.05),
        at_most("split sum with n = v, mean error over all spheres", mean[3],
                100.0 * material.bounds.isotropic_mean, "%"),
        at_least("error with n = v over error of the split sum alone", mean[3] / std::max(mean[1], mean[2]),
                 1.0),
        at_most("noise of half the reference's samples, largest of a sphere", worst[0], 4.0, "%")};
    const std::string truth =
        material.name + " sphere, 2048 samples a pixel, roughness 0.1 to 0.9; largest: of one sphere";
    const auto cost = [](bool weighted, bool isotropic_lobe) {
        return [weighted, isotropic_lobe] {
            return cost_ns([weighted, isotropic_lobe](const vec4& u) {
                const vec3 n = sample_uniform_hemisphere(vec2(u.x, u.y));
                return first_sum(n, isotropic_lobe ? n : vec3(0, 0, 1), u.z, 1u, weighted).x;
            });
        };
    };
    const auto technique = [&](const std::string& name, const std::string& source, std::size_t row) {
        return Technique{name,      source,     "light times BRDF, integrated", truth, "%",
                         mean[row], worst[row], cost(row != 1, row == 3)};
    };
    out.techniques = {
        technique("split sum, " + material.name + " (2048 samples a direction)", "Karis 2013, equation 7", 1),
        technique("split sum weighted by n.l, " + material.name + " (2048 samples a direction)",
                  "Karis 2013, PrefilterEnvMap's weight", 2),
        technique("split sum with n = v, " + material.name + " (cost: filtering one direction)",
                  "Karis 2013, Pre-Filtered Environment Map", 3)};
    return out;
}

}  // namespace candela::measure
