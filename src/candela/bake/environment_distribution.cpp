#include "candela/bake/environment_distribution.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

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

/// How the texels of an axis lie in its cells, of which there are no more than texels.
class Cells {
  public:
    Cells(int texels, int cells) : texels_(texels), cells_(cells) {}

    /// Adds a texel's weight to the cells that it overlaps, by the part of it that lies in each.
    template <class Add>
    void spread(int texel, double weight, const Add& add) const {
        const std::int64_t begin = std::int64_t{texel} * cells_;
        const std::int64_t end = begin + cells_;
        const std::int64_t first = begin / texels_;
        const std::int64_t edge = (first + 1) * texels_;
        if (end <= edge) {
            add(static_cast<std::size_t>(first), weight);
            return;
        }
        const double above = static_cast<double>(edge - begin) / cells_;
        add(static_cast<std::size_t>(first), above * weight);
        add(static_cast<std::size_t>(first + 1), (1.0 - above) * weight);
    }

  private:
    std::int64_t texels_;
    std::int64_t cells_;
};

/// The size of the table: that of the environment over the least whole number that makes it small enough.
EnvironmentDistribution empty_distribution(const scene::Environment& environment, std::size_t max_cells) {
    EnvironmentDistribution d;
    for (int texels = 1;; ++texels) {
        d.width = std::max(static_cast<int>(environment.width) / texels, 1);
        d.height = std::max(static_cast<int>(environment.height) / texels, 1);
        const std::size_t cells = static_cast<std::size_t>(d.width) * static_cast<std::size_t>(d.height);
        if (cells <= std::max(max_cells, std::size_t{1})) break;
    }
    d.row_cdf.resize(static_cast<std::size_t>(d.height) + 1);
    d.column_cdf.resize(static_cast<std::size_t>(d.height) * (static_cast<std::size_t>(d.width) + 1));
    return d;
}

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
    EnvironmentDistribution d = empty_distribution(environment, how.max_cells);
    const int texel_columns = static_cast<int>(environment.width);
    const int texel_rows = static_cast<int>(environment.height);
    const BilinearLuminance luminance(environment);
    const auto texel_sr = [&](int row) {
        return static_cast<double>(shading::equirect_texel_solid_angle(
            static_cast<unsigned>(row), environment.width, environment.height));
    };
    const auto sum_over_sphere = [&](const auto& weight) {
        double total = 0.0;
        for (int row = 0; row < texel_rows; ++row) {
            double of_row = 0.0;
            for (int column = 0; column < texel_columns; ++column) of_row += weight(column, row);
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

    // By rows of cells; a row of texels lies in two of them at most.
    const auto columns = static_cast<std::size_t>(d.width);
    const Cells across(texel_columns, d.width);
    const Cells down(texel_rows, d.height);
    std::vector<double> row_weights(static_cast<std::size_t>(d.height));
    std::vector<double> weights(columns);
    std::size_t row = 0;
    const auto finish_row = [&] {
        for (const double w : weights) row_weights[row] += w;
        accumulate(weights, d.column_cdf.data() + row * (columns + 1));
        ++row;
        std::fill(weights.begin(), weights.end(), 0.0);
    };
    for (int texel_row = 0; texel_row < texel_rows; ++texel_row) {
        down.spread(texel_row, texel_sr(texel_row), [&](std::size_t cell_row, double sr) {
            if (cell_row > row) finish_row();
            for (int column = 0; column < texel_columns; ++column) {
                const double w = (1.0 - share) * weight(column, texel_row) + share * floor_nit;
                across.spread(column, w * sr, [&](std::size_t cell, double part) { weights[cell] += part; });
            }
        });
    }
    finish_row();
    accumulate(row_weights, d.row_cdf.data());
    return d;
}

}  // namespace candela::bake
