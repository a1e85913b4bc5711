#include "candela/truth/environment_light.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "shading/environment_sampling.glsl"

namespace candela::truth {
namespace {

/// The interval of a cumulative table that holds u, and where u lies within it.
struct Interval {
    int index = 0;
    float fraction = 0.0f;
};

Interval find(std::span<const float> cdf, float u) {
    const auto above = std::upper_bound(cdf.begin(), cdf.end() - 1, u);
    auto i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(above - cdf.begin(), 1) - 1);
    // Empty intervals are never meant: rounding may have put u on the edge of one.
    while (i > 0 && cdf[i + 1] <= cdf[i]) --i;
    const float width = cdf[i + 1] - cdf[i];
    const float fraction = width > 0.0f ? (u - cdf[i]) / width : 0.5f;
    return {static_cast<int>(i), std::clamp(fraction, 0.0f, 0.99999994f)};
}

}  // namespace

EnvironmentLight::EnvironmentLight(const scene::Environment& environment)
    : environment_(&environment),
      distribution_(bake::environment_distribution(environment, {.uniform = 0.0f, .compensated = true})),
      size_(static_cast<int>(environment.width), static_cast<int>(environment.height)),
      cells_(distribution_.width, distribution_.height) {
    lit_ = environment.scale > 0.0f &&
           std::any_of(environment.luminance_nit.begin(), environment.luminance_nit.end(),
                       [](const glm::vec3& t) { return t.x > 0.0f || t.y > 0.0f || t.z > 0.0f; });
}

EnvironmentLight::EnvironmentLight(float luminance_nit)
    : constant_nit_(luminance_nit), lit_(luminance_nit > 0.0f) {}

glm::vec3 EnvironmentLight::luminance_nit(const glm::vec3& direction) const {
    if (!environment_) return glm::vec3(constant_nit_);
    const shading::BilinearTexels t =
        shading::environment_bilinear(shading::rotate_about_y(direction, -environment_->rotation_rad), size_);
    const auto texel = [&](int x, int y) {
        return environment_->luminance_nit[static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.x) +
                                           static_cast<std::size_t>(x)];
    };
    const glm::vec3 upper = glm::mix(texel(t.low.x, t.low.y), texel(t.high.x, t.low.y), t.fraction.x);
    const glm::vec3 lower = glm::mix(texel(t.low.x, t.high.y), texel(t.high.x, t.high.y), t.fraction.x);
    return glm::mix(upper, lower, t.fraction.y) * environment_->scale;
}

float EnvironmentLight::cell_pdf(const glm::ivec2& cell) const {
    const auto row = static_cast<std::size_t>(cell.y);
    const float* columns =
        distribution_.column_cdf.data() + row * static_cast<std::size_t>(cells_.x + 1) + cell.x;
    const float share =
        (distribution_.row_cdf[row + 1] - distribution_.row_cdf[row]) * (columns[1] - columns[0]);
    return shading::environment_texel_pdf(share, cell.y, cells_);
}

DirectionSample EnvironmentLight::sample(const glm::vec2& u) const {
    DirectionSample out;
    if (!lit_) return out;
    if (!environment_) {
        const float z = 1.0f - 2.0f * u.x;
        const float sine = std::sqrt(std::max(1.0f - z * z, 0.0f));
        const float phi = shading::TWO_PI * u.y;
        return {{sine * std::cos(phi), z, sine * std::sin(phi)},
                glm::vec3(constant_nit_),
                1.0f / (4.0f * shading::PI)};
    }
    const Interval row = find(distribution_.row_cdf, u.y);
    const std::span<const float> columns(
        distribution_.column_cdf.data() +
            static_cast<std::size_t>(row.index) * static_cast<std::size_t>(cells_.x + 1),
        static_cast<std::size_t>(cells_.x + 1));
    const Interval column = find(columns, u.x);
    const glm::ivec2 cell(column.index, row.index);
    const glm::vec3 local =
        shading::environment_texel_direction(cell, {column.fraction, row.fraction}, cells_);
    out.direction = shading::rotate_about_y(local, environment_->rotation_rad);
    out.luminance_nit = luminance_nit(out.direction);
    out.pdf = cell_pdf(cell);
    return out;
}

float EnvironmentLight::pdf(const glm::vec3& direction) const {
    if (!lit_) return 0.0f;
    if (!environment_) return 1.0f / (4.0f * shading::PI);
    return cell_pdf(
        shading::environment_texel(shading::rotate_about_y(direction, -environment_->rotation_rad), cells_));
}

}  // namespace candela::truth
