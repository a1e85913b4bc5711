#include "candela/bake/harmonics.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "candela/bake/fourier.hpp"
#include "candela/bake/legendre.hpp"

namespace candela::bake {
namespace {

using Complex = std::complex<double>;

// The operator of std::complex looks for infinities.
Complex product(const Complex& a, const Complex& b) {
    return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

/// exp(i angle m) for each m.
std::vector<Complex> turns(std::uint32_t count, double angle) {
    std::vector<Complex> out(count);
    for (std::uint32_t m = 0; m < count; ++m) out[m] = std::polar(1.0, angle * double(m));
    return out;
}

/// Values of all orders on the rows of one half of the sphere: sum and difference with the mirrored row, real
/// and imaginary part of each channel.
class OrderRows {
  public:
    OrderRows(std::size_t orders, std::size_t rows) : rows_(rows), data_(orders * 12 * rows) {}
    [[nodiscard]] double* at(std::size_t m, std::size_t part, std::size_t c) noexcept {
        return data_.data() + ((m * 2 + part) * 6 + c) * rows_;
    }
    template <class Pointer>
    void pointers(std::size_t m, std::size_t part, Pointer (&out)[6]) noexcept {
        for (std::size_t c = 0; c < 6; ++c) out[c] = at(m, part, c);
    }

  private:
    std::size_t rows_;
    std::vector<double> data_;
};

/// A row as linear reading in v makes it wider: the second-order weights of a hat.
glm::dvec3 hat_across_rows(const EquirectLight& light, std::uint32_t x, std::uint32_t y) {
    const auto at = [&](std::uint32_t row) {
        return glm::dvec3(light.texels[std::size_t{row} * light.width + x]);
    };
    return (10.0 * at(y) + at(y == 0 ? 0 : y - 1) + at(std::min(y + 1, light.height - 1))) / 12.0;
}

/// Transform of linear reading in u.
double hat_transform(std::uint32_t m, std::uint32_t width) {
    const double x = M_PI * double(m) / double(width);
    return m == 0 ? 1.0 : std::pow(std::sin(x) / x, 2);
}

OrderRows transform_rows(const EquirectLight& light, std::uint32_t degree) {
    const std::size_t pairs = (light.height + 1) / 2;
    OrderRows orders(degree + 1, pairs);
    const Fourier fourier(light.width);
    const std::vector<double> weights = polar_weights(light.height);
    // Half a texel on: the first centre is there.
    std::vector<Complex> turn = turns(std::min(degree, light.width / 2) + 1, -M_PI / double(light.width));
    for (std::uint32_t m = 0; m < turn.size(); ++m)
        turn[m] *= M_PI / double(light.width) * hat_transform(m, light.width);
    tbb::parallel_for(std::size_t{0}, pairs, [&](std::size_t pair) {
        const auto upper = static_cast<std::uint32_t>(pair);
        const std::uint32_t lower = light.height - 1 - upper;
        std::array<std::vector<Complex>, 3> in;
        for (auto& channel : in) channel.resize(light.width);
        for (std::uint32_t x = 0; x < light.width; ++x) {
            const glm::dvec3 a = hat_across_rows(light, x, upper);
            const glm::dvec3 b = lower == upper ? glm::dvec3(0.0) : hat_across_rows(light, x, lower);
            // Two real transforms in one.
            for (int c = 0; c < 3; ++c) in[static_cast<std::size_t>(c)][x] = {a[c] + b[c], a[c] - b[c]};
        }
        std::vector<Complex> out(light.width);
        for (std::size_t c = 0; c < 3; ++c) {
            fourier.forward(in[c].data(), out.data());
            for (std::uint32_t m = 0; m < turn.size(); ++m) {
                const Complex p = out[m];
                const Complex q = std::conj(out[m == 0 ? 0 : light.width - m]);
                const Complex even = product(p + q, turn[m] * weights[pair]);
                const Complex odd =
                    product(Complex(p.imag() - q.imag(), q.real() - p.real()), turn[m] * weights[pair]);
                orders.at(m, 0, 2 * c)[pair] = even.real();
                orders.at(m, 0, 2 * c + 1)[pair] = even.imag();
                orders.at(m, 1, 2 * c)[pair] = odd.real();
                orders.at(m, 1, 2 * c + 1)[pair] = odd.imag();
            }
        }
    });
    return orders;
}

}  // namespace

std::vector<double> polar_weights(std::uint32_t rows) {
    std::vector<double> cosines(2 * std::size_t{rows});
    for (std::size_t i = 0; i < cosines.size(); ++i) cosines[i] = std::cos(M_PI * double(i) / double(rows));
    std::vector<double> weights((rows + 1) / 2);
    for (std::size_t r = 0; r < weights.size(); ++r) {
        double sum = 0.5;
        for (std::size_t k = 1; k <= rows / 2; ++k) {
            const double last = 2 * k == rows ? 0.0 : 1.0;  // its cosine is 0 at every centre
            sum -= last * cosines[k * (2 * r + 1) % cosines.size()] / (4.0 * double(k) * double(k) - 1.0);
        }
        weights[r] = 4.0 / double(rows) * sum;
    }
    return weights;
}

Harmonics::Harmonics(std::uint32_t degree)
    : degree_(degree), data_(6 * (std::size_t{degree} + 1) * (std::size_t{degree} + 2) / 2) {}

Harmonics analyze(const EquirectLight& light, std::uint32_t degree) {
    Harmonics function(degree);
    OrderRows orders = transform_rows(light, degree);
    const LegendreRows rows(light.height);
    tbb::parallel_for(0u, degree + 1, [&](std::uint32_t m) {
        const double* even[6];
        const double* odd[6];
        orders.pointers(m, 0, even);
        orders.pointers(m, 1, odd);
        sum_over_rows(rows, m, degree, even, odd, function.at(m, m));
    });
    return function;
}

SmoothGrid::SmoothGrid(std::uint32_t width, std::uint32_t height)
    : width_(width), height_(height), pitch_(width + 2 * kMargin), data_(pitch_ * (height + 2 * kMargin)) {}

void SmoothGrid::fill_margins() {
    for (std::uint32_t y = 0; y < height_; ++y) {
        glm::vec4* texels = row(y);
        for (std::uint32_t i = 0; i < kMargin; ++i) {
            texels[static_cast<std::ptrdiff_t>(i) - kMargin] = texels[width_ - kMargin + i];
            texels[width_ + i] = texels[i];
        }
    }
    // Over a pole the sphere goes on half a turn away.
    for (std::uint32_t i = 0; i < kMargin; ++i) {
        const glm::vec4* top = row(i);
        const glm::vec4* bottom = row(height_ - 1 - i);
        glm::vec4* above = data_.data() + (kMargin - 1 - i) * pitch_;
        glm::vec4* below = data_.data() + (kMargin + height_ + i) * pitch_;
        for (std::uint32_t x = 0; x < pitch_; ++x) {
            const std::uint32_t opposite = (x + 2 * width_ - kMargin + width_ / 2) % width_;
            above[x] = top[opposite];
            below[x] = bottom[opposite];
        }
    }
}

glm::vec4 SmoothGrid::read(float x, float y) const noexcept {
    // Lagrange's polynomial through the four nearest centres.
    const auto weights = [](float t, float(&w)[4]) {
        const float a = t + 1.0f;
        const float b = t - 1.0f;
        const float c = t - 2.0f;
        w[0] = t * b * c * (-1.0f / 6.0f);
        w[1] = a * b * c * 0.5f;
        w[2] = a * t * c * -0.5f;
        w[3] = a * t * b * (1.0f / 6.0f);
    };
    // Never negative before it is cut off.
    const float across = x + (static_cast<float>(kMargin) - 0.5f);
    const float down = y + (static_cast<float>(kMargin) - 0.5f);
    const auto left = static_cast<std::int32_t>(across);
    const auto top = static_cast<std::int32_t>(down);
    float wx[4];
    float wy[4];
    weights(across - static_cast<float>(left), wx);
    weights(down - static_cast<float>(top), wy);
    const glm::vec4* at =
        data_.data() + static_cast<std::size_t>(top - 1) * pitch_ + static_cast<std::size_t>(left - 1);
    glm::vec4 sum(0.0f);
    for (std::size_t j = 0; j < 4; ++j, at += pitch_)
        sum += wy[j] * (wx[0] * at[0] + wx[1] * at[1] + wx[2] * at[2] + wx[3] * at[3]);
    return sum;
}

SmoothGrid synthesize(const Harmonics& function, const std::vector<double>& scale, std::uint32_t width) {
    const auto degree = static_cast<std::uint32_t>(scale.size()) - 1;
    SmoothGrid grid(width, width / 2);
    const LegendreRows rows(grid.height());
    OrderRows orders(degree + 1, rows.size());
    tbb::parallel_for(0u, degree + 1, [&](std::uint32_t m) {
        double* even[6];
        double* odd[6];
        orders.pointers(m, 0, even);
        orders.pointers(m, 1, odd);
        sum_over_degrees(rows, m, degree, function.at(m, m), scale.data(), even, odd);
    });
    const Fourier fourier(width);
    const std::vector<Complex> turn = turns(degree + 1, M_PI / double(width));
    tbb::parallel_for(std::size_t{0}, rows.size(), [&](std::size_t pair) {
        std::vector<Complex> in(width);
        std::vector<Complex> out(width);
        glm::vec4* upper = grid.row(static_cast<std::uint32_t>(pair));
        glm::vec4* lower = grid.row(grid.height() - 1 - static_cast<std::uint32_t>(pair));
        for (std::size_t c = 0; c < 3; ++c) {
            std::fill(in.begin(), in.end(), Complex(0.0));
            for (std::uint32_t m = 0; m <= degree; ++m) {
                const Complex even =
                    product(turn[m], {orders.at(m, 0, 2 * c)[pair], orders.at(m, 0, 2 * c + 1)[pair]});
                const Complex odd =
                    product(turn[m], {orders.at(m, 1, 2 * c)[pair], orders.at(m, 1, 2 * c + 1)[pair]});
                // The transform runs with the other sign: conjugates in, conjugates out. Even rows are its
                // real part, odd ones its imaginary part.
                in[m] += Complex(even.real() - odd.imag(), -even.imag() - odd.real());
                if (m > 0) in[width - m] += Complex(even.real() + odd.imag(), even.imag() - odd.real());
            }
            fourier.forward(in.data(), out.data());
            for (std::uint32_t x = 0; x < width; ++x) {
                const double even = out[x].real();
                const double odd = -out[x].imag();
                upper[x][static_cast<int>(c)] = static_cast<float>(even + odd);
                lower[x][static_cast<int>(c)] = static_cast<float>(even - odd);
            }
        }
    });
    grid.fill_margins();
    return grid;
}

}  // namespace candela::bake
