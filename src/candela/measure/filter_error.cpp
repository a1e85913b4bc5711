#include "candela/measure/filter_error.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "candela/bake/cube_pyramid.hpp"
#include "shading/cube.glsl"
#include "shading/environment.glsl"
#include "shading/microfacet.glsl"
#include "shading/sequence.glsl"

namespace candela::measure {
namespace {

float alpha_of(scene::RoughnessMapping mapping, std::uint32_t level, std::uint32_t levels) {
    return shading::alpha_from_perceptual_roughness(
        scene::perceptual_roughness_of_level(mapping, level, levels));
}

double source_energy(const scene::Environment& e) {
    double sum = 0.0;
    for (std::uint32_t y = 0; y < e.height; ++y) {
        double row = 0.0;
        for (std::uint32_t x = 0; x < e.width; ++x)
            row += shading::luminance(glm::dvec3(e.luminance_nit[std::size_t{y} * e.width + x]));
        sum += row * double(shading::equirect_texel_solid_angle(y, e.width, e.height));
    }
    return sum * double(e.scale);
}

}  // namespace

FilterTruth filter_truth(const scene::Environment& environment, std::uint32_t size,
                         scene::RoughnessMapping mapping, std::uint32_t texels_a_level) {
    const bake::FilterReference reference(environment);
    FilterTruth truth;
    truth.energy = source_energy(environment);
    const auto levels = static_cast<std::uint32_t>(std::log2(size)) + 1;
    for (std::uint32_t level = 1; level < levels; ++level) {
        const std::uint32_t side = size >> level;
        const std::uint32_t all = 6 * side * side;
        const std::uint32_t count = std::min(all, texels_a_level);
        std::vector<FilterTruth::Place> places;
        for (std::uint32_t i = 0; i < count; ++i) {
            const glm::vec2 u = shading::hammersley(i, count);
            const std::uint32_t row =
                std::min(static_cast<std::uint32_t>(u.x * static_cast<float>(6 * side)), 6 * side - 1);
            const auto column =
                count == all ? i % side : static_cast<std::uint32_t>(u.y * static_cast<float>(side));
            const std::uint32_t exact_row = count == all ? i / side : row;
            places.push_back({exact_row / side, column, exact_row % side, 0.0});
        }
        tbb::parallel_for(std::size_t{0}, places.size(), [&](std::size_t i) {
            FilterTruth::Place& place = places[i];
            const glm::vec2 uv = (glm::vec2(place.x, place.y) + 0.5f) / static_cast<float>(side);
            place.luminance_nit = shading::luminance(
                reference.ld(glm::normalize(shading::cube_point(static_cast<int>(place.face), uv)),
                             alpha_of(mapping, level, levels)));
        });
        truth.levels.push_back(std::move(places));
    }
    return truth;
}

std::vector<LevelError> filter_errors(const FilterTruth& truth, const scene::FilteredEnvironment& filtered) {
    std::vector<LevelError> errors;
    const auto levels = static_cast<std::uint32_t>(filtered.specular.size());
    for (std::uint32_t level = 1; level < levels; ++level) {
        const scene::CubeMap& cube = filtered.specular[level];
        LevelError error;
        error.size = cube.size;
        error.alpha = alpha_of(filtered.mapping, level, levels);
        error.energy_ratio =
            shading::luminance(bake::cube_energy(cube)) * double(filtered.nit_per_unit) / truth.energy;
        double squares = 0.0;
        double truth_squares = 0.0;
        for (const FilterTruth::Place& place : truth.levels[level - 1]) {
            const double value =
                shading::luminance(glm::dvec3(cube.texels[cube.index(place.face, place.x, place.y)])) *
                double(filtered.nit_per_unit);
            const double difference = value - place.luminance_nit;
            squares += difference * difference;
            truth_squares += place.luminance_nit * place.luminance_nit;
            error.largest = std::max(error.largest, std::abs(difference) / place.luminance_nit);
        }
        error.rmse = std::sqrt(squares / truth_squares);
        errors.push_back(error);
    }
    return errors;
}

scene::Environment one_texel_sun_environment(std::uint32_t width) {
    scene::Environment e;
    e.name = "sun of one texel";
    e.width = width;
    e.height = width / 2;
    for (std::uint32_t y = 0; y < e.height; ++y) {
        const float up =
            std::cos(shading::PI * (static_cast<float>(y) + 0.5f) / static_cast<float>(e.height));
        const glm::vec3 color =
            up > 0.0f ? glm::vec3(900.0f, 1500.0f, 3000.0f) * (1.3f - up) : glm::vec3(220.0f, 200.0f, 160.0f);
        e.luminance_nit.insert(e.luminance_nit.end(), e.width, color);
    }
    e.luminance_nit[std::size_t{e.height / 4} * e.width + e.width / 3] = glm::vec3(1.6e9f);
    return e;
}

}  // namespace candela::measure
