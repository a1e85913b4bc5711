#include "candela/bake/layer_fit.hpp"

#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <functional>

#include "candela/bake/least_squares.hpp"
#include "candela/bake/lobe_measure.hpp"
#include "shading/layer_reflection.glsl"
#include "shading/sampling.glsl"
#include "shading/sheen.glsl"

namespace candela::bake {
namespace {

using shading::LobeRead;

const glm::vec3 kNormal(0.0f, 0.0f, 1.0f);

glm::vec3 view_at(float NoV) {
    return {-std::sqrt((1.0f - NoV) * (1.0f + NoV)), 0.0f, NoV};
}

glm::dvec3 mirror_of(const glm::vec3& v) {
    return {-double(v.x), 0.0, double(v.z)};
}

void normalize_weights(std::vector<LobeSample>& samples) {
    double sum = 0.0;
    for (const LobeSample& s : samples) sum += s.weight;
    for (LobeSample& s : samples) s.weight /= sum;
}

/// A view of a layer and the reads that unknowns give it.
struct LayerView {
    LobeView view;
    std::function<std::vector<LobeRead>(const std::vector<double>& unknowns)> reads;
};

NormalEquations squares_of(const LayerView& at, const std::vector<double>& unknowns, bool with_matrix) {
    NormalEquations out;
    const std::vector<double> differences = lobe_differences(at.view, at.reads(unknowns));
    for (const double d : differences) out.error += d * d;
    if (!with_matrix) return out;
    constexpr double step = 2.0e-3;
    const std::size_t n = unknowns.size();
    std::vector<std::vector<double>> slopes;
    for (std::size_t k = 0; k < n; ++k) {
        std::vector<double> up = unknowns;
        std::vector<double> down = unknowns;
        up[k] += step;
        down[k] -= step;
        std::vector<double> slope = lobe_differences(at.view, at.reads(up));
        const std::vector<double> below = lobe_differences(at.view, at.reads(down));
        for (std::size_t i = 0; i < slope.size(); ++i) slope[i] = (slope[i] - below[i]) / (2.0 * step);
        slopes.push_back(std::move(slope));
    }
    out.gradient.assign(n, 0.0);
    out.matrix.assign(n * n, 0.0);
    for (std::size_t i = 0; i < differences.size(); ++i) {
        for (std::size_t k = 0; k < n; ++k) {
            out.gradient[k] += slopes[k][i] * differences[i];
            for (std::size_t l = 0; l < n; ++l) out.matrix[k * n + l] += slopes[k][i] * slopes[l][i];
        }
    }
    return out;
}

template <class Reads>
LobeErrors errors_of(const std::vector<LayerView>& views, const Reads& reads) {
    ErrorOfViews errors;
    for (const LayerView& v : views) errors.add(lobe_distance(v.view, reads(v)));
    return errors.result();
}

void fit(const std::vector<LayerView>& views, const std::vector<double>& start, LayerFit& out) {
    const std::vector<double> found =
        least_squares(start, [&](const std::vector<double>& unknowns, bool with_matrix) {
            std::vector<NormalEquations> parts(views.size());
            tbb::parallel_for(std::size_t{0}, views.size(),
                              [&](std::size_t i) { parts[i] = squares_of(views[i], unknowns, with_matrix); });
            NormalEquations sum = std::move(parts.front());
            for (std::size_t i = 1; i < parts.size(); ++i) sum += parts[i];
            return sum;
        });
    std::vector<double> committed;
    for (std::size_t i = 0; i < found.size(); ++i) {
        committed.push_back(out.constants[i].committed);
        out.constants[i].found = found[i];
    }
    out.committed = errors_of(views, [&](const LayerView& v) { return v.reads(committed); });
    out.found = errors_of(views, [&](const LayerView& v) { return v.reads(found); });
}

/// Draws visible normals, on all sides: a grain that is turned has no symmetry.
LobeView anisotropic_view(float NoV, const glm::vec2& alpha, float azimuth_rad) {
    constexpr int side = 64;
    const glm::vec3 v = view_at(NoV);
    const glm::vec3 t(std::cos(azimuth_rad), std::sin(azimuth_rad), 0.0f);
    const glm::vec3 b(-t.y, t.x, 0.0f);
    const glm::vec3 local_v(glm::dot(t, v), glm::dot(b, v), NoV);
    std::vector<LobeSample> samples;
    for (int i = 0; i < side; ++i) {
        for (int j = 0; j < side; ++j) {
            const double flank = (j + 0.5) / side;
            const glm::vec2 u(float(i + 0.5) / float(side), float(flank * (2.0 - flank)));
            const glm::vec3 h = shading::sample_ggx_vndf(u, local_v, alpha);
            const glm::vec3 l = 2.0f * glm::dot(local_v, h) * h - local_v;
            if (l.z <= 0.0f) continue;
            const float root_v = glm::length(glm::vec3(alpha * glm::vec2(local_v), NoV));
            const float root_l = glm::length(glm::vec3(alpha * glm::vec2(l), l.z));
            const float g2_over_g1 = l.z * (NoV + root_v) / (l.z * root_v + NoV * root_l);
            samples.push_back(
                {glm::dvec3(l.x * t + l.y * b + l.z * kNormal), double(g2_over_g1) * (1.0 - flank)});
        }
    }
    normalize_weights(samples);
    const double scale_rad = 2.0 * double(std::sqrt(alpha.x * alpha.y));
    return sampled_lobe_view(v, mirror_of(v), scale_rad, samples, LobeSide::both);
}

/// Spaced towards the horizon and in azimuth as integrate_sheen_albedo has it.
LobeView sheen_view(float NoV, float sheen_perceptual_roughness) {
    constexpr int side = 48;
    const glm::vec3 v = view_at(NoV);
    std::vector<LobeSample> samples;
    for (int i = 0; i < side; ++i) {
        for (int j = 0; j < side; ++j) {
            const float x = (float(i) + 0.5f) / float(side);
            const float y = (float(j) + 0.5f) / float(side);
            const float NoL = x * x;
            const float sine = std::sqrt(1.0f - NoL * NoL);
            const float phi = shading::PI * y * y * (3.0f - 2.0f * y);
            const glm::vec3 l(sine * std::cos(phi), sine * std::sin(phi), NoL);
            const float value =
                shading::evaluate_sheen(NoV, NoL, glm::normalize(v + l).z, sheen_perceptual_roughness);
            samples.push_back({glm::dvec3(l), double(value * NoL * x * y * (1.0f - y))});
        }
    }
    normalize_weights(samples);
    return sampled_lobe_view(v, mirror_of(v), 1.0, samples, LobeSide::one);
}

}  // namespace

LayerFit fit_anisotropic_reads() {
    LayerFit out{
        "anisotropic metal, five reads",
        "perceptual roughness 0.2, 0.4, 0.6, strength 0.3, 0.6, 0.9, n.v 0.25, 0.6, 0.95, grain turned by "
        "0.4 and 1.2 rad",
        {{"widening", double(shading::kAnisotropicWidening), 0.0},
         {"place of the inner reads", double(shading::kAnisotropicPlaces.x), 0.0},
         {"place of the outer reads", double(shading::kAnisotropicPlaces.y), 0.0},
         {"share of the inner reads", double(shading::kAnisotropicShares.x), 0.0},
         {"share of the outer reads", double(shading::kAnisotropicShares.y), 0.0}},
        {},
        {},
        {}};
    struct Setting {
        float perceptual_roughness, strength, NoV, azimuth_rad;
    };
    std::vector<Setting> settings;
    for (const float roughness : {0.2f, 0.4f, 0.6f})
        for (const float strength : {0.3f, 0.6f, 0.9f})
            for (const float NoV : {0.25f, 0.6f, 0.95f})
                for (const float azimuth_rad : {0.4f, 1.2f})
                    settings.push_back({roughness, strength, NoV, azimuth_rad});
    std::vector<LayerView> views(settings.size());
    tbb::parallel_for(std::size_t{0}, views.size(), [&](std::size_t i) {
        const Setting s = settings[i];
        const glm::vec2 alpha = shading::anisotropic_alpha(s.perceptual_roughness, s.strength);
        views[i].view = anisotropic_view(s.NoV, alpha, s.azimuth_rad);
        views[i].view.perceptual_roughness = s.perceptual_roughness;
        views[i].reads = [s, alpha](const std::vector<double>& k) {
            const glm::vec3 t(std::cos(s.azimuth_rad), std::sin(s.azimuth_rad), 0.0f);
            const shading::AnisotropicLobe lobe = shading::anisotropic_lobe_widened(
                kNormal, t, {-t.y, t.x, 0.0f}, view_at(s.NoV), s.NoV, alpha, float(std::abs(k[0])));
            std::vector<LobeRead> reads;
            for (const int end : {-1, 1}) {
                reads.push_back(shading::anisotropic_read_at(lobe, float(end * k[1]), float(k[3])));
                reads.push_back(shading::anisotropic_read_at(lobe, float(end * k[2]), float(k[4])));
            }
            reads.push_back(shading::anisotropic_read_at(lobe, 0.0f, 1.0f));
            float weights = 0.0f;
            for (const LobeRead& read : reads) weights += read.weight;
            for (LobeRead& read : reads) read.weight /= weights;
            return reads;
        };
    });
    fit(views, {0.1, 0.5, 1.5, 0.5, 0.5}, out);
    out.instead = errors_of(views, [](const LayerView& v) {
        return std::vector<LobeRead>{{glm::vec3(mirror_of(v.view.v)), v.view.perceptual_roughness, 1.0f}};
    });
    return out;
}

LayerFit fit_sheen_read() {
    LayerFit out{"sheen, one read", "n.v and sheen roughness 0.1 to 1 in tenths", {}, {}, {}, {}};
    const auto constants = [&](const std::string& of, const glm::vec3& low, const glm::vec3& squares) {
        const std::array<const char*, 6> terms{"1", "c", "r", "c c", "c r", "r r"};
        for (int i = 0; i < 6; ++i)
            out.constants.push_back(
                {of + ", " + terms[std::size_t(i)], double(i < 3 ? low[i] : squares[i - 3]), 0.0});
    };
    constants("log of tilt", shading::kSheenTilt, shading::kSheenTiltSquares);
    constants("width", shading::kSheenWidth, shading::kSheenWidthSquares);
    std::vector<LayerView> views(100);
    tbb::parallel_for(std::size_t{0}, views.size(), [&](std::size_t i) {
        const float c = float(i % 10 + 1) / 10.0f;
        const float r = float(i / 10 + 1) / 10.0f;
        views[i].view = sheen_view(c, r);
        views[i].reads = [c, r](const std::vector<double>& k) {
            const std::array<double, 6> terms{1.0,           double(c),     double(r),
                                              double(c * c), double(c * r), double(r * r)};
            double log_tilt = 0.0;
            double width = 0.0;
            for (std::size_t t = 0; t < terms.size(); ++t) {
                log_tilt += k[t] * terms[t];
                width += k[t + 6] * terms[t];
            }
            return std::vector<LobeRead>{
                shading::sheen_read_at(kNormal, view_at(c), c, float(log_tilt), float(width))};
        };
    });
    fit(views, {0, 0, 0, 0, 0, 0, 0.7, 0, 0, 0, 0, 0}, out);
    // The cosine over pi is between the kernels of perceptual roughness; 1 is the nearest (D is 1 / pi
    // there).
    out.instead = errors_of(views, [](const LayerView&) {
        return std::vector<LobeRead>{{kNormal, 1.0f, 1.0f}};
    });
    return out;
}

}  // namespace candela::bake
