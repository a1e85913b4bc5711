#include "candela/bake/ltc_fit.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec3.hpp>
#include <limits>
#include <mutex>
#include <vector>

#include "shading/lights/ltc.glsl"

namespace candela::bake {
namespace {

using shading::uint;

/// A direction of the quadrature, split at the mirror direction: for a smooth lobe only the difference has
/// digits.
struct Point {
    glm::dvec3 from_mirror;
    double density = 0.0;  ///< of the lobe, 1/sr
    double weight = 0.0;   ///< share of the lobe; they add up to 1
};

struct Lobe {
    double NoV = 1.0;
    double sine = 0.0;
    std::vector<Point> points;
};

constexpr uint kPointsASide = 48;

/// The lobe in points of about equal weight: visible normals of half an azimuth, spaced towards the flank
/// (vndf_point).
Lobe sample_lobe(float NoV, float perceptual_roughness) {
    const float alpha = shading::alpha_from_perceptual_roughness(perceptual_roughness);
    Lobe lobe;
    lobe.NoV = std::clamp(double(NoV), 1.0e-4, 1.0);
    lobe.sine = std::sqrt((1.0 - lobe.NoV) * (1.0 + lobe.NoV));
    const glm::dvec3 v(-lobe.sine, 0.0, lobe.NoV);
    const glm::vec3 n(0.0f, 0.0f, 1.0f);
    double sum = 0.0;
    for (uint i = 0; i < kPointsASide; ++i) {
        for (uint j = 0; j < kPointsASide; ++j) {
            const double flank = (double(j) + 0.5) / kPointsASide;
            const glm::vec2 u((float(i) + 0.5f) / (2.0f * kPointsASide), float(flank * (2.0 - flank)));
            const glm::dvec3 h(shading::sample_ggx_vndf(u, glm::vec3(v), alpha));
            const double VoH = glm::dot(v, h);
            const double NoL = 2.0 * VoH * h.z - lobe.NoV;
            if (NoL <= 0.0 || VoH <= 0.0) continue;
            const glm::vec3 normal(h);
            const double density = double(shading::D_GGX(n, normal, alpha)) *
                                   double(shading::V_SmithGGXCorrelated(float(lobe.NoV), float(NoL), alpha)) *
                                   NoL;
            const double pdf = double(
                shading::pdf_reflected(shading::pdf_ggx_vndf(glm::vec3(v), normal, alpha), float(VoH)));
            if (!(pdf > 0.0)) continue;
            // l - mirror = 2 (VoH h - NoV n), without the sum that would cancel.
            const glm::dvec3 away = 2.0 * glm::dvec3(VoH * h.x, VoH * h.y, VoH * h.z - lobe.NoV);
            lobe.points.push_back({away, density, density / pdf * (1.0 - flank)});
            sum += lobe.points.back().weight;
        }
    }
    double albedo = 0.0;
    for (const Point& p : lobe.points) albedo += p.weight;
    // sum over the square of (1 - flank) is half the number of points.
    albedo /= 0.5 * kPointsASide * kPointsASide;
    for (Point& p : lobe.points) {
        p.density /= albedo;
        p.weight /= sum;
    }
    return lobe;
}

/// ltc_frame's matrix in double precision, as acting on mirror + difference.
class Transform {
  public:
    Transform(const Lobe& lobe, const glm::dvec4& texel) {
        const double shift = texel.y * lobe.sine;
        row0_ = {texel.x * lobe.NoV + shift * lobe.sine, 0.0, shift * lobe.NoV - texel.x * lobe.sine};
        row2_ = {texel.w * lobe.sine, 0.0, texel.z};
        mirror_ = {shift, 0.0, texel.w * lobe.sine * lobe.sine + texel.z * lobe.NoV};
        determinant_ = row0_.x * row2_.z - row0_.z * row2_.x;
        const double cosine = row0_.x / std::hypot(row0_.x, row2_.x);
        scale_ = 2.0 / (shading::PI * (1.0 + cosine));
    }
    /// A mirrored or flat transform has no lobe.
    [[nodiscard]] bool valid() const { return determinant_ > 0.0 && row0_.x > 0.0; }

    [[nodiscard]] double density(const glm::dvec3& from_mirror) const {
        const glm::dvec3 p(mirror_.x + glm::dot(row0_, from_mirror), from_mirror.y,
                           mirror_.z + glm::dot(row2_, from_mirror));
        const double length2 = glm::dot(p, p);
        return p.z > 0.0 ? scale_ * p.z * determinant_ / (length2 * length2) : 0.0;
    }

  private:
    glm::dvec3 row0_{};
    glm::dvec3 row2_{};
    glm::dvec3 mirror_{};
    double determinant_ = 0.0;
    double scale_ = 0.0;
};

double error_of(const Lobe& lobe, const glm::dvec4& texel) {
    const Transform transform(lobe, texel);
    if (!transform.valid()) return std::numeric_limits<double>::infinity();
    double sum = 0.0;
    for (const Point& p : lobe.points)
        sum += p.weight * std::abs(1.0 - transform.density(p.from_mirror) / p.density);
    return 0.5 * sum;
}

/// Nelder & Mead 1965 in four dimensions, with their coefficients.
class Simplex {
  public:
    Simplex(const Lobe& lobe, const glm::dvec4& start, double step) : lobe_(lobe) {
        vertices_.fill({start, error_of(lobe, start)});
        for (int i = 0; i < 4; ++i) {
            glm::dvec4 at = start;
            at[i] += step * std::max(std::abs(start[i]), 0.1 * start.z);
            vertices_[std::size_t(i) + 1] = {at, error_of(lobe, at)};
        }
        sort();
    }

