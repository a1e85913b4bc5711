#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "candela/scene/scene.hpp"
#include "shading/environment.glsl"

/// The texels of an equirectangular picture as patches of the sphere.
namespace candela::scene::detail {

/// Of a texel of a row. The difference of the cosines as a product, which keeps the digits.
inline double texel_solid_angle_sr(const Environment& e, std::uint32_t row) {
    const double top = M_PI * row / e.height, bottom = M_PI * (row + 1.0) / e.height;
    return 2.0 * M_PI / e.width * 2.0 * std::sin(0.5 * (top + bottom)) * std::sin(0.5 * (bottom - top));
}

class PictureSphere {
  public:
    explicit PictureSphere(const Environment& e)
        : environment_(e), solid_angles_(e.height), luminances_(e.luminance_nit.size()) {
        for (std::uint32_t y = 0; y < e.height; ++y) solid_angles_[y] = texel_solid_angle_sr(e, y);
        for (std::size_t i = 0; i < luminances_.size(); ++i)
            luminances_[i] = e.scale * shading::luminance(e.luminance_nit[i]);
    }

    [[nodiscard]] std::uint32_t texels() const noexcept {
        return static_cast<std::uint32_t>(luminances_.size());
    }
    [[nodiscard]] float luminance(std::uint32_t texel) const { return luminances_[texel]; }
    [[nodiscard]] const std::vector<float>& luminances() const noexcept { return luminances_; }
    [[nodiscard]] double solid_angle(std::uint32_t texel) const {
        return solid_angles_[texel / environment_.width];
    }
    /// Of the picture, without its rotation.
    [[nodiscard]] glm::dvec3 direction(std::uint32_t texel) const {
        const double u = (texel % environment_.width + 0.5) / environment_.width;
        const double polar = M_PI * (texel / environment_.width + 0.5) / environment_.height;
        const double azimuth = 2.0 * M_PI * (u - 0.5);
        return {std::sin(polar) * std::sin(azimuth), std::cos(polar), -std::sin(polar) * std::cos(azimuth)};
    }
    /// Texels whose middle is within `angle` of a direction, row by row.
    template <class Visit>
    void visit_cap(const glm::dvec3& middle, double angle, Visit&& visit) const {
        const double polar = std::acos(std::clamp(middle.y, -1.0, 1.0));
        const auto row_of = [&](double p) {
            return std::clamp(p / M_PI * environment_.height, 0.0, environment_.height - 1.0);
        };
        const auto first = static_cast<std::uint32_t>(row_of(polar - angle)),
                   last = static_cast<std::uint32_t>(row_of(polar + angle));
        const double least = std::cos(angle);
        const double azimuth = std::atan2(middle.x, -middle.z);
        for (std::uint32_t y = first; y <= last; ++y) {
            const double p = M_PI * (y + 0.5) / environment_.height;
            // cos(distance) = cos p cos q + sin p sin q cos(difference of azimuths), solved for the azimuth.
            const double across = std::sin(p) * std::sin(polar);
            const double c = across > 1e-12 ? (least - std::cos(p) * std::cos(polar)) / across : -2.0;
            if (c > 1.0) continue;
            const double reach = c < -1.0 ? M_PI : std::acos(c);
            const double center = (azimuth / (2.0 * M_PI) + 0.5) * environment_.width - 0.5;
            const double span = reach / (2.0 * M_PI) * environment_.width;
            auto left = static_cast<std::int64_t>(std::ceil(center - span)),
                 right = static_cast<std::int64_t>(std::floor(center + span));
            const std::int64_t width = environment_.width;
            if (right - left >= width) left = 0, right = width - 1;
            for (std::int64_t x = left; x <= right; ++x)
                visit(static_cast<std::uint32_t>(std::int64_t{y} * width + ((x % width) + width) % width));
        }
    }
    [[nodiscard]] double texel_side_rad() const noexcept { return M_PI / environment_.height; }
    [[nodiscard]] const Environment& environment() const noexcept { return environment_; }

  private:
    const Environment& environment_;
    std::vector<double> solid_angles_;
    std::vector<float> luminances_;
};

}  // namespace candela::scene::detail
