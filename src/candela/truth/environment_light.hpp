#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "candela/bake/environment_distribution.hpp"
#include "candela/scene/scene.hpp"

namespace candela::truth {

struct DirectionSample {
    glm::vec3 direction{0.0f};  ///< world, unit
    glm::vec3 luminance_nit{0.0f};
    float pdf = 0.0f;  ///< 1/sr; 0: nothing was drawn
};

/// A distant light as the integrals see it: read bilinearly, drawn by luminance.
class EnvironmentLight {
  public:
    /// A black one draws nothing.
    EnvironmentLight() = default;
    /// The scene's environment must outlive this.
    explicit EnvironmentLight(const scene::Environment& environment);
    /// The same luminance from everywhere, for furnaces.
    explicit EnvironmentLight(float luminance_nit);

    [[nodiscard]] bool black() const noexcept { return !lit_; }
    /// cd/m^2 from the unit direction.
    [[nodiscard]] glm::vec3 luminance_nit(const glm::vec3& direction) const;
    [[nodiscard]] DirectionSample sample(const glm::vec2& u) const;
    /// Density of sample() in 1/sr.
    [[nodiscard]] float pdf(const glm::vec3& direction) const;

  private:
    [[nodiscard]] float cell_pdf(const glm::ivec2& cell) const;

    const scene::Environment* environment_ = nullptr;
    bake::EnvironmentDistribution distribution_;
    glm::ivec2 size_{0};   ///< of the environment in texels
    glm::ivec2 cells_{0};  ///< of the distribution
    float constant_nit_ = 0.0f;
    bool lit_ = false;
};

}  // namespace candela::truth
