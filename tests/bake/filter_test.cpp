#include <gtest/gtest.h>

#include <algorithm>

#include "candela/bake/cube_pyramid.hpp"
#include "candela/bake/filter_environment.hpp"
#include "candela/bake/filter_reference.hpp"
#include "environments.hpp"
#include "shading/cube.glsl"
#include "shading/environment_filter.glsl"

namespace candela {
namespace {

using bake::FilterOptions;
using bake::FilterTechnique;
using bake::TexelValue;
using scene::FilteredEnvironment;
using scene::RoughnessMapping;

FilterOptions small(RoughnessMapping mapping = RoughnessMapping::linear,
                    FilterTechnique technique = FilterTechnique::harmonic) {
    FilterOptions options;
    options.size = 32;
    options.mapping = mapping;
    options.technique = technique;
    options.irradiance_size = 8;
    return options;
}

float alpha_of(const FilterOptions& options, std::size_t level, std::size_t levels) {
    return shading::alpha_from_perceptual_roughness(scene::perceptual_roughness_of_level(
        options.mapping, static_cast<std::uint32_t>(level), static_cast<std::uint32_t>(levels)));
}

glm::vec3 texel_direction(std::uint32_t face, std::uint32_t x, std::uint32_t y, std::uint32_t size) {
    const glm::vec2 uv = (glm::vec2(x, y) + 0.5f) / static_cast<float>(size);
    return glm::normalize(shading::cube_point(static_cast<int>(face), uv));
}

/// Visits direction and value in cd/m^2 of every texel of a level.
template <class Visit>
void each_texel(const FilteredEnvironment& filtered, const scene::CubeMap& cube, const Visit& visit) {
    for (std::uint32_t face = 0; face < 6; ++face) {
        for (std::uint32_t y = 0; y < cube.size; ++y) {
            for (std::uint32_t x = 0; x < cube.size; ++x)
                visit(texel_direction(face, x, y, cube.size),
                      cube.texels[cube.index(face, x, y)] * filtered.nit_per_unit);
        }
    }
}

TEST(Filter, ConstantLightStaysAsItIs) {
    const scene::Environment e =
        tests::environment_of(64, [](const glm::vec3&) { return glm::vec3(3.0f, 2.0f, 1.0f); });
    for (const auto mapping :
         {RoughnessMapping::linear, RoughnessMapping::frostbite, RoughnessMapping::filament}) {
        const FilteredEnvironment filtered = filter_environment(e, small(mapping));
        ASSERT_EQ(filtered.specular.size(), 6u);
        std::vector<scene::CubeMap> cubes = filtered.specular;
        cubes.push_back(filtered.irradiance);
        for (const scene::CubeMap& cube : cubes) {
            each_texel(filtered, cube, [](const glm::vec3&, const glm::vec3& value) {
                EXPECT_NEAR(value.x, 3.0f, 3.0e-5f);
                EXPECT_NEAR(value.z, 1.0f, 1.0e-5f);
            });
        }
        EXPECT_FALSE(filtered.irradiance_sh_window.any());
    }
}

TEST(Filter, EveryLevelHasTheEnergyOfTheSource) {
    const scene::Environment maps[] = {tests::sky(128), tests::dark_studio(128),
                                       tests::one_texel_sun(128, 0.26f, 0.4f),
                                       tests::one_texel_sun(128, 0.003f, 0.1f)};
    for (const scene::Environment& e : maps) {
        for (const auto mapping :
             {RoughnessMapping::linear, RoughnessMapping::frostbite, RoughnessMapping::filament}) {
            const FilteredEnvironment filtered = filter_environment(e, small(mapping));
            const glm::dvec3 expected = tests::energy(e);
            for (const scene::CubeMap& cube : filtered.specular) {
                const glm::dvec3 found = bake::cube_energy(cube) * double(filtered.nit_per_unit);
                for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c] / expected[c], 1.0, 1.0e-3) << cube.size;
            }
        }
    }
}

TEST(Filter, NoValueLeavesHalfFloatsRange) {
    const FilteredEnvironment filtered = filter_environment(tests::one_texel_sun(128, 0.26f, 0.4f), small());
    float highest = 0.0f;
    for (const scene::CubeMap& cube : filtered.specular) {
        for (const glm::vec3& texel : cube.texels) highest = std::max(highest, texel.x);
    }
    EXPECT_LE(highest, 65504.0f);
    EXPECT_GT(highest, 30000.0f);
}

