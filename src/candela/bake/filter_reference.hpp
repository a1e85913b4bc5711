#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "candela/scene/scene.hpp"

namespace candela::bake {

/// The truth that filters are held against: an environment, read bilinearly, integrated with the LD weight by
/// quadrature over all of its texels, each in 2 x 2 parts and in 16 x 16 near the direction.
class FilterReference {
  public:
    explicit FilterReference(const scene::Environment& environment);

    /// In cd/m^2, for a unit direction in the world.
    [[nodiscard]] glm::dvec3 ld(const glm::vec3& direction, float alpha) const;

  private:
    struct Sum {
        glm::dvec3 light{0.0};
        double weight = 0.0;
    };
    void add_coarse(const glm::vec3& direction, float alpha, float near, std::size_t row, Sum& sum) const;
    void add_fine(const glm::vec3& direction, float alpha, std::size_t column, std::size_t row,
                  Sum& sum) const;
    [[nodiscard]] glm::vec3 read(float u, float v) const;

    const scene::Environment& environment_;
    std::size_t columns_;
    std::size_t rows_;
    std::vector<float> x_, y_, z_, solid_angle_;  // of the parts
    std::vector<float> r_, g_, b_;
};

}  // namespace candela::bake
