#include "candela/bake/filter_environment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <optional>
#include <string>

#include "candela/bake/cube_pyramid.hpp"
#include "candela/bake/filter_harmonic.hpp"
#include "candela/bake/filter_sampled.hpp"
#include "candela/bake/irradiance_harmonics.hpp"
#include "candela/scene/error.hpp"
#include "candela/scene/half_range.hpp"
#include "shading/cube.glsl"
#include "shading/microfacet.glsl"
#include "shading/spherical_harmonics.glsl"

namespace candela::bake {
namespace {

constexpr std::array<const char*, 4> kNames{"harmonic", "filtered-importance", "ggx-importance",
                                            "cosine-power"};

/// What their authors take: Frostbite's footnote 41, Karis 2013's listing.
std::uint32_t sample_count(const FilterOptions& options) {
    if (options.sample_count > 0) return options.sample_count;
    return options.technique == FilterTechnique::filtered_importance ? 32 : 1024;
}

std::uint32_t level_count(const FilterOptions& options) {
    std::uint32_t most = 1;
    while ((options.size >> most) > 0) ++most;
    return options.levels == 0 ? most : std::min(options.levels, most);
}

void check(const scene::Environment& environment, const FilterOptions& options) {
    if (options.size == 0 || (options.size & (options.size - 1)) != 0 || options.irradiance_size == 0)
        throw Error(Fault::usage, "a cube's size must be a power of two", std::to_string(options.size));
    if (environment.width == 0 || environment.height == 0)
        throw input_error("an environment without texels cannot be filtered", environment.name);
}

std::vector<float> level_alphas(const FilterOptions& options) {
    const std::uint32_t levels = level_count(options);
    std::vector<float> alphas;
    for (std::uint32_t level = 0; level < levels; ++level)
        alphas.push_back(shading::alpha_from_perceptual_roughness(
            scene::perceptual_roughness_of_level(options.mapping, level, levels)));
    return alphas;
}

/// Against what sampling a field at points leaves: a level has exactly the energy of the map.
void set_energy(scene::CubeMap& cube, const glm::dvec3& energy) {
    const glm::dvec3 now = cube_energy(cube);
    glm::vec3 scale(1.0f);
    for (int c = 0; c < 3; ++c) {
        if (now[c] > 0.0) scale[c] = static_cast<float>(energy[c] / now[c]);
    }
    for (glm::vec3& texel : cube.texels) texel *= scale;
}

/// scene::HarmonicsWindow::error against irradiance at the centres of a cube's texels.
double relative_error(const Sh9& sh, const scene::CubeMap& truth) {
    double differences = 0.0, squares = 0.0;
    for (std::uint32_t face = 0; face < 6; ++face) {
        for (std::uint32_t y = 0; y < truth.size; ++y) {
            for (std::uint32_t x = 0; x < truth.size; ++x) {
                const glm::vec2 uv = (glm::vec2(x, y) + 0.5f) / static_cast<float>(truth.size);
                const glm::vec3 p = shading::cube_point(static_cast<int>(face), uv);
                const double weight = std::pow(double{glm::dot(p, p)}, -1.5);
                const glm::dvec3 expected(truth.texels[truth.index(face, x, y)]);
                const glm::dvec3 off = glm::dvec3(evaluate_sh(sh, glm::normalize(p))) - expected;
                differences += weight * glm::dot(off, off);
                squares += weight * glm::dot(expected, expected);
            }
        }
    }
    return squares > 0.0 ? std::sqrt(differences / squares) : 0.0;
}

class Filter {
  public:
    Filter(const scene::Environment& environment, const FilterOptions& options)
        : options_(options),
          alphas_(level_alphas(options)),
          light_(equirect_light(environment, environment.scale, 8 * options.size)),
          harmonics_(analyze_for(light_, least_alpha())) {}

    [[nodiscard]] scene::FilteredEnvironment run() const {
        scene::FilteredEnvironment out;
        out.mapping = options_.mapping;
        if (options_.technique == FilterTechnique::harmonic)
            harmonic_levels(out);
        else
            sampled_levels(out);
        const LobeField irradiance(light_, harmonics_, 1.0f);
        out.irradiance =
            sample_cube(irradiance, light_.rotation_rad, 1.0f, options_.irradiance_size, options_.texel);
        add_harmonics(irradiance, out);
        to_units(out);
        return out;
    }

  private:
    /// Each level has a quarter of the texels of the one before; those of level 0 are no work.
    void report(std::size_t level) const {
        if (options_.progress) options_.progress(1.0 - std::pow(0.25, double(level - 1)));
    }

