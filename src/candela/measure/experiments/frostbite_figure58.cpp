#include <algorithm>
#include <cmath>

#include "candela/bake/cube_pyramid.hpp"
#include "candela/bake/environment.hpp"
#include "candela/measure/experiment.hpp"
#include "candela/measure/filter_error.hpp"
#include "candela/measure/numerics.hpp"
#include "shading/microfacet.glsl"
#include "shading/sampling.glsl"

namespace candela::measure::experiments {
namespace {

constexpr std::uint32_t kSize = 128;
constexpr std::uint32_t kDirections = 16;

glm::vec3 direction(std::uint32_t i) {
    const float y = 1.0f - 2.0f * (static_cast<float>(i) + 0.5f) / kDirections;
    const float r = std::sqrt(1.0f - y * y);
    const float phi = 2.39996323f * static_cast<float>(i);
    return {r * std::cos(phi), y, r * std::sin(phi)};
}

/// Levels read as a sampler does: between two, each bilinearly.
class Levels {
  public:
    explicit Levels(const scene::FilteredEnvironment& f)
        : mapping_(f.mapping), nit_per_unit_(f.nit_per_unit) {
        for (const scene::CubeMap& cube : f.specular) cubes_.emplace_back(cube);
    }
    [[nodiscard]] double read(const glm::vec3& d, float perceptual_roughness) const {
        const auto last = static_cast<float>(cubes_.size() - 1);
        const float level =
            last * (mapping_ == scene::RoughnessMapping::frostbite ? std::sqrt(perceptual_roughness)
                                                                   : perceptual_roughness);
        const auto finer = std::min(static_cast<std::size_t>(level), cubes_.size() - 2);
        const float fraction = level - static_cast<float>(finer);
        return double(nit_per_unit_ *
                      glm::mix(cubes_[finer].read(d, 0u).y, cubes_[finer + 1].read(d, 0u).y, fraction));
    }

  private:
    scene::RoughnessMapping mapping_;
    float nit_per_unit_;
    std::vector<bake::CubePyramid> cubes_;
};

Findings run() {
    Findings out;
    const scene::Environment e = bake::studio_environment();
    bake::FilterOptions options;
    options.size = kSize;
    options.levels = 7;
    const Levels linear(bake::filter_environment(e, options));
    options.mapping = scene::RoughnessMapping::frostbite;
    const Levels squared(bake::filter_environment(e, options));
    const bake::FilterReference reference(e);
    Series a{"linear", {}, {}};
    Series b{"squared, equation 63", {}, {}};
    double smooth[2] = {};
    for (const double roughness : {0.06, 0.12, 0.2, 0.3, 0.4, 0.55, 0.7, 0.85, 1.0}) {
        const auto r = static_cast<float>(roughness);
        double sum[2] = {};
        double truths = 0.0;
        for (std::uint32_t i = 0; i < kDirections; ++i) {
            const double truth = reference.ld(direction(i), shading::alpha_from_perceptual_roughness(r)).y;
            sum[0] += std::pow(linear.read(direction(i), r) - truth, 2);
            sum[1] += std::pow(squared.read(direction(i), r) - truth, 2);
            truths += truth * truth;
        }
        a.x.push_back(roughness);
        a.y.push_back(std::sqrt(sum[0] / truths));
        b.x.push_back(roughness);
        b.y.push_back(std::sqrt(sum[1] / truths));
        if (roughness < 0.25) {
            smooth[0] = std::max(smooth[0], a.y.back());
            smooth[1] = std::max(smooth[1], b.y.back());
        }
    }
    out.measured = {at_most("Linear: largest error below perceptual roughness 0.25", smooth[0], 0.1),
                    at_most("Squared: largest error below perceptual roughness 0.25", smooth[1], 0.15)};
    out.plots.push_back({"Relative RMSE of what is read between levels",
                         "Seven levels of a 128² cube, each texel its mean.",
                         {"perceptual roughness", 0.0, 1.0},
                         {"RMSE", 1e-3, 1.0, Scale::logarithmic},
                         {a, b}});
    out.text =
        "Frostbite finds the squared mapping slightly better for smooth surfaces. In this measure it is not: "
        "read "
        "between levels, the linear mapping is closer to the integral at each of these roughnesses, because "
        "its "
        "levels of middling roughness have twice as many texels a side. What the squared one gains, it gains "
        "below a perceptual roughness of 0.06.";
    return out;
}

}  // namespace

Experiment frostbite_figure58() {
    return {"Lagarde & de Rousiers 2014 (Frostbite)", "Figure 58",
            "Storing roughness in mip levels: two mappings against the integral",
            "The studio read between levels for a row of roughnesses, at 16 directions, where levels are "
            "linear in "
            "the perceptual roughness and where it is their square.",
            run};
}

}  // namespace candela::measure::experiments
