#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "candela/bake/directions.hpp"
#include "candela/bake/equirect_light.hpp"
#include "candela/bake/harmonics.hpp"

namespace candela::bake {

/// Coefficient of each degree of a function blurred by the LD weight of GGX, per coefficient of the function
/// itself: degree 0 has 1.
[[nodiscard]] std::vector<double> ld_zonal_coefficients(float alpha, std::uint32_t degree);

/// Degree beyond which the LD weight has less than 1e-4 left.
[[nodiscard]] std::uint32_t ld_degree(float alpha);

/// A map blurred by the LD weight of one width: its smooth part on a grid, its peaks as the lobe itself.
class LobeField {
  public:
    /// `harmonics` are of `light` and reach ld_degree(alpha), or so far as the map does.
    LobeField(const EquirectLight& light, const Harmonics& harmonics, float alpha);

    /// Replaces the colours; makes the directions unit.
    void evaluate(Directions& directions) const;

  private:
    struct Source {
        glm::vec3 direction;
        glm::vec3 power;  // over the integral of the weight
    };
    void add_sources(const Source* sources, std::size_t count, Directions& directions) const;

    float alpha_;
    SmoothGrid grid_;
    glm::vec4 lowest_;  // of the map: a mean of it is not beyond
    glm::vec4 highest_;
    std::vector<Source> near_;  // nine for each peak
    std::vector<Source> far_;
    float near_half_sine2_ = 0.0f;  // within which the nine are told from one
};

}  // namespace candela::bake
