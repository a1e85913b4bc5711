#include "candela/bake/lobe_fit.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "candela/bake/least_squares.hpp"
#include "candela/bake/lobe_measure.hpp"

namespace candela::bake {
namespace {

constexpr std::size_t kTerms = 12;
std::array<double, kTerms> terms_of(const LobeView& view) {
    const shading::LobeBasis b = shading::lobe_basis(
        view.v.z, view.perceptual_roughness,
        shading::alpha_from_perceptual_roughness(view.perceptual_roughness), view.fresnel_share);
    return {double(b.low.x),     double(b.low.y),     double(b.low.z),     double(b.low.w),
            double(b.high.x),    double(b.high.y),    double(b.high.z),    double(b.high.w),
            double(b.fresnel.x), double(b.fresnel.y), double(b.fresnel.z), double(b.fresnel.w)};
}

/// Values of the polynomials at one view.
using Values = std::vector<double>;

Values values_of(const LobeCoefficients& coefficients, const std::array<double, kTerms>& terms) {
    Values out;
    for (const auto& row : coefficients) {
        double sum = 0.0;
        for (std::size_t i = 0; i < kTerms; ++i) sum += row[i] * terms[i];
        out.push_back(sum);
    }
    return out;
}

std::vector<shading::LobeRead> reads_of(const LobeView& view, const Values& values) {
    const std::size_t count = (values.size() + 1) / 3;
    const float alpha = shading::alpha_from_perceptual_roughness(view.perceptual_roughness);
    double sum = 1.0;
    for (std::size_t i = 2 * count; i < values.size(); ++i) sum += std::exp(values[i]);
    std::vector<shading::LobeRead> out;
    for (std::size_t i = 0; i < count; ++i) {
        const double weight = (i + 1 < count ? std::exp(values[2 * count + i]) : 1.0) / sum;
        out.push_back(shading::lobe_read(glm::vec3(0.0f, 0.0f, 1.0f), view.v, view.v.z,
                                         view.perceptual_roughness, alpha, float(values[2 * i]),
                                         float(values[2 * i + 1]), float(weight)));
    }
    return out;
}

/// Pulls widths back from where lobe_read clamps them and weights from 0, so that the method does not lose
/// its slope there. Value and slope of half the square.
struct Restraint {
    double weight = 0.0;
    double excess = 0.0;
    double slope = 0.0;
};
Restraint restraint(const LobeView& view, std::size_t count, std::size_t k, double value) {
    if (k >= 2 * count) return {1.0e-5, value, 1.0};
    if (k % 2 == 0) return {};
    const double r = double(view.perceptual_roughness);
    if (value < 0.0) return {1.0e-2, value, 1.0};
    if (value * r > 1.0) return {1.0e-4, value * r - 1.0, r};
    return {};
}

/// What one view adds, over unknowns k * kTerms + term; the derivatives are by the values, those by the
/// coefficients follow from the terms.
NormalEquations normal_of(const LobeView& view, const LobeCoefficients& coefficients, bool with_matrix) {
    const std::array<double, kTerms> terms = terms_of(view);
    const Values values = values_of(coefficients, terms);
    const std::size_t count = (values.size() + 1) / 3;
    const std::vector<double> at = lobe_differences(view, reads_of(view, values));
    NormalEquations out;
    for (const double d : at) out.error += d * d;
    for (std::size_t k = 0; k < values.size(); ++k) {
        const Restraint r = restraint(view, count, k, values[k]);
        out.error += r.weight * r.excess * r.excess;
    }
    if (!with_matrix) return out;
    constexpr double step = 2.0e-3;
    std::vector<std::vector<double>> slopes;
    for (std::size_t k = 0; k < values.size(); ++k) {
        Values up = values;
        Values down = values;
        up[k] += step;
        down[k] -= step;
        std::vector<double> slope = lobe_differences(view, reads_of(view, up));
        const std::vector<double> below = lobe_differences(view, reads_of(view, down));
        for (std::size_t i = 0; i < slope.size(); ++i) slope[i] = (slope[i] - below[i]) / (2.0 * step);
        slopes.push_back(std::move(slope));
    }
    const std::size_t n = values.size() * kTerms;
    out.gradient.assign(n, 0.0);
    out.matrix.assign(n * n, 0.0);
    const auto product = [](const std::vector<double>& a, const std::vector<double>& b) {
        double sum = 0.0;
        for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
        return sum;
    };
    for (std::size_t k = 0; k < values.size(); ++k) {
        const Restraint r = restraint(view, count, k, values[k]);
        const double gradient = product(slopes[k], at) + r.weight * r.excess * r.slope;
        for (std::size_t i = 0; i < kTerms; ++i) out.gradient[k * kTerms + i] += gradient * terms[i];
        for (std::size_t l = 0; l < values.size(); ++l) {
            const double curvature =
                product(slopes[k], slopes[l]) + (k == l ? r.weight * r.slope * r.slope : 0.0);
            for (std::size_t i = 0; i < kTerms; ++i)
                for (std::size_t j = 0; j < kTerms; ++j)
                    out.matrix[(k * kTerms + i) * n + l * kTerms + j] += curvature * terms[i] * terms[j];
        }
    }
    return out;
}

NormalEquations sum_over_views(const LobeCoefficients& coefficients, bool with_matrix) {
    const std::vector<LobeView>& views = lobe_views();
    std::vector<NormalEquations> parts(views.size());
    tbb::parallel_for(std::size_t{0}, views.size(),
                      [&](std::size_t i) { parts[i] = normal_of(views[i], coefficients, with_matrix); });
    NormalEquations out = std::move(parts.front());
    for (std::size_t i = 1; i < parts.size(); ++i) out += parts[i];
    return out;
}

LobeCoefficients coefficients_of(const std::vector<double>& unknowns) {
    LobeCoefficients out(unknowns.size() / kTerms);
    for (std::size_t k = 0; k < unknowns.size(); ++k) out[k / kTerms][k % kTerms] = unknowns[k];
    return out;
}

std::vector<double> unknowns_of(const LobeCoefficients& coefficients) {
    std::vector<double> out;
    for (const auto& row : coefficients) out.insert(out.end(), row.begin(), row.end());
    return out;
}

/// Reads side by side along the lobe, which leans towards the normal as masking sets in.
LobeCoefficients start(int reads) {
    LobeCoefficients out(std::size_t(3 * reads - 1), std::array<double, kTerms>{});
    for (int i = 0; i < reads; ++i) {
        const double along = reads == 1 ? 0.0 : 1.6 * i / (reads - 1) - 0.8;
        out[std::size_t(2 * i)] = {-1.0 + along, 1.0};
        out[std::size_t(2 * i + 1)] = {1.1 - 0.15 * reads};
    }
    return out;
}

}  // namespace

LobeFit fit_lobe_reads(int reads) {
    LobeFit fit;
    fit.coefficients = coefficients_of(
        least_squares(unknowns_of(start(reads)), [](const std::vector<double>& unknowns, bool with_matrix) {
            return sum_over_views(coefficients_of(unknowns), with_matrix);
        }));
    ErrorOfViews errors;
    for (const LobeView& view : lobe_views())
        errors.add(lobe_distance(view, reads_of(view, values_of(fit.coefficients, terms_of(view)))));
    fit.errors = errors.result();
    return fit;
}

std::vector<shading::LobeRead> committed_lobe_reads(int count, const glm::vec3& n, const glm::vec3& v,
                                                    float NoV, float perceptual_roughness,
                                                    float fresnel_share) {
    std::vector<shading::LobeRead> out(static_cast<std::size_t>(count));
    if (count == 1) out[0] = shading::fitted_reflection(n, v, NoV, perceptual_roughness, fresnel_share);
    if (count == 2)
        shading::stretched_reflection_2(n, v, NoV, perceptual_roughness, fresnel_share, out[0], out[1]);
    if (count == 3)
        shading::stretched_reflection_3(n, v, NoV, perceptual_roughness, fresnel_share, out[0], out[1],
                                        out[2]);
    return out;
}

LobeErrors committed_lobe_errors(int reads) {
    return lobe_errors(
        [reads](const glm::vec3& n, const glm::vec3& v, float perceptual_roughness, float share) {
            return committed_lobe_reads(reads, n, v, v.z, perceptual_roughness, share);
        });
}

LobeErrors lobe_errors(const LobeReads& reads) {
    ErrorOfViews errors;
    for (const LobeView& view : lobe_views())
        errors.add(lobe_distance(
            view, reads(glm::vec3(0.0f, 0.0f, 1.0f), view.v, view.perceptual_roughness, view.fresnel_share)));
    return errors.result();
}

double lobe_error(const LobeReads& reads, float NoV, float perceptual_roughness, float f0) {
    const LobeView view = lobe_view(NoV, perceptual_roughness, f0);
    return lobe_distance(
        view, reads(glm::vec3(0.0f, 0.0f, 1.0f), view.v, perceptual_roughness, view.fresnel_share));
}

}  // namespace candela::bake
