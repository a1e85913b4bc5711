#include "candela/measure/numerics.hpp"
#include "shading/gaussian_specular.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;

/// The Gaussian of shading/gaussian_specular.glsl in double precision: near the normal 1 - cos loses a
/// float's digits.
double specular(double half_angle_rad, double power) {
    const double cos_edge = std::pow(0.04, 1.0 / power);
    const double x = (std::cos(half_angle_rad) - 1.0) / (cos_edge - 1.0);
    return std::exp(-x * x);
}

/// 1 over the integral of the Gaussian times the cosine over the hemisphere, light seen along the normal.
double normalization(double power) {
    return 1.0 / (2.0 * kPi *
                  integrate(
                      [&](double theta) {
                          return specular(0.5 * theta, power) * std::cos(theta) * std::sin(theta);
                      },
                      0.0, 0.5 * kPi, 128));
}

struct Fit {
    double scale = 0.0;
    double under_root = 0.0;
    double offset = 0.0;
    double squares = std::numeric_limits<double>::infinity();
    [[nodiscard]] double operator()(double power) const {
        return offset + scale * std::sqrt(power * power + under_root);
    }
};

/// Least squares of the relative error in scale and, if `with_offset`, offset, for this addend under the
/// root.
Fit fit_linear(const std::vector<double>& powers, const std::vector<double>& values, double under_root,
               bool with_offset) {
    double pp = 0.0;
    double qq = 0.0;
    double pq = 0.0;
    double p1 = 0.0;
    double q1 = 0.0;
    for (std::size_t i = 0; i < powers.size(); ++i) {
        const double p = std::sqrt(powers[i] * powers[i] + under_root) / values[i];
        const double q = 1.0 / values[i];
        pp += p * p;
        qq += q * q;
        pq += p * q;
        p1 += p;
        q1 += q;
    }
    Fit out;
    out.under_root = under_root;
    const double determinant = pp * qq - pq * pq;
    out.scale = with_offset ? (p1 * qq - q1 * pq) / determinant : p1 / pp;
    out.offset = with_offset ? (q1 * pp - p1 * pq) / determinant : 0.0;
    out.squares = 0.0;
    for (std::size_t i = 0; i < powers.size(); ++i)
        out.squares += std::pow(out(powers[i]) / values[i] - 1.0, 2.0);
    return out;
}

Fit fit_hyperbola(const std::vector<double>& powers, const std::vector<double>& values, bool with_offset) {
    Fit best;
    for (const double under_root : logspace(1.0, 10000.0, 4001)) {
        const Fit candidate = fit_linear(powers, values, under_root, with_offset);
        if (candidate.squares < best.squares) best = candidate;
    }
    return best;
}

template <class F>
ErrorStatistics errors(const std::vector<double>& powers, const std::vector<double>& values, F f,
                       double from = 0.0) {
    ErrorStatistics out;
    for (std::size_t i = 0; i < powers.size(); ++i) {
        if (powers[i] >= from) out.add(double(f(powers[i])) / values[i] - 1.0);
    }
    return out;
}

double line(double power) {
    return double(gaussian_specular_normalization_line(float(power)));
}
double hyperbola(double power) {
    return double(gaussian_specular_normalization_hyperbola(float(power)));
}

