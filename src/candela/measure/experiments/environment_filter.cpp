#include "candela/bake/environment.hpp"
#include "candela/measure/experiment.hpp"
#include "candela/measure/filter_error.hpp"
#include "candela/measure/numerics.hpp"
#include "shading/environment.glsl"

namespace candela::measure::experiments {
namespace {

constexpr std::uint32_t kSize = 64;

/// The studio with half as many texels each way.
scene::Environment small_studio() {
    const scene::Environment from = bake::studio_environment();
    scene::Environment e = from;
    e.width /= 2;
    e.height /= 2;
    e.luminance_nit.clear();
    for (std::uint32_t y = 0; y < e.height; ++y) {
        for (std::uint32_t x = 0; x < e.width; ++x)
            e.luminance_nit.push_back(
                from.luminance_nit[std::size_t{2} * y * from.width + std::size_t{2} * x]);
    }
    return e;
}

std::string short_name(const scene::Environment& e) {
    return e.name + ", " + std::to_string(e.width) + "x" + std::to_string(e.height);
}

void add_map(Findings& out, const scene::Environment& environment, double rmse_at_most) {
    using bake::FilterTechnique;
    const FilterTruth truth = filter_truth(environment, kSize, scene::RoughnessMapping::linear, 16);
    Table table{
        short_name(environment) + ": error of each level, root mean square / largest", {"technique"}, {}};
    for (std::uint32_t size = kSize / 2; size > 0; size /= 2)
        table.columns.push_back(std::to_string(size) + "²");
    for (const auto technique : {FilterTechnique::harmonic, FilterTechnique::filtered_importance,
                                 FilterTechnique::ggx_importance, FilterTechnique::cosine_power}) {
        bake::FilterOptions options;
        options.size = kSize;
        options.technique = technique;
        options.texel = bake::TexelValue::center;
        const auto errors = filter_errors(truth, bake::filter_environment(environment, options));
        table.rows.push_back({bake::filter_technique_name(technique)});
        double worst = 0.0;
        for (const LevelError& error : errors) {
            table.rows.back().push_back(number(error.rmse, 2) + " / " + number(error.largest, 2));
            worst = std::max(worst, error.rmse);
        }
        if (technique != FilterTechnique::harmonic) continue;
        out.measured.push_back(
            at_most(environment.name + ": harmonic, largest relative RMSE of a level", worst, rmse_at_most));
        options.texel = bake::TexelValue::mean;
        double off = 0.0;
        for (const LevelError& error : filter_errors(truth, bake::filter_environment(environment, options)))
            off = std::max(off, std::abs(error.energy_ratio - 1.0));
        out.measured.push_back(
            at_most(environment.name + ": harmonic, energy of a level off by", off, 1.0e-3));
    }
    out.tables.push_back(std::move(table));
}

Findings run() {
    Findings out;
    add_map(out, one_texel_sun_environment(256), 5.0e-3);
    add_map(out, small_studio(), 5.0e-3);
    out.text =
        "Relative to the integral over all texels at the centres of 16 texels a level. A cosine lobe has no "
        "tail, and samples miss a sun of one texel or meet it too often; the convolution has neither fault.";
    return out;
}

}  // namespace

Experiment environment_filter() {
    return {
        "Lagarde & de Rousiers 2014 (Frostbite)", "4.9.2",
        "Filtering an environment: error of each level by technique",
        "The LD term of Frostbite's equation 53 by convolution in spherical harmonics, by 32 filtered "
        "samples (Krivanek and Colbert), by 1024 samples of GGX, and with a cosine lobe in place of GGX's.",
        run};
}

}  // namespace candela::measure::experiments
