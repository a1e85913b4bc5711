#include "candela/bake/environment_distribution.hpp"

#include <algorithm>
#include <cstddef>

#include "shading/environment.glsl"
#include "shading/language.glsl"

namespace candela::bake {
namespace {

/// Integral of the bilinear reconstruction over a texel: 6/8 of its own value and 1/8 of each neighbour's, in
/// both directions. Columns wrap around, rows end at the poles.
class BilinearLuminance {
  public:
    explicit BilinearLuminance(const scene::Environment& environment) : environment_(environment) {}

    [[nodiscard]] double at(int column, int row) const {
        const int last = static_cast<int>(environment_.height) - 1;
        return 0.125 * across(column, std::max(row - 1, 0)) + 0.75 * across(column, row) +
               0.125 * across(column, std::min(row + 1, last));
    }

  private:
    [[nodiscard]] double across(int column, int row) const {
        const int width = static_cast<int>(environment_.width);
        return 0.125 * texel((column + width - 1) % width, row) + 0.75 * texel(column, row) +
               0.125 * texel((column + 1) % width, row);
    }
    [[nodiscard]] double texel(int column, int row) const {
        const std::size_t i =
            static_cast<std::size_t>(row) * environment_.width + static_cast<std::size_t>(column);
        const float nit = shading::luminance(environment_.luminance_nit[i]);
        return nit > 0.0f ? static_cast<double>(nit) : 0.0;  // nor NaN
    }
    const scene::Environment& environment_;
};

/// Turns weights into a cumulative table of one more entry; uniform where there is no weight.
void accumulate(const std::vector<double>& weights, float* cdf) {
    double sum = 0.0;
    for (const double w : weights) sum += w;
    double running = 0.0;
    const auto count = static_cast<double>(weights.size());
    for (std::size_t i = 0; i < weights.size(); ++i) {
        cdf[i] = static_cast<float>(sum > 0.0 ? running / sum : static_cast<double>(i) / count);
        running += weights[i];
    }
    cdf[weights.size()] = 1.0f;
}

}  // namespace

EnvironmentDistribution environment_distribution(const scene::Environment& environment,
                                                 const EnvironmentWeights& how) {
    EnvironmentDistribution d;
    d.width = static_cast<int>(environment.width);
    d.height = static_cast<int>(environment.height);
    const auto columns = static_cast<std::size_t>(d.width);
    const auto rows = static_cast<std::size_t>(d.height);
    d.row_cdf.resize(rows + 1);
    d.column_cdf.resize(rows * (columns + 1));

    const BilinearLuminance luminance(environment);
    const auto texel_sr = [&](int row) {
        return static_cast<double>(shading::equirect_texel_solid_angle(
            static_cast<unsigned>(row), environment.width, environment.height));
    };
    const auto sum_over_sphere = [&](const auto& weight) {
        double total = 0.0;
        for (int row = 0; row < d.height; ++row) {
            double of_row = 0.0;
            for (int column = 0; column < d.width; ++column) of_row += weight(column, row);
            total += of_row * texel_sr(row);
        }
        return total;
    };
    const double sphere_sr = 4.0 * 3.14159265358979;
    const double mean_nit =
        sum_over_sphere([&](int column, int row) { return luminance.at(column, row); }) / sphere_sr;
    const double left_out_nit = how.compensated ? mean_nit : 0.0;
    const auto weight = [&](int column, int row) {
        return std::max(luminance.at(column, row) - left_out_nit, 0.0);
    };
    const double total = sum_over_sphere(weight);
    // Against rounding: where nothing stands out from the mean, nothing is left to draw by.
    const bool flat = !(total > 1e-6 * mean_nit * sphere_sr);
    const double floor_nit = flat ? 1.0 : total / sphere_sr;
    const double share = flat ? 1.0 : static_cast<double>(how.uniform);

    std::vector<double> row_weights(rows);
    std::vector<double> weights(columns);
    for (int row = 0; row < d.height; ++row) {
        const auto r = static_cast<std::size_t>(row);
        for (int column = 0; column < d.width; ++column) {
            weights[static_cast<std::size_t>(column)] =
                (1.0 - share) * weight(column, row) + share * floor_nit;
            row_weights[r] += weights[static_cast<std::size_t>(column)];
        }
        row_weights[r] *= texel_sr(row);
        accumulate(weights, d.column_cdf.data() + r * (columns + 1));
    }
    accumulate(row_weights, d.row_cdf.data());
    return d;
}

}  // namespace candela::bake