    /// With what they are off by against the irradiance itself.
    void add_harmonics(const LobeField& irradiance, scene::FilteredEnvironment& out) const {
        constexpr std::uint32_t size = 16;
        const scene::CubeMap truth =
            sample_cube(irradiance, light_.rotation_rad, 1.0f, size, TexelValue::center);
        out.irradiance_sh = irradiance_sh(light_, harmonics_);
        for (std::size_t i = 0; i < out.radiance_sh.size(); ++i)
            out.radiance_sh[i] = out.irradiance_sh[i] / shading::sh_cosine_over_pi(static_cast<int>(i));
        const double without = relative_error(out.irradiance_sh, truth);
        out.irradiance_sh_window = window_negative(out.irradiance_sh);
        out.irradiance_sh_window.error_without = without;
        out.irradiance_sh_window.error = relative_error(out.irradiance_sh, truth);
    }

    /// The narrowest lobe that harmonics are for.
    [[nodiscard]] float least_alpha() const {
        float least = 1.0f;
        if (options_.technique != FilterTechnique::harmonic) return least;
        for (std::size_t level = 1; level < alphas_.size(); ++level) {
            if (!is_narrow(alphas_[level])) least = std::min(least, alphas_[level]);
        }
        return least;
    }

    void harmonic_levels(scene::FilteredEnvironment& out) const {
        const glm::dvec3 energy = light_.energy();
        out.specular.push_back(mean_cube(light_, options_.size));
        set_energy(out.specular.back(), energy);
        std::optional<CubePyramid> smooth;
        for (std::size_t level = 1; level < alphas_.size(); ++level) {
            report(level);
            const std::uint32_t size = options_.size >> level;
            const float alpha = alphas_[level];
            if (is_narrow(alpha)) {
                if (!smooth) smooth.emplace(mean_cube(without_peaks(), options_.size));
                out.specular.push_back(narrow_cube(light_, *smooth, alpha, size));
            } else {
                out.specular.push_back(sample_cube(LobeField(light_, harmonics_, alpha), light_.rotation_rad,
                                                   alpha, size, options_.texel));
            }
            if (options_.texel == TexelValue::mean) set_energy(out.specular.back(), energy);
        }
    }

    [[nodiscard]] EquirectLight without_peaks() const {
        EquirectLight smooth = light_;
        smooth.peaks.clear();
        return smooth;
    }

    void sampled_levels(scene::FilteredEnvironment& out) const {
        const CubePyramid source(mean_cube(light_, options_.size));
        out.specular.push_back(source.level(0));
        for (std::size_t level = 1; level < alphas_.size(); ++level) {
            report(level);
            const std::uint32_t size = options_.size >> level;
            if (options_.technique == FilterTechnique::cosine_power)
                out.specular.push_back(cosine_power_cube(source, alphas_[level], size));
            else
                out.specular.push_back(
                    ggx_samples_cube(source, alphas_[level], size, sample_count(options_),
                                     options_.technique == FilterTechnique::filtered_importance));
        }
    }

    static void to_units(scene::FilteredEnvironment& out) {
        float peak = 0.0f;
        for (const scene::CubeMap& cube : out.specular) {
            for (const glm::vec3& texel : cube.texels)
                peak = std::max(peak, std::max(texel.x, std::max(texel.y, texel.z)));
        }
        out.nit_per_unit = scene::unit_for_half(peak);
        if (out.nit_per_unit == 1.0f) return;
        const float scale = 1.0f / out.nit_per_unit;
        for (scene::CubeMap& cube : out.specular) {
            for (glm::vec3& texel : cube.texels) texel *= scale;
        }
        for (glm::vec3& texel : out.irradiance.texels) texel *= scale;
        for (glm::vec3& coefficient : out.irradiance_sh) coefficient *= scale;
        for (glm::vec3& coefficient : out.radiance_sh) coefficient *= scale;
    }

    FilterOptions options_;
    std::vector<float> alphas_;
    EquirectLight light_;
    Harmonics harmonics_;
};

}  // namespace

const char* filter_technique_name(FilterTechnique technique) {
    return kNames[static_cast<std::size_t>(technique)];
}

FilterTechnique filter_technique(const char* name) {
    for (std::size_t i = 0; i < kNames.size(); ++i) {
        if (std::strcmp(kNames[i], name) == 0) return static_cast<FilterTechnique>(i);
    }
    throw Error(Fault::usage, std::string("there is no technique '") + name + "' to filter with", "",
                "harmonic, filtered-importance, ggx-importance or cosine-power");
}

scene::FilteredEnvironment filter_environment(const scene::Environment& environment,
                                              const FilterOptions& options) {
    check(environment, options);
    return Filter(environment, options).run();
}

}  // namespace candela::bake
