#include <glm/geometric.hpp>

#include "candela/bake/lobe_fit.hpp"
#include "candela/measure/numerics.hpp"
#include "candela/measure/reflection_techniques.hpp"
#include "shading/transfer.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;

constexpr float kRoughness = 0.4f;
constexpr std::array<double, 3> kViews_deg{0.0, 40.0, 80.0};
constexpr int kDiameter = 120;

vec3 view_at(double deg) {
    const double rad = deg * kPi / 180.0;
    return {float(-std::sin(rad)), 0.0f, float(std::cos(rad))};
}

double lobe(const vec3& v, const vec3& l) {
    if (l.z <= 0.0f) return 0.0;
    const float alpha = alpha_from_perceptual_roughness(kRoughness);
    return double(D_GGX(vec3(0, 0, 1), normalize(v + l), alpha) * V_SmithGGXCorrelated(v.z, l.z, alpha) *
                  l.z);
}

/// What a read is worth in a direction: the kernel of a prefiltered map.
double kernel(const LobeRead& read, const vec3& l) {
    const double cosine = double(dot(read.direction, l));
    if (cosine <= 0.0) return 0.0;
    const float alpha = alpha_from_perceptual_roughness(read.perceptual_roughness);
    const auto shape = [alpha](double c) {
        return double(D_GGX_cos2_sin2(float(0.5 * (1.0 + c)), float(0.5 * (1.0 - c)), alpha)) * c;
    };
    const double norm =
        2.0 * kPi * integrate([&](double t) { return shape(1.0 - t * t * t) * 3.0 * t * t; }, 0.0, 1.0, 16);
    return double(read.weight) * shape(cosine) / norm;
}

/// Direction at two angles from the lobe's peak: in the plane of incidence and across it.
vec3 beside(double peak_rad, double along_rad, double across_rad) {
    const double a = peak_rad + along_rad;
    return {float(std::sin(a) * std::cos(across_rad)), float(std::sin(across_rad)),
            float(std::cos(a) * std::cos(across_rad))};
}

struct Shape {
    double peak_rad = 0.0;
    double along_deg = 0.0;  ///< full widths at half height
    double across_deg = 0.0;
};

Shape shape_of(double view_deg) {
    const vec3 v = view_at(view_deg);
    Shape out;
    double top = 0.0;
    for (const double a : linspace(-0.5 * kPi, 0.5 * kPi, 3601)) {
        const double value = lobe(v, beside(a, 0.0, 0.0));
        if (value > top) {
            top = value;
            out.peak_rad = a;
        }
    }
    constexpr double step = 2.0e-4;
    const auto reach = [&](double along, double across) {
        double at = 0.0;
        while (at < kPi && lobe(v, beside(out.peak_rad, along * at, across * at)) > 0.5 * top) at += step;
        return at * 180.0 / kPi;
    };
    out.along_deg = reach(1.0, 0.0) + reach(-1.0, 0.0);
    out.across_deg = 2.0 * reach(0.0, 1.0);
    return out;
}

/// The hemisphere from above, n in the middle, the viewer on the left, brightness over its highest value.
template <class Value>
std::vector<float> disc_of(Value value) {
    std::vector<float> out(std::size_t{kDiameter} * kDiameter, -1.0f);
    float top = 0.0f;
    for (int y = 0; y < kDiameter; ++y)
        for (int x = 0; x < kDiameter; ++x) {
            const float px = (float(x) + 0.5f) / (0.5f * kDiameter) - 1.0f;
            const float py = 1.0f - (float(y) + 0.5f) / (0.5f * kDiameter);
            const float r2 = px * px + py * py;
            if (r2 >= 1.0f) continue;
            float& at = out[std::size_t(y) * kDiameter + std::size_t(x)];
            at = float(value(vec3(px, py, std::sqrt(1.0f - r2))));
            top = std::max(top, at);
        }
    for (float& f : out) f = f < 0.0f ? f : f / top;
    return out;
}

Panel picture() {
    Panel out{
        "Lobe (top) and what the reads make of it: mirror direction, fitted direction, two and three reads",
        "View at 0, 40 and 80 degrees from left to right; the hemisphere of light directions from above, the "
        "viewer "
        "on the left, each over its peak; perceptual roughness 0.4.",
        std::uint32_t(kDiameter * kViews_deg.size()),
        std::uint32_t(kDiameter * 5),
        {},
        1};
    out.rgb.assign(std::size_t{3} * out.width * out.height, 255);
    for (std::size_t column = 0; column < kViews_deg.size(); ++column) {
        const vec3 v = view_at(kViews_deg[column]);
        for (int row = 0; row < 5; ++row) {
            std::vector<LobeRead> reads;
            if (row == 1) reads = {{vec3(-v.x, 0.0f, v.z), kRoughness, 1.0f}};
            if (row > 1) reads = bake::committed_lobe_reads(row - 1, vec3(0, 0, 1), v, v.z, kRoughness, 0.0f);
            const std::vector<float> disc = disc_of([&](const vec3& l) {
                if (row == 0) return lobe(v, l);
                double sum = 0.0;
                for (const LobeRead& read : reads) sum += kernel(read, l);
                return sum;
            });
            for (int y = 0; y < kDiameter; ++y)
                for (int x = 0; x < kDiameter; ++x) {
                    const float value = disc[std::size_t(y) * kDiameter + std::size_t(x)];
                    if (value < 0.0f) continue;
                    const vec3 encoded = srgb_from_linear(vec3(value));
                    const std::size_t at = 3 * ((std::size_t(row) * kDiameter + std::size_t(y)) * out.width +
                                                column * kDiameter + std::size_t(x));
                    for (std::size_t c = 0; c < 3; ++c)
                        out.rgb[at + c] = std::uint8_t(std::lround(255.0f * encoded.x));
                }
        }
    }
    return out;
}

Findings run() {
    Findings out;
    Table table{
        "Lobe D V n.l, perceptual roughness 0.4",
        {"view, degrees", "peak, degrees", "width in the plane of incidence", "width across", "ratio"},
        {}};
    std::array<double, 3> ratios{};
    for (std::size_t i = 0; i < kViews_deg.size(); ++i) {
        const Shape s = shape_of(kViews_deg[i]);
        ratios[i] = s.along_deg / s.across_deg;
        table.rows.push_back({number(kViews_deg[i]), fixed(s.peak_rad * 180.0 / kPi, 1),
                              fixed(s.along_deg, 1), fixed(s.across_deg, 1), fixed(ratios[i], 2)});
    }
    out.tables = {table};
    out.pictures = {picture()};
    out.text = "Seen from above the lobe is round. At 40 degrees it is " + number(ratios[1], 3) +
               " times as wide in the plane of incidence as across it, about 1 / cos 40; at 80 degrees " +
               number(ratios[2], 3) +
               " times, less than 1 / cos 80, because the horizon cuts it off. A prefiltered map has one "
               "round lobe a read.";
    out.measured = {within("width in the plane over width across, view at 0 degrees", ratios[0], 0.99, 1.01),
                    within("width in the plane over width across, view at 40 degrees", ratios[1], 1.2, 1.45),
                    at_least("width in the plane over width across, view at 80 degrees", ratios[2], 2.5)};
    return out;
}

}  // namespace

Experiment frostbite_figure54() {
    return {"Lagarde & de Rousiers 2014 (Frostbite)", "Figure 54", "The lobe's shape over the view's angle",
            "D V n.l of GGX for views at 0, 40 and 80 degrees, its widths along and across, and the sums of "
            "round lobes "
            "that stand for it.",
            run};
}

}  // namespace candela::measure::experiments
