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
        return static_cast<double>(shading::luminance(environment_.luminance_nit[i]));
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

EnvironmentDistribution environment_distribution(const scene::Environment& environment, float uniform) {
    EnvironmentDistribution d;
    d.width = static_cast<int>(environment.width);
    d.height = static_cast<int>(environment.height);
    const auto columns = static_cast<std::size_t>(d.width);
    const auto rows = static_cast<std::size_t>(d.height);
    d.row_cdf.resize(rows + 1);
    d.column_cdf.resize(rows * (columns + 1));

    const BilinearLuminance luminance(environment);
    double total = 0.0;
    for (int row = 0; row < d.height; ++row) {
        const double sr = static_cast<double>(shading::equirect_texel_solid_angle(
            static_cast<unsigned>(row), environment.width, environment.height));
        for (int column = 0; column < d.width; ++column) total += luminance.at(column, row) * sr;
    }
    // Mean luminance over the sphere, so that `uniform` is a share of the whole.
    const double floor_nit = total > 0.0 ? total / (4.0 * 3.14159265358979) : 1.0;
    const double share = total > 0.0 ? static_cast<double>(uniform) : 1.0;

    std::vector<double> row_weights(rows);
    std::vector<double> weights(columns);
    for (int row = 0; row < d.height; ++row) {
        const auto r = static_cast<std::size_t>(row);
        for (int column = 0; column < d.width; ++column) {
            weights[static_cast<std::size_t>(column)] =
                (1.0 - share) * luminance.at(column, row) + share * floor_nit;
            row_weights[r] += weights[static_cast<std::size_t>(column)];
        }
        row_weights[r] *= static_cast<double>(shading::equirect_texel_solid_angle(
            static_cast<unsigned>(row), environment.width, environment.height));
        accumulate(weights, d.column_cdf.data() + r * (columns + 1));
    }
    accumulate(row_weights, d.row_cdf.data());
    return d;
}

}  // namespace candela::bake