    void run(int most_steps, double tolerance) {
        for (int i = 0; i < most_steps && vertices_[4].error - vertices_[0].error > tolerance; ++i) step();
    }
    [[nodiscard]] const glm::dvec4& best() const { return vertices_[0].at; }
    [[nodiscard]] double best_error() const { return vertices_[0].error; }

  private:
    struct Vertex {
        glm::dvec4 at{};
        double error = 0.0;
    };

    void sort() {
        std::stable_sort(vertices_.begin(), vertices_.end(),
                         [](const Vertex& a, const Vertex& b) { return a.error < b.error; });
    }
    [[nodiscard]] Vertex towards(const glm::dvec4& centre, double factor) const {
        const glm::dvec4 at = centre + factor * (vertices_[4].at - centre);
        return {at, error_of(lobe_, at)};
    }
    void step() {
        glm::dvec4 centre(0.0);
        for (std::size_t i = 0; i < 4; ++i) centre += 0.25 * vertices_[i].at;
        const Vertex reflected = towards(centre, -1.0);
        if (reflected.error < vertices_[0].error) {
            const Vertex expanded = towards(centre, -2.0);
            vertices_[4] = expanded.error < reflected.error ? expanded : reflected;
        } else if (reflected.error < vertices_[3].error) {
            vertices_[4] = reflected;
        } else {
            const Vertex contracted = towards(centre, reflected.error < vertices_[4].error ? -0.5 : 0.5);
            if (contracted.error < std::min(reflected.error, vertices_[4].error)) {
                vertices_[4] = contracted;
            } else {
                for (std::size_t i = 1; i < vertices_.size(); ++i) {
                    vertices_[i].at = 0.5 * (vertices_[i].at + vertices_[0].at);
                    vertices_[i].error = error_of(lobe_, vertices_[i].at);
                }
            }
        }
        sort();
    }

    const Lobe& lobe_;
    std::array<Vertex, 5> vertices_;
};

}  // namespace

glm::vec4 rough_ltc_start(float NoV) {
    return {std::max(NoV, 0.02f), 1.0f, 1.2f, 0.02f};
}

glm::vec4 next_ltc_start(const glm::vec4& rougher, float perceptual_roughness,
                         float rougher_perceptual_roughness) {
    const float ratio = shading::alpha_from_perceptual_roughness(perceptual_roughness) /
                        shading::alpha_from_perceptual_roughness(rougher_perceptual_roughness);
    return {rougher.x, rougher.y * ratio, rougher.z * ratio, rougher.w * ratio};
}

LtcEntry fit_ltc_entry(float NoV, float perceptual_roughness, const glm::vec4& start) {
    const Lobe lobe = sample_lobe(NoV, perceptual_roughness);
    glm::dvec4 best(start);
    double error = error_of(lobe, best);
    // A simplex that has collapsed is opened again around what it found.
    for (const double step : {0.1, 0.05, 0.02}) {
        Simplex simplex(lobe, best, step);
        simplex.run(150, 1.0e-7);
        if (simplex.best_error() < error) {
            best = simplex.best();
            error = simplex.best_error();
        }
    }
    return {glm::vec4(best), float(error)};
}

float ltc_error(float NoV, float perceptual_roughness, const glm::vec4& texel) {
    return float(error_of(sample_lobe(NoV, perceptual_roughness), glm::dvec4(texel)));
}

LtcTable fit_ltc_table(const ProgressFunction& progress) {
    constexpr auto size = static_cast<uint>(shading::kLtcSize);
    LtcTable table;
    table.texels.resize(std::size_t{size} * size);
    table.errors.resize(table.texels.size());
    std::size_t done = 0;
    std::mutex mutex;
    tbb::parallel_for(0u, size, [&](uint x) {
        glm::vec4 start = rough_ltc_start(shading::dfg_parameters(x, size - 1).x);
        for (uint y = size; y-- > 0;) {
            const glm::vec2 at = shading::dfg_parameters(x, y);
            const LtcEntry entry = fit_ltc_entry(at.x, at.y, start);
            table.texels[std::size_t{y} * size + x] = entry.texel;
            table.errors[std::size_t{y} * size + x] = entry.error;
            if (progress) {
                const std::lock_guard lock(mutex);
                progress(double(++done) / double(table.errors.size()));
            }
            if (y > 0) start = next_ltc_start(entry.texel, shading::dfg_parameters(x, y - 1).y, at.y);
        }
    });
    // Seen at the normal the odd terms have no effect; as limits of their neighbours they are what
    // interpolation needs.
    for (uint y = 0; y < size; ++y) {
        glm::vec4* row = table.texels.data() + std::size_t{y} * size;
        row[size - 1].y = row[size - 2].y;
        row[size - 1].w = row[size - 2].w;
    }
    return table;
}

}  // namespace candela::bake
