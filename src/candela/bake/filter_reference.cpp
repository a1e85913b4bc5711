#include "candela/bake/filter_reference.hpp"

#include <algorithm>
#include <cmath>

#include "candela/bake/wide.hpp"
#include "shading/environment_filter.glsl"

namespace candela::bake {
namespace {

/// Parts of a texel one way, and parts of these near the direction.
constexpr std::size_t kParts = 2;
constexpr std::size_t kFineParts = 8;
/// Radius in texels of what is near.
constexpr float kNearTexels = 10.0f;

CANDELA_WIDE void weights(std::size_t count, const float* x, const float* y, const float* z,
                          const float* solid_angle, const glm::vec3& to, float alpha, float near,
                          float* out) {
    for (std::size_t i = 0; i < count; ++i) {
        const float s = shading::half_sine2({x[i], y[i], z[i]}, to);
        out[i] = s < near ? -1.0f : solid_angle[i] * shading::ld_weight(s, alpha);
    }
}

}  // namespace

FilterReference::FilterReference(const scene::Environment& environment)
    : environment_(environment), columns_(environment.width * kParts), rows_(environment.height * kParts) {
    for (std::vector<float>* part : {&x_, &y_, &z_, &solid_angle_, &r_, &g_, &b_})
        part->resize(columns_ * rows_);
    for (std::size_t row = 0; row < rows_; ++row) {
        const float v = (static_cast<float>(row) + 0.5f) / static_cast<float>(rows_);
        for (std::size_t column = 0; column < columns_; ++column) {
            const std::size_t i = row * columns_ + column;
            const float u = (static_cast<float>(column) + 0.5f) / static_cast<float>(columns_);
            const glm::vec3 d =
                shading::rotate_about_y(shading::equirect_direction({u, v}), environment.rotation_rad);
            const glm::vec3 light = read(u, v);
            x_[i] = d.x;
            y_[i] = d.y;
            z_[i] = d.z;
            solid_angle_[i] = shading::equirect_texel_solid_angle(static_cast<shading::uint>(row),
                                                                  static_cast<shading::uint>(columns_),
                                                                  static_cast<shading::uint>(rows_));
            r_[i] = light.x;
            g_[i] = light.y;
            b_[i] = light.z;
        }
    }
}

glm::vec3 FilterReference::read(float u, float v) const {
    const auto width = static_cast<int>(environment_.width);
    const auto height = static_cast<int>(environment_.height);
    const float x = u * static_cast<float>(width) - 0.5f;
    const float y = std::clamp(v * static_cast<float>(height) - 0.5f, 0.0f, static_cast<float>(height - 1));
    const int left = static_cast<int>(std::floor(x));
    const int top = static_cast<int>(y);
    const auto at = [&](int column, int row) {
        const int wrapped = (column + width) % width;
        return environment_
            .luminance_nit[static_cast<std::size_t>(std::min(row, height - 1) * width + wrapped)];
    };
    const float fx = x - static_cast<float>(left);
    const float fy = y - static_cast<float>(top);
    return environment_.scale * glm::mix(glm::mix(at(left, top), at(left + 1, top), fx),
                                         glm::mix(at(left, top + 1), at(left + 1, top + 1), fx), fy);
}

glm::dvec3 FilterReference::ld(const glm::vec3& direction, float alpha) const {
    const float radius = kNearTexels * shading::PI / static_cast<float>(environment_.height);
    const float near = 0.25f * radius * radius;
    Sum sum;
    for (std::size_t row = 0; row < rows_; ++row) add_coarse(direction, alpha, near, row, sum);
    return sum.light / sum.weight;
}

void FilterReference::add_coarse(const glm::vec3& direction, float alpha, float near, std::size_t row,
                                 Sum& sum) const {
    const std::size_t first = row * columns_;
    std::vector<float> w(columns_);
    weights(columns_, x_.data() + first, y_.data() + first, z_.data() + first, solid_angle_.data() + first,
            direction, alpha, near, w.data());
    for (std::size_t column = 0; column < columns_; ++column) {
        if (w[column] < 0.0f) {
            add_fine(direction, alpha, column, row, sum);
            continue;
        }
        const std::size_t i = first + column;
        const auto weight = static_cast<double>(w[column]);
        sum.light += weight * glm::dvec3(r_[i], g_[i], b_[i]);
        sum.weight += weight;
    }
}

void FilterReference::add_fine(const glm::vec3& direction, float alpha, std::size_t column, std::size_t row,
                               Sum& sum) const {
    for (std::size_t j = 0; j < kFineParts; ++j) {
        const auto fine_row = static_cast<shading::uint>(row * kFineParts + j);
        const auto fine_rows = static_cast<shading::uint>(rows_ * kFineParts);
        const auto fine_columns = static_cast<shading::uint>(columns_ * kFineParts);
        const float v = (static_cast<float>(fine_row) + 0.5f) / static_cast<float>(fine_rows);
        const float sr = shading::equirect_texel_solid_angle(fine_row, fine_columns, fine_rows);
        for (std::size_t i = 0; i < kFineParts; ++i) {
            const float u =
                (static_cast<float>(column * kFineParts + i) + 0.5f) / static_cast<float>(fine_columns);
            const glm::vec3 d =
                shading::rotate_about_y(shading::equirect_direction({u, v}), environment_.rotation_rad);
            const auto weight =
                static_cast<double>(sr * shading::ld_weight(shading::half_sine2(d, direction), alpha));
            sum.light += weight * glm::dvec3(read(u, v));
            sum.weight += weight;
        }
    }
}

}  // namespace candela::bake
