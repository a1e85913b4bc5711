#include "candela/measure/dfg_lookup.hpp"
#include "candela/measure/numerics.hpp"

namespace candela::measure::experiments {
namespace {

using namespace shading;

constexpr std::uint32_t kTruthSamples = 1000000;

struct Errors {
    ErrorStatistics quadrature;
    ErrorStatistics read;
};

void add(Errors& errors, const vec2& quadrature, const vec2& read, const glm::dvec2& truth) {
    for (int c = 0; c < 2; ++c) {
        errors.quadrature.add(double(quadrature[c]) - truth[c]);
        errors.read.add(double(read[c]) - truth[c]);
    }
}

/// Red: scale of f0, green: bias, as values without a transfer curve; roughness grows upwards.
Panel picture_of(const DfgLookup& table) {
    constexpr int size = 192;
    Panel out{"The table: red scales F0, green is added",
              "Across: cosine of the view, 0 to 1. Up: roughness, 0 to 1.",
              size,
              size,
              {},
              1};
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const vec2 ab = table.read((float(x) + 0.5f) / size, 1.0f - (float(y) + 0.5f) / size);
            for (const float channel : {ab.x, ab.y, 0.0f})
                out.rgb.push_back(std::uint8_t(std::lround(255.0f * saturate(channel))));
        }
    }
    return out;
}

Findings run() {
    const DfgLookup correlated(DfgKind::smith_correlated);
    const DfgLookup ue4(DfgKind::ue4_schlick_smith);
    Errors correlated_errors;
    Errors ue4_errors;
    float lowest = 1.0f;
    float highest = 0.0f;
    Plot scale{"Scale of F0",
               "Lines: the table as the frame reads it, Karis's model. Circles: 10^6 samples.",
               {"n.v", 0.0, 1.0},
               {"scale", 0.0, 1.0},
               {}};
    Plot bias{"Bias", "", {"n.v", 0.0, 1.0}, {"bias"}, {}};
    Table table{"Karis's model: table read bilinearly, minus 10^6 samples",
                {"roughness", "n.v", "scale", "error", "bias", "error"},
                {}};
    int color = 0;
    for (const float roughness : {0.1f, 0.22f, 0.35f, 0.5f, 0.65f, 0.8f, 1.0f}) {
        Series scale_truth{"", {}, {}, Stroke::points, color};
        Series bias_truth{"", {}, {}, Stroke::points, color};
        for (const float NoV : {0.03f, 0.08f, 0.15f, 0.25f, 0.4f, 0.55f, 0.75f, 1.0f}) {
            const glm::dvec4 truth = dfg_truth(NoV, roughness, kTruthSamples);
            const vec2 read = ue4.read(NoV, roughness);
            lowest = std::min({lowest, read.x, read.y});
            highest = std::max({highest, read.x, read.y});
            add(correlated_errors, integrate_ggx_albedo(NoV, roughness, kDfgSamples),
                correlated.read(NoV, roughness), {truth.x, truth.y});
            add(ue4_errors, integrate_ggx_albedo_ue4(NoV, roughness, kDfgSamples), read, {truth.z, truth.w});
            for (Series* s : {&scale_truth, &bias_truth}) s->x.push_back(double(NoV));
            scale_truth.y.push_back(truth.z);
            bias_truth.y.push_back(truth.w);
            if (NoV == 0.08f || NoV == 0.4f || NoV == 1.0f) {
                table.rows.push_back({number(double(roughness)), number(double(NoV)),
                                      fixed(double(read.x), 4), fixed(double(read.x) - truth.z, 5),
                                      fixed(double(read.y), 4), fixed(double(read.y) - truth.w, 5)});
            }
        }
        if (roughness == 0.22f || roughness == 0.65f || roughness == 0.1f) {
            ++color;
            continue;
        }
        const auto x = linspace(0.0, 1.0, 201);
        const std::string name = "roughness " + number(double(roughness));
        scale.series.push_back(curve(
            name, x, [&](double c) { return ue4.read(float(c), roughness).x; }, Stroke::solid, color));
        bias.series.push_back(curve(
            name, x, [&](double c) { return ue4.read(float(c), roughness).y; }, Stroke::solid, color));
        scale.series.push_back(scale_truth);
        bias.series.push_back(bias_truth);
        ++color;
    }
    Findings out;
    out.text = "Candela's table holds 64 x 64 texels of " + number(double(kDfgSamples)) +
               " points each, over the root of n.v. Against 10^6 samples the points are within " +
               number(ue4_errors.quadrature.max(), 2) + " for Karis's model and " +
               number(correlated_errors.quadrature.max(), 2) +
               " for height-correlated Smith; as read from the table they are within " +
               number(ue4_errors.read.max(), 2) + " and " + number(correlated_errors.read.max(), 2) +
               ". Both outputs stay within [0, 1], as the paper says.";
    out.measured = {
        at_least("Karis's model: scale and bias, lowest", double(lowest), 0.0),
        at_most("Karis's model: scale and bias, highest", double(highest), 1.0),

        at_most("Karis's model: quadrature, largest error", ue4_errors.quadrature.max(), 2e-3),
        at_most("Karis's model: table as read, mean error", ue4_errors.read.mean(), 5e-4),
        at_most("Karis's model: table as read, largest error", ue4_errors.read.max(), 2e-3),
        at_most("correlated Smith: quadrature, largest error", correlated_errors.quadrature.max(), 2e-3),
        at_most("correlated Smith: table as read, mean error", correlated_errors.read.mean(), 5e-4),
        at_most("correlated Smith: table as read, largest error", correlated_errors.read.max(), 2e-3)};
    out.pictures = {picture_of(ue4)};
    out.plots = {scale, bias};
    out.tables = {table};
    const auto cost = [](DfgKind kind) {
        return [kind] {
            const DfgLookup lookup(kind);
            return cost_ns([&](const vec4& u) { return lookup.read(u.x, u.y).x; });
        };
    };
    const std::string truth = "10^6 samples, roughness 0.1 to 1, n.v 0.03 to 1";
    out.techniques = {
        {"DFG table, UE4 model", "Karis 2013, Environment BRDF", "the second sum of the split sum", truth, "",
         ue4_errors.read.mean(), ue4_errors.read.max(), cost(DfgKind::ue4_schlick_smith)},
        {"DFG table, correlated Smith", "Frostbite section 4.9.2", "the DFG term", truth, "",
         correlated_errors.read.mean(), correlated_errors.read.max(), cost(DfgKind::smith_correlated)}};
    return out;
}

}  // namespace

Experiment karis2013_figure3() {
    return {"Karis 2013", "Figure 3", "The environment-BRDF table against 10^6 samples",
            "Scale and bias of F0 as the frame reads them, and their quadrature, for Karis's model and for "
            "height-correlated Smith.",
            run};
}

}  // namespace candela::measure::experiments
