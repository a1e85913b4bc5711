#pragma once

#include <complex>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "candela/bake/equirect_light.hpp"

namespace candela::bake {

/// A real function on the sphere, red, green and blue, in orthonormal spherical harmonics about +Y of degrees
/// 0 to `degree`; azimuth as u of shading/environment.glsl. Orders m >= 0: the others are their conjugates.
class Harmonics {
  public:
    explicit Harmonics(std::uint32_t degree);

    [[nodiscard]] std::uint32_t degree() const noexcept { return degree_; }
    /// Six numbers, the real and the imaginary part of each channel.
    [[nodiscard]] double* at(std::uint32_t l, std::uint32_t m) noexcept { return data_.data() + place(l, m); }
    [[nodiscard]] const double* at(std::uint32_t l, std::uint32_t m) const noexcept {
        return data_.data() + place(l, m);
    }

  private:
    [[nodiscard]] std::size_t place(std::uint32_t l, std::uint32_t m) const noexcept {
        // Orders one after the other, each of degree_ + 1 - m degrees.
        return 6 * (std::size_t{m} * (2 * degree_ + 3 - m) / 2 + (l - m));
    }

    std::uint32_t degree_;
    std::vector<double> data_;
};

/// Weights of the centres of equidistant rows, from a pole to the equator, in an integral over the cosine of
/// the polar angle: exact for polynomials of degree below `rows` (Fejer's first rule).
[[nodiscard]] std::vector<double> polar_weights(std::uint32_t rows);

/// Of the bilinear reading of a map, without its peaks. Good where `degree` is well below the map's height.
[[nodiscard]] Harmonics analyze(const EquirectLight& light, std::uint32_t degree);

/// Values at the texel centres of an equirectangular grid, to be read between them: a function that is smooth
/// over a few of its texels.
class SmoothGrid {
  public:
    SmoothGrid(std::uint32_t width, std::uint32_t height);

    [[nodiscard]] std::uint32_t width() const noexcept { return width_; }
    [[nodiscard]] std::uint32_t height() const noexcept { return height_; }
    [[nodiscard]] glm::vec4* row(std::uint32_t y) noexcept {
        return data_.data() + (y + kMargin) * pitch_ + kMargin;
    }
    /// Once all rows are written: what lies beyond the seam and the poles.
    void fill_margins();
    /// By cubic polynomials; x from 0 to width, y from 0 to height, texel centres at halves.
    [[nodiscard]] glm::vec4 read(float x, float y) const noexcept;

  private:
    static constexpr std::uint32_t kMargin = 2;
    std::uint32_t width_;
    std::uint32_t height_;
    std::size_t pitch_;
    std::vector<glm::vec4> data_;
};

/// A function with its degrees scaled: those of `scale`, the others are left out. `width` even, the grid half
/// as high.
[[nodiscard]] SmoothGrid synthesize(const Harmonics& function, const std::vector<double>& scale,
                                    std::uint32_t width);

}  // namespace candela::bake