TEST(Filter, SunOfOneTexelIsTheLobeAndNothingElse) {
    // A point of light makes the lobe itself, dim sky added: no ring, no speckle, no hole, at any distance.
    FilterOptions options = small();
    options.texel = TexelValue::center;
    const scene::Environment e = tests::one_texel_sun(256, 0.26f, 0.4f);
    const FilteredEnvironment filtered = filter_environment(e, options);
    const auto brightest = std::max_element(e.luminance_nit.begin(), e.luminance_nit.end(),
                                            [](const auto& a, const auto& b) { return a.x < b.x; });
    const auto i = static_cast<std::uint32_t>(brightest - e.luminance_nit.begin());
    const glm::vec3 sun = shading::equirect_direction(
        {(float(i % e.width) + 0.5f) / float(e.width), (float(i / e.width) + 0.5f) / float(e.height)});
    const float power = 1.6e9f * shading::equirect_texel_solid_angle(i / e.width, e.width, e.height);
    for (std::size_t level = 2; level < filtered.specular.size(); ++level) {
        const float alpha = alpha_of(options, level, filtered.specular.size());
        each_texel(filtered, filtered.specular[level], [&](const glm::vec3& d, const glm::vec3& value) {
            const float s = shading::half_sine2(d, sun);
            const float expected =
                2.0f + power * shading::ld_weight(s, alpha) / shading::ld_weight_integral(alpha);
            // At the lobe's horizon the extent of the texel shows.
            if (std::abs(1.0f - 2.0f * s) < 0.03f) return;
            EXPECT_NEAR(value.x / expected, 1.0f, 0.01f) << level;
        });
    }
}

TEST(Filter, IsTheIntegral) {
    FilterOptions options = small();
    options.texel = TexelValue::center;
    scene::Environment e = tests::sky(128);
    e.rotation_rad = 0.7f;
    e.scale = 1.5f;
    const FilteredEnvironment filtered = filter_environment(e, options);
    const bake::FilterReference reference(e);
    for (std::size_t level = 1; level < filtered.specular.size(); ++level) {
        const scene::CubeMap& cube = filtered.specular[level];
        const float alpha = alpha_of(options, level, filtered.specular.size());
        for (std::uint32_t face = 0; face < 6; ++face) {
            const std::uint32_t x = (5 * face + 3) % cube.size;
            const std::uint32_t y = (3 * face + 7) % cube.size;
            const glm::dvec3 truth = reference.ld(texel_direction(face, x, y, cube.size), alpha);
            const glm::vec3 value = cube.texels[cube.index(face, x, y)] * filtered.nit_per_unit;
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(double(value[c]) / truth[c], 1.0, 3.0e-3) << level;
        }
    }
}

TEST(Filter, DarkPlacesNearBrightOnesStayDark) {
    FilterOptions options = small();
    options.texel = TexelValue::center;
    const scene::Environment e = tests::dark_studio(128);
    const FilteredEnvironment filtered = filter_environment(e, options);
    const bake::FilterReference reference(e);
    for (std::size_t level = 1; level < filtered.specular.size(); ++level) {
        const scene::CubeMap& cube = filtered.specular[level];
        const float alpha = alpha_of(options, level, filtered.specular.size());
        each_texel(filtered, cube,
                   [](const glm::vec3&, const glm::vec3& value) { EXPECT_GE(value.x, 1.0f); });
        for (std::uint32_t face = 0; face < 6; ++face) {
            const std::uint32_t x = (7 * face + 1) % cube.size;
            const glm::dvec3 truth = reference.ld(texel_direction(face, x, 0, cube.size), alpha);
            const glm::vec3 value = cube.texels[cube.index(face, x, 0)] * filtered.nit_per_unit;
            EXPECT_NEAR(double(value.x) / truth.x, 1.0, 0.03) << level;
        }
    }
}

TEST(Filter, NarrowLobesAreMeansOverTheirTexels) {
    // Frostbite's mapping begins with lobes narrower than a texel.
    const FilterOptions options = [] {
        FilterOptions o = small(RoughnessMapping::frostbite);
        o.levels = 6;
        return o;
    }();
    scene::Environment e = tests::sky(128);
    e.luminance_nit[std::size_t{20} * e.width + 77] = glm::vec3(5.0e5f);
    const FilteredEnvironment filtered = filter_environment(e, options);
    const bake::FilterReference reference(e);
    const scene::CubeMap& cube = filtered.specular[1];
    const float alpha = alpha_of(options, 1, 6);
    ASSERT_LT(alpha, 0.003f);
    double error = 0.0;
    double sum = 0.0;
    each_texel(filtered, cube, [&](const glm::vec3& d, const glm::vec3& value) {
        const glm::vec3 at = shading::cube_uv_face(d);
        // Around the bright texel and here and there.
        const bool near =
            shading::half_sine2(d, shading::equirect_direction({77.5f / 128.0f, 20.5f / 64.0f})) < 0.006f;
        if (!near && (int(at.x * 16.0f) != 3 || int(at.y * 16.0f) % 5 != 0)) return;
        constexpr int parts = 4;
        double truth = 0.0;
        double weight = 0.0;
        for (int k = 0; k < parts * parts; ++k) {
            const glm::vec2 within = (glm::vec2(k % parts, k / parts) + 0.5f) / float(parts) - 0.5f;
            const glm::vec3 p = shading::cube_point(int(at.z), glm::vec2(at) + within / float(cube.size));
            const double w = std::pow(double(glm::dot(p, p)), -1.5);
            truth += w * reference.ld(glm::normalize(p), alpha).x;
            weight += w;
        }
        truth /= weight;
        error += std::pow(double(value.x) - truth, 2);
        sum += truth * truth;
    });
    EXPECT_LT(std::sqrt(error / sum), 0.03);
}

