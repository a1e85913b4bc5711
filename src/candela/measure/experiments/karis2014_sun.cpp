#include "candela/measure/numerics.hpp"
#include "shading/dfg.glsl"
#include "shading/fresnel.glsl"
#include "shading/microfacet.glsl"
#include "shading/spherical_gaussian_lobe.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;

const vec3 kUp(0.0f, 0.0f, 1.0f);

struct Material {
    float roughness;
    float f0;
    [[nodiscard]] float alpha() const { return alpha_from_perceptual_roughness(roughness); }
};

/// cd/m^2 of a surface seen from v per lx on a plane that faces the sun.
double full(const Material& m, const vec3& v, const vec3& l) {
    if (l.z <= 0.0f) return 0.0;
    const vec3 h = normalize(v + l);
    return double(D_GGX(kUp, h, m.alpha()) * V_SchlickSmith(v.z, l.z, k_image_based(m.alpha())) *
                  F_Schlick(m.f0, 1.0f, dot(v, h)) * l.z);
}
/// D_Approx times EnvBRDFApprox with energy 1; printed: 4 times that.
double approximation(const Material& m, const vec3& v, const vec3& l) {
    const float lobe = sun_lobe_gaussian(m.alpha(), dot(reflect(-v, kUp), l), l.z);
    return double(std::max(EnvBRDFApprox(vec3(m.f0), m.roughness, v.z).x, 0.0f) * lobe);
}

/// Integral over all places of the sun, in polar coordinates about the mirror direction.
template <class F>
double over_suns(const vec3& v, F f) {
    const vec3 m = reflect(-v, kUp);
    const vec3 across(m.z, 0.0f, -m.x);
    const double end = std::cbrt(kPi);
    return 2.0 * integrate(
                     [&](double azimuth) {
                         return integrate(
                             [&](double s) {
                                 const double theta = s * s * s;
                                 const vec3 side = float(std::cos(azimuth)) * across +
                                                   float(std::sin(azimuth)) * vec3(0, 1, 0);
                                 return f(float(std::cos(theta)) * m + float(std::sin(theta)) * side) *
                                        std::sin(theta) * 3.0 * s * s;
                             },
                             0.0, end, 24);
                     },
                     0.0, kPi, 3);
}

struct Errors {
    ErrorStatistics misplaced;  ///< |approximation - truth| over all suns, over the truth
    double energy = 0.0;        ///< mean of approximation over truth
    int count = 0;
    void add(double error, double ratio) {
        misplaced.add(error);
        energy += ratio;
        ++count;
    }
};

Findings run() {
    Errors normalized;
    Errors printed;
    Errors with_cosine;
    Table table{"Energy and error of D_Approx / (4 pi) x EnvBRDFApprox, n.v 0.7",
                {"F0", "roughness", "energy", "error, %"},
                {}};
    for (const float f0 : {0.04f, 0.9f}) {
        for (const float roughness : {0.2f, 0.35f, 0.5f, 0.75f, 1.0f}) {
            const Material m{roughness, f0};
            for (const float NoV : {0.2f, 0.45f, 0.7f, 0.95f}) {
                const vec3 v(-std::sqrt(1.0f - NoV * NoV), 0.0f, NoV);
                const double truth = over_suns(v, [&](const vec3& l) { return full(m, v, l); });
                const auto compare = [&](Errors& e, auto f) {
                    e.add(over_suns(v, [&](const vec3& l) { return std::abs(f(l) - full(m, v, l)); }) / truth,
                          over_suns(v, f) / truth);
                };
                const auto lobe = [&](const vec3& l) { return approximation(m, v, l); };
                compare(normalized, lobe);
                compare(printed, [&](const vec3& l) { return double(kSunLobePrintedFactor) * lobe(l); });
                compare(with_cosine, [&](const vec3& l) { return double(std::max(l.z, 0.0f)) * lobe(l); });
                if (NoV == 0.7f) {
                    const double energy = over_suns(v, lobe) / truth;
                    const double error =
                        over_suns(v, [&](const vec3& l) { return std::abs(lobe(l) - full(m, v, l)); }) /
                        truth;
                    table.rows.push_back({number(double(f0)), number(double(roughness)), fixed(energy, 3),
                                          fixed(100.0 * error, 1)});
                }
            }
        }
    }
    const auto energy = [](const Errors& e) { return e.energy / e.count; };
    Findings out;
    out.text =
        "D_Approx in the sun's direction times EnvBRDFApprox, in place of the whole BRDF. With 1/pi alone, "
        "as printed, the "
        "reflected energy is " +
        number(energy(printed), 3) + " times that of the full model; with 1/(4 pi) it is " +
        number(energy(normalized), 3) + ", and " + number(100.0 * normalized.misplaced.mean(), 3) +
        " % of the light, summed over all places of the sun, is not where the full model has it. The article "
        "does not say "
        "whether n.l multiplies the product; with it the energy is " +
        number(energy(with_cosine), 3) + " and the error " + number(100.0 * with_cosine.misplaced.mean(), 3) +
        " %: the lobe stands for the light's integral as the prefilter's does, so it is left out.";
    out.measured = {
        within("energy over the full model's, 1/(4 pi)", energy(normalized), 0.73, 0.76),
        within("energy over the full model's, as printed", energy(printed), 2.94, 3.03),
        within("energy with n.l", energy(with_cosine), 0.4, 0.43),
        at_most("error, 1/(4 pi)", 100.0 * normalized.misplaced.mean(), 61.0, "%"),
        at_least("error, as printed, over that", printed.misplaced.mean() / normalized.misplaced.mean(), 3.5),
        at_least("error with n.l over that", with_cosine.misplaced.mean() / normalized.misplaced.mean(),
                 1.05)};
    out.tables = {table};
    const std::string truth =
        "D V F n.l with k = alpha / 2, summed over all places of the sun, relative; F0 0.04 and 0.9, "
        "roughness 0.2 to 1, n.v 0.2 to "
        "0.95; largest: of one of them";
    const auto cost = [] {
        return cost_ns([](const vec4& u) {
            return float(approximation({u.x, 0.04f}, normalize(vec3(u.y, 0.1f, u.z + 0.1f)),
                                       normalize(vec3(u.w, u.y, 1.0f))));
        });
    };
    out.techniques = {{"sun_lobe_gaussian x EnvBRDFApprox", "Karis 2014, Directional Light; factor 1/4 own",
                       "specular reflection of the sun", truth, "%", 100.0 * normalized.misplaced.mean(),
                       100.0 * normalized.misplaced.max(), cost},
                      {"D_Approx / pi x EnvBRDFApprox", "Karis 2014, Directional Light, as printed",
                       "specular reflection of the sun", truth, "%", 100.0 * printed.misplaced.mean(),
                       100.0 * printed.misplaced.max(), cost}};
    return out;
}

}  // namespace

Experiment karis2014_sun() {
    return {"Karis 2014", "Directional Light", "The sun by the lobe of prefiltered environments",
            "D_Approx x EnvBRDFApprox, with the printed factor and with the one that conserves energy, "
            "against the full "
            "model integrated over all places of the sun.",
            run};
}

}  // namespace candela::measure::experiments
