#include "candela/measure/numerics.hpp"
#include "shading/lights/representative_point.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;

const vec3 kUp(0.0f, 0.0f, 1.0f);

enum class Model : int { point, unnormalized, normalized, widened };

/// D V n.l of a sphere light whose centre is in this direction, at distance 1; F = 1.
double lobe(Model model, const vec3& v, const vec3& center, float alpha, float radius) {
    const vec3 mirror = reflect(-v, kUp);
    const vec3 point = model == Model::point || model == Model::widened
                           ? center
                           : representative_point_sphere(center, mirror, radius);
    const vec3 l = normalize(point);
    if (l.z <= 0.0f) return 0.0;
    const float width = model == Model::widened ? alpha_widened_by_sphere(alpha, radius, 1.0f) : alpha;
    const float factor =
        model == Model::normalized ? representative_point_sphere_normalization(alpha, radius, 1.0f) : 1.0f;
    return double(factor * D_GGX(kUp, normalize(v + l), width) * V_SmithGGXCorrelated(v.z, l.z, alpha)) *
           double(std::max(center.z, 0.0f));
}

/// Integral over all places of the light, in polar coordinates about the mirror direction that are as fine as
/// the lobe near it.
double energy(Model model, float view_deg, float alpha, float radius) {
    const float t = view_deg * float(kPi) / 180.0f;
    const vec3 v(-std::sin(t), 0.0f, std::cos(t));
    const vec3 m(std::sin(t), 0.0f, std::cos(t));
    const vec3 across(std::cos(t), 0.0f, -std::sin(t));
    return integrate(
        [&](double azimuth) {
            // The angle as a cube: its points crowd at the mirror direction, where narrow lobes are.
            const double end = std::cbrt(kPi);
            return integrate(
                [&](double s) {
                    const double theta = s * s * s;
                    const vec3 side =
                        float(std::cos(azimuth)) * across + float(std::sin(azimuth)) * vec3(0, 1, 0);
                    const vec3 c = float(std::cos(theta)) * m + float(std::sin(theta)) * side;
                    return lobe(model, v, c, alpha, radius) * std::sin(theta) * 3.0 * s * s;
                },
                0.0, end, 40);
        },
        0.0, 2.0 * kPi, 6);
}

struct Extremes {
    double low = 1e9;
    double high = 0.0;
    void add(double x) {
        low = std::min(low, x);
        high = std::max(high, x);
    }
};

constexpr std::array kAlphas{0.02f, 0.05f, 0.1f, 0.25f, 0.5f};
constexpr std::array kRadii{0.02f, 0.05f, 0.1f, 0.2f, 0.4f};
constexpr std::array kViews_deg{0.0f, 30.0f, 60.0f};

Findings run() {
    std::array<Extremes, 4> all;
    ErrorStatistics normalized;
    ErrorStatistics widened;
    Table table{"Energy over that of a point light, view along the normal",
                {"alpha", "radius / distance", "no normalization", "equation 14", "equation 10"},
                {}};
    for (const float alpha : kAlphas) {
        for (const float radius : kRadii) {
            for (const float view : kViews_deg) {
                const double point = energy(Model::point, view, alpha, radius);
                std::array<double, 4> e{};
                for (const Model m : {Model::unnormalized, Model::normalized, Model::widened}) {
                    e[std::size_t(m)] = energy(m, view, alpha, radius) / point;
                    all[std::size_t(m)].add(e[std::size_t(m)]);
                }
                normalized.add(e[2] - 1.0);
                widened.add(e[3] - 1.0);
                if (view == 0.0f)
                    table.rows.push_back({number(double(alpha)), number(double(radius)), fixed(e[1], 2),
                                          fixed(e[2], 3), fixed(e[3], 3)});
            }
        }
    }
    Findings out;
    out.text =
        "Equation 14 is not conservation: it takes back the peak's energy, not that of the lobe around it. "
        "Over alpha " +
        number(double(kAlphas.front())) + " to " + number(double(kAlphas.back())) + ", radii " +
        number(double(kRadii.front())) + " to " + number(double(kRadii.back())) +
        " of the distance and views to 60 degrees a sphere light reflects " + number(all[2].low, 3) + " to " +
        number(all[2].high, 3) +
        " of what a point light of the same illuminance does; without equation 14 up to " +
        number(all[1].high, 4) + ", and with equation 10, which the paper rejects for what it looks like, " +
        number(all[3].low, 3) + " to " + number(all[3].high, 3) + ".";
    out.measured = {within("equation 14, largest energy (1: conserved)", all[2].high, 3.6, 3.9),
                    within("equation 14, smallest", all[2].low, 0.72, 0.76),
                    within("no normalization, largest", all[1].high, 210.0, 230.0),
                    within("equation 10, largest", all[3].high, 0.99, 1.01),
                    within("equation 10, smallest", all[3].low, 0.84, 0.87)};
    const auto x = logspace(0.005, 0.5, 24);
    Plot plot{"Energy of a sphere light's reflection over a point light's, view along the normal",
              "Solid: equation 14. Dashed: equation 10.",
              {"radius / distance", 0.005, 0.5, Scale::logarithmic},
              {"energy", 0.0, 0.0},
              {}};
    int color = 0;
    for (const float alpha : {0.02f, 0.1f, 0.5f}) {
        const auto ratio = [alpha](Model m) {
            return [alpha, m](double r) {
                return energy(m, 0.0f, alpha, float(r)) / energy(Model::point, 0.0f, alpha, float(r));
            };
        };
        plot.series.push_back(
            curve("alpha " + number(double(alpha)), x, ratio(Model::normalized), Stroke::solid, color));
        plot.series.push_back(curve("", x, ratio(Model::widened), Stroke::dashed, color));
        ++color;
    }
    out.plots = {plot};
    out.tables = {table};
    const std::string truth =
        "energy of a point light's reflection = 1; alpha 0.02 to 0.5, radius / distance 0.02 to 0.4";
    out.techniques = {
        {"representative_point_sphere_normalization", "Karis 2013, equation 14",
         "energy of a sphere light's reflection", truth, "", normalized.mean(), normalized.max(),
         [] {
             return cost_ns(
                 [](const vec4& u) { return representative_point_sphere_normalization(u.x, u.y, u.z); });
         }},
        {"alpha_widened_by_sphere", "Karis 2013, equation 10", "energy of a sphere light's reflection", truth,
         "", widened.mean(), widened.max(),
         [] { return cost_ns([](const vec4& u) { return alpha_widened_by_sphere(u.x, u.y, u.z); }); }}};
    return out;
}

}  // namespace

Experiment karis2013_equation14() {
    return {"Karis 2013", "Equations 10, 11 and 14", "Energy of the representative point",
            "What a sphere light of each size reflects in all, its places integrated over the hemisphere, "
            "over what a "
            "point light reflects.",
            run};
}

}  // namespace candela::measure::experiments
