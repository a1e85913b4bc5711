#include "candela/bake/lobe_measure.hpp"

#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>

#include "shading/sampling.glsl"

namespace candela::bake {
namespace {

constexpr std::size_t kOctaves = 9;
double width_rad(std::size_t octave) {
    return std::ldexp(1.0, -int(octave));
}

/// What a read sees of a bump: a table over octave, perceptual roughness and the angle between them.
class KernelTable {
  public:
    KernelTable() {
        tbb::parallel_for(std::size_t{0}, kRoughnesses, [this](std::size_t r) { fill(r); });
    }

    [[nodiscard]] double seen(std::size_t octave, double perceptual_roughness, double cosine) const {
        const double angle = std::acos(std::clamp(cosine, -1.0, 1.0));
        const double x = std::sqrt(angle / M_PI) * (kAngles - 1);
        const double y = std::clamp(perceptual_roughness, 0.0, 1.0) * (kRoughnesses - 1);
        const std::size_t i = std::min(std::size_t(x), kAngles - 2);
        const std::size_t j = std::min(std::size_t(y), kRoughnesses - 2);
        const double f = x - double(i);
        const double g = y - double(j);
        const auto row = [&](std::size_t at) {
            const auto& v = values_[at][octave];
            return v[i] * (1.0 - f) + v[i + 1] * f;
        };
        return row(j) * (1.0 - g) + row(j + 1) * g;
    }

  private:
    static constexpr std::size_t kRoughnesses = 33;
    static constexpr std::size_t kAngles = 161;
    static constexpr int kRings = 256;
    static constexpr int kAzimuths = 24;

    void fill(std::size_t r) {
        const double alpha =
            double(shading::alpha_from_perceptual_roughness(float(r) / float(kRoughnesses - 1)));
        // Rings of the kernel: half-vectors by the NDF, spaced towards the tail, weighted by n.l.
        std::vector<std::array<double, 2>> rings;
        double norm = 0.0;
        for (int i = 0; i < kRings; ++i) {
            const double at = (i + 0.5) / kRings;
            const double u = at * (2.0 - at);
            const double tangent2 = alpha * alpha * u / (1.0 - u);
            const double NoL = 2.0 / (1.0 + tangent2) - 1.0;
            if (NoL <= 0.0) continue;
            rings.push_back({NoL, (1.0 - at) * NoL});
            norm += rings.back()[1];
        }
        std::array<double, kAzimuths> azimuths{};
        for (int j = 0; j < kAzimuths; ++j) azimuths[std::size_t(j)] = std::cos(M_PI * (j + 0.5) / kAzimuths);
        for (std::size_t octave = 0; octave < kOctaves; ++octave) {
            const double sharpness = 1.0 / (width_rad(octave) * width_rad(octave));
            for (std::size_t i = 0; i < kAngles; ++i) {
                const double angle = M_PI * std::pow(double(i) / (kAngles - 1), 2);
                double sum = 0.0;
                for (const auto& [c, weight] : rings) {
                    const double across = std::sqrt(1.0 - c * c) * std::sin(angle);
                    double ring = 0.0;
                    for (const double a : azimuths)
                        ring += std::exp((c * std::cos(angle) + across * a - 1.0) * sharpness);
                    sum += weight * ring;
                }
                values_[r][octave][i] = sum / (norm * kAzimuths);
            }
        }
    }