TEST(Filter, EdgesOfFacesAreNotSeen) {
    const scene::Environment e = tests::sky(128);
    for (const auto mapping : {RoughnessMapping::linear, RoughnessMapping::frostbite}) {
        const FilteredEnvironment filtered = filter_environment(e, small(mapping));
        for (std::size_t level = 1; filtered.specular[level].size >= 8; ++level) {
            const scene::CubeMap& cube = filtered.specular[level];
            const std::uint32_t last = cube.size - 1;
            // The step over an edge is like the steps to both sides of it.
            for (std::uint32_t face = 0; face < 6; ++face) {
                for (std::uint32_t i = 0; i < cube.size; ++i) {
                    const float edge = cube.texels[cube.index(face, last, i)].y;
                    const float before = cube.texels[cube.index(face, last - 1, i)].y;
                    const glm::vec3 over = shading::cube_uv_face(shading::cube_point(
                        static_cast<int>(face),
                        (glm::vec2(cube.size, i) + 0.5f) / static_cast<float>(cube.size)));
                    const auto size = static_cast<float>(cube.size);
                    const float beyond = cube.texels[cube.index(static_cast<std::uint32_t>(over.z),
                                                                static_cast<std::uint32_t>(over.x * size),
                                                                static_cast<std::uint32_t>(over.y * size))]
                                             .y;
                    const float step = std::abs(edge - before);
                    EXPECT_LT(std::abs(beyond - edge), 2.5f * step + 0.06f * edge) << level << " " << face;
                }
            }
        }
    }
}

TEST(Filter, RotationTurnsWhatIsSeen) {
    scene::Environment e = tests::dark_studio(128);
    const FilteredEnvironment before = filter_environment(e, small());
    e.rotation_rad = 0.5f * shading::PI;
    const FilteredEnvironment after = filter_environment(e, small());
    for (std::size_t level = 0; level < 4; ++level) {
        const scene::CubeMap& cube = after.specular[level];
        each_texel(after, cube, [&](const glm::vec3& d, const glm::vec3& value) {
            const glm::vec3 at = shading::cube_uv_face(shading::rotate_about_y(d, -0.5f * shading::PI));
            const auto size = static_cast<float>(cube.size);
            const glm::vec3 unturned = before.specular[level].texels[cube.index(
                static_cast<std::uint32_t>(at.z), static_cast<std::uint32_t>(at.x * size),
                static_cast<std::uint32_t>(at.y * size))];
            EXPECT_NEAR(value.x, unturned.x, 1.0e-3f * unturned.x + 0.5f);
        });
    }
}

TEST(Filter, SampledTechniquesConvergeToTheSame) {
    FilterOptions options = small();
    options.texel = TexelValue::center;
    const scene::Environment e = tests::sky(64);
    const FilteredEnvironment truth = filter_environment(e, options);
    for (const auto technique : {FilterTechnique::filtered_importance, FilterTechnique::ggx_importance}) {
        options.technique = technique;
        options.sample_count = 2048;
        const FilteredEnvironment sampled = filter_environment(e, options);
        for (std::size_t level = 1; level < truth.specular.size(); ++level) {
            for (std::size_t i = 0; i < truth.specular[level].texels.size(); ++i)
                ASSERT_NEAR(sampled.specular[level].texels[i].x / truth.specular[level].texels[i].x, 1.0f,
                            0.08f)
                    << bake::filter_technique_name(technique) << " " << level;
        }
    }
}

TEST(Filter, CosinePowerIsLambertsAtFullRoughness) {
    FilterOptions options = small();
    options.technique = FilterTechnique::cosine_power;
    const scene::Environment e = tests::sky(64);
    const FilteredEnvironment filtered = filter_environment(e, options);
    const bake::FilterReference reference(e);
    each_texel(filtered, filtered.specular.back(), [&](const glm::vec3& d, const glm::vec3& value) {
        EXPECT_NEAR(double(value.x) / reference.ld(d, 1.0f).x, 1.0, 0.005);
    });
}

TEST(Filter, NamesOfTechniquesGoBothWays) {
    for (int i = 0; i < 4; ++i) {
        const auto technique = static_cast<FilterTechnique>(i);
        EXPECT_EQ(bake::filter_technique(bake::filter_technique_name(technique)), technique);
    }
    EXPECT_ANY_THROW((void)bake::filter_technique("prefilter"));
    FilterOptions odd;
    odd.size = 100;
    EXPECT_ANY_THROW((void)filter_environment(tests::sky(16), odd));
}

}  // namespace
}  // namespace candela
