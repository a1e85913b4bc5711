#include <cmath>

#include "candela/bake/environment.hpp"
#include "candela/measure/experiment.hpp"
#include "candela/measure/filter_error.hpp"
#include "candela/measure/numerics.hpp"
#include "shading/cube.glsl"
#include "shading/transfer.glsl"

namespace candela::measure::experiments {
namespace {

constexpr std::uint32_t kSize = 128;
constexpr std::uint32_t kSamples = 64;

/// A lamp in the studio that few samples find.
scene::Environment lit_studio() {
    scene::Environment e = bake::studio_environment();
    for (std::uint32_t y = 96; y < 99; ++y) {
        for (std::uint32_t x = 300; x < 303; ++x)
            e.luminance_nit[std::size_t{y} * e.width + x] = glm::vec3(1.5e6f, 1.2e6f, 0.8e6f);
    }
    return e;
}

scene::FilteredEnvironment filtered(const scene::Environment& e, bake::FilterTechnique technique,
                                    std::uint32_t samples) {
    bake::FilterOptions options;
    options.size = kSize;
    options.technique = technique;
    options.sample_count = samples;
    options.texel = bake::TexelValue::center;
    return bake::filter_environment(e, options);
}

/// Three faces of a level in a row.
Panel faces(const char* title, const scene::FilteredEnvironment& f, std::size_t level) {
    const scene::CubeMap& cube = f.specular[level];
    Panel panel{title, "", 3 * cube.size, cube.size, {}, 6};
    for (std::uint32_t y = 0; y < cube.size; ++y) {
        for (const std::uint32_t face : {4u, 0u, 2u}) {
            for (std::uint32_t x = 0; x < cube.size; ++x) {
                const glm::vec3 value = cube.texels[cube.index(face, x, y)] * (f.nit_per_unit / 1600.0f);
                for (int c = 0; c < 3; ++c)
                    panel.rgb.push_back(static_cast<std::uint8_t>(
                        std::lround(255.0f * shading::srgb_from_linear(std::min(value[c], 1.0f)))));
            }
        }
    }
    return panel;
}

Findings run() {
    using bake::FilterTechnique;
    Findings out;
    const scene::Environment e = lit_studio();
    const auto plain = filtered(e, FilterTechnique::ggx_importance, kSamples);
    const auto quick = filtered(e, FilterTechnique::filtered_importance, kSamples);
    const auto exact = filtered(e, FilterTechnique::harmonic, 0);
    // alpha 0.08.
    constexpr std::size_t level = 2;
    out.pictures = {faces("Importance sampling, 64 samples", plain, level),
                    faces("Pre-filtered importance sampling, 64 samples", quick, level),
                    faces("Convolution in harmonics", exact, level)};
    const FilterTruth truth = filter_truth(e, kSize, scene::RoughnessMapping::linear, 16);
    Plot plot{"Relative RMSE by level",
              "64 samples a texel, against the integral.",
              {"alpha", 0.0, 1.0},
              {"RMSE", 1e-5, 10.0, Scale::logarithmic},
              {}};
    for (const auto& [name, f] :
         {std::pair{"importance", &plain}, {"pre-filtered importance", &quick}, {"harmonics", &exact}}) {
        Series series{name, {}, {}};
        const std::vector<LevelError> errors = filter_errors(truth, *f);
        double sum = 0.0;
        for (const LevelError& error : errors) {
            series.x.push_back(double(error.alpha));
            series.y.push_back(error.rmse);
            sum += error.rmse;
        }
        plot.series.push_back(std::move(series));
        out.measured.push_back(at_most(std::string(name) + ", mean relative RMSE",
                                       sum / double(errors.size()),
                                       f == &exact ? 0.005 : (f == &quick ? 0.5 : 5.0)));
    }
    out.plots.push_back(std::move(plot));
    out.text =
        "Pre-filtering removes the speckle of a lamp that few samples meet, at the cost of a bias; the "
        "convolution shows neither.";
    return out;
}

}  // namespace

Experiment frostbite_figure56() {
    return {"Lagarde & de Rousiers 2014 (Frostbite)", "Figure 56",
            "Importance sampling with and without pre-filtering",
            "A studio with a small lamp, blurred for alpha 0.08 with 64 samples a texel, plainly and reading "
            "coarser levels where samples are far apart (listing 19).",
            run};
}

}  // namespace candela::measure::experiments