    std::array<std::array<std::array<double, kAngles>, kOctaves>, kRoughnesses> values_{};
};

const KernelTable& kernels() {
    static const auto table = std::make_unique<KernelTable>();
    return *table;
}

struct LobeSamples {
    std::vector<LobeSample> points;  ///< of half an azimuth; their weights add up to 1
    double fresnel_share = 0.0;
};

LobeSamples lobe_samples(const glm::vec3& v, float alpha, float f0) {
    constexpr int side = 48;
    LobeSamples out;
    double sum = 0.0;
    double risen = 0.0;
    const float root_v = shading::smith_ggx_root(v.z, alpha);
    for (int i = 0; i < side; ++i) {
        for (int j = 0; j < side; ++j) {
            // Spaced towards the flank, where masking changes fastest (vndf_point).
            const double flank = (j + 0.5) / side;
            const glm::vec2 u(float(i + 0.5) / float(2 * side), float(flank * (2.0 - flank)));
            const glm::dvec3 h(shading::sample_ggx_vndf(u, v, alpha));
            const double VoH = glm::dot(glm::dvec3(v), h);
            const glm::dvec3 l = 2.0 * VoH * h - glm::dvec3(v);
            if (l.z <= 0.0 || VoH <= 0.0) continue;
            const double root_l = double(shading::smith_ggx_root(float(l.z), alpha));
            const double g2_over_g1 =
                l.z * double(v.z + root_v) / (l.z * double(root_v) + double(v.z) * root_l);
            const double rise = (1.0 - double(f0)) * std::pow(1.0 - VoH, 5);
            const double weight = g2_over_g1 * (1.0 - flank);
            out.points.push_back({l, weight * (double(f0) + rise)});
            sum += out.points.back().weight;
            risen += weight * std::pow(1.0 - VoH, 5);
        }
    }
    for (LobeSample& s : out.points) s.weight /= sum;
    // Of f0 dfg.x + dfg.y (integrate_ggx_albedo) the second.
    out.fresnel_share = risen / sum;
    return out;
}

double seen_by_lobe(const std::vector<LobeSample>& samples, LobeSide side, const glm::dvec3& centre,
                    double width) {
    const double sharpness = 1.0 / (width * width);
    double sum = 0.0;
    for (const LobeSample& s : samples) {
        const double in_plane = s.l.x * centre.x + s.l.z * centre.z - 1.0;
        const double across = s.l.y * centre.y;
        const double seen = std::exp((in_plane + across) * sharpness);
        sum += side == LobeSide::both ? s.weight * seen
                                      : 0.5 * s.weight * (seen + std::exp((in_plane - across) * sharpness));
    }
    return sum;
}

}  // namespace

LobeView sampled_lobe_view(const glm::vec3& v, const glm::dvec3& middle, double scale_rad,
                           const std::vector<LobeSample>& samples, LobeSide side) {
    LobeView view;
    view.v = v;
    const glm::dvec3 along(middle.z, 0.0, -middle.x);
    double squares = 0.0;
    for (std::size_t octave = 0; octave < kOctaves; ++octave) {
        const double width = width_rad(octave);
        // Finer than anything in the lobe.
        if (width < 0.2 * scale_rad) break;
        const double reach = std::max(6.0 * scale_rad, 3.0 * width);
        const int count = int(std::min(M_PI, std::max(3.0 * scale_rad, 2.0 * width)) / width) + 1;
        for (int i = -count; i <= count; ++i) {
            for (int j = side == LobeSide::one ? 0 : -count; j <= count; ++j) {
                const double angle = std::hypot(i, j) * width;
                if (angle > std::min(reach, 3.0)) continue;
                const double per_angle = angle > 0.0 ? std::sin(angle) / angle : 1.0;
                const glm::dvec3 centre = std::cos(angle) * middle +
                                          per_angle * width * (double(i) * along + glm::dvec3(0.0, j, 0.0));
                const bool twice = side == LobeSide::one && j > 0;
                LobeBump bump{octave, centre, per_angle * (twice ? 2.0 : 1.0), 0.0};
                bump.seen = seen_by_lobe(samples, side, centre, width);
                squares += bump.weight * bump.seen * bump.seen;
                view.bumps.push_back(bump);
            }
        }
    }
    view.norm = std::sqrt(squares);
    return view;
}

LobeView lobe_view(float NoV, float perceptual_roughness, float f0) {
    const glm::vec3 v(-std::sqrt((1.0f - NoV) * (1.0f + NoV)), 0.0f, NoV);
    const float alpha = shading::alpha_from_perceptual_roughness(perceptual_roughness);
    const LobeSamples samples = lobe_samples(v, alpha, f0);
    LobeView view = sampled_lobe_view(v, {-double(v.x), 0.0, double(NoV)},
                                      std::max(2.0 * double(alpha), 0.016), samples.points, LobeSide::one);
    view.perceptual_roughness = perceptual_roughness;
    view.fresnel_share = float(samples.fresnel_share);
    return view;
}

const std::vector<LobeView>& lobe_views() {
    static const std::vector<LobeView> views = [] {
        constexpr std::size_t angles = 16;
        constexpr std::size_t roughnesses = 10;
        constexpr std::array<float, 2> f0{1.0f, 0.04f};
        std::vector<LobeView> out(f0.size() * angles * roughnesses);
        tbb::parallel_for(std::size_t{0}, out.size(), [&](std::size_t i) {
            const float angle_rad = 0.5f * shading::PI * (float(i % angles) + 0.5f) / float(angles);
            out[i] = lobe_view(std::cos(angle_rad), float(i / angles % roughnesses + 1) / float(roughnesses),
                               f0[i / (angles * roughnesses)]);
        });
        return out;
    }();
    return views;
}

std::vector<double> lobe_differences(const LobeView& view, const std::vector<shading::LobeRead>& reads) {
    const KernelTable& table = kernels();
    std::vector<double> out;
    out.reserve(view.bumps.size());
    for (const LobeBump& bump : view.bumps) {
        double seen = 0.0;
        for (const shading::LobeRead& read : reads)
            seen += double(read.weight) * table.seen(bump.width, double(read.perceptual_roughness),
                                                     glm::dot(glm::dvec3(read.direction), bump.centre));
        out.push_back(std::sqrt(bump.weight) * (seen - bump.seen) / view.norm);
    }
    return out;
}

double lobe_distance(const LobeView& view, const std::vector<shading::LobeRead>& reads) {
    double sum = 0.0;
    for (const double d : lobe_differences(view, reads)) sum += d * d;
    return std::sqrt(sum);
}

}  // namespace candela::bake