Findings run() {
    const auto powers = logspace(1.0, 512.0, 200);
    std::vector<double> values;
    for (const double n : powers) values.push_back(normalization(n));
    const Fit refit = fit_hyperbola(powers, values, true);
    const Fit no_offset = fit_hyperbola(powers, values, false);
    const Fit literal = fit_linear(powers, values, 1.0, false);
    const ErrorStatistics line_error = errors(powers, values, line);
    const ErrorStatistics line_error_16 = errors(powers, values, line, 16.0);
    const ErrorStatistics ours = errors(powers, values, hyperbola);
    Findings out;
    out.text = "Quadrature gives " + number(values.front()) + " at n = 1 and " + number(values.back()) +
               " at n = 512. The printed line is off by " + number(100.0 * line_error.mean(), 3) +
               " % on average over log n, by " + number(100.0 * line_error.max(), 3) +
               " % at n = 1 and by at most " + number(100.0 * line_error_16.max(), 2) +
               " % from n = 16 on. The hyperbola " + number(refit.offset, 6) + " + " +
               number(refit.scale, 7) + " sqrt(n^2 + " + number(refit.under_root, 5) + ") is within " +
               number(100.0 * ours.max(), 2) + " %. The comment's form, only scaled, reaches " +
               number(100.0 * errors(powers, values, no_offset).max(), 2) +
               " % with a free addend under the root; with its literal 1 it is worse than the line (" +
               number(100.0 * errors(powers, values, literal).max(), 2) + " %).";
    out.measured = {
        at_most("0.17287429 + 0.01388682 n: mean error", 100.0 * line_error.mean(), 14.0, "%"),
        within("0.17287429 + 0.01388682 n: largest error (at n = 1)", 100.0 * line_error.max(), 40.0, 43.0,
               "%"),
        at_most("0.17287429 + 0.01388682 n: largest error for n >= 16", 100.0 * line_error_16.max(), 7.0,
                "%"),
        at_most("hyperbola: mean error", 100.0 * ours.mean(), 0.25, "%"),
        at_most("hyperbola: largest error", 100.0 * ours.max(), 0.55, "%"),
        at_most("hyperbola of shading/ against a new fit, largest difference",
                100.0 * errors(powers, values,
                               [&](double n) { return hyperbola(n) / refit(n) * normalization(n); })
                            .max(),
                0.02, "%")};
    out.plots = {
        {"Normalization factor",
         "",
         {"Blinn-Phong power n", 1.0, 512.0, Scale::logarithmic},
         {"factor", 0.1, 10.0, Scale::logarithmic},
         {{"quadrature", powers, values},
          curve("0.17287429 + 0.01388682 n", powers, line, Stroke::dashed),
          curve("hyperbola", powers, hyperbola, Stroke::dotted)}},
        {"Relative error",
         "",
         {"Blinn-Phong power n", 1.0, 512.0, Scale::logarithmic},
         {"error, %"},
         {curve(
              "0.17287429 + 0.01388682 n", powers,
              [](double n) { return 100.0 * (line(n) / normalization(n) - 1.0); }, Stroke::dashed, 1),
          curve(
              "hyperbola", powers, [](double n) { return 100.0 * (hyperbola(n) / normalization(n) - 1.0); },
              Stroke::solid, 2),
          curve(
              "comment's form, free addend", powers,
              [&](double n) { return 100.0 * (no_offset(n) / normalization(n) - 1.0); }, Stroke::dotted,
              3)}}};
    const std::string truth = "1 / integral of the Gaussian times the cosine, n 1 to 512 in log n";
    out.techniques = {
        {"gaussian_specular_normalization_line", "Narkowicz, the post", "the Gaussian's normalization", truth,
         "%", 100.0 * line_error.mean(), 100.0 * line_error.max(),
         [] {
             return cost_ns([](const vec4& u) { return gaussian_specular_normalization_line(512.0f * u.x); });
         }},
        {"gaussian_specular_normalization_hyperbola", "Narkowicz, the comment; own fit",
         "the Gaussian's normalization", truth, "%", 100.0 * ours.mean(), 100.0 * ours.max(), [] {
             return cost_ns(
                 [](const vec4& u) { return gaussian_specular_normalization_hyperbola(512.0f * u.x); });
         }}};
    return out;
}

}  // namespace

Experiment narkowicz_normalization() {
    return {"Narkowicz", "Normalization", "The Gaussian highlight of Unreal Engine 4 \"Elemental\"",
            "Its normalization by quadrature over powers from 1 to 512, the printed straight line, and the "
            "hyperbola that a comment suggests.",
            run};
}

}  // namespace candela::measure::experiments
