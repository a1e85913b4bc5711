#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "candela/scene/scene.hpp"
#include "candela/truth/light_sample.hpp"

namespace candela::truth {

/// The directional lights and suns of a scene, which must outlive it.
class DistantLights {
  public:
    DistantLights() = default;
    explicit DistantLights(const scene::Scene& scene);

    [[nodiscard]] bool empty() const noexcept { return lights_.empty(); }
    [[nodiscard]] bool any_suns() const noexcept { return any_suns_; }

    /// One of them in proportion to what it gives. choice and u in [0,1).
    [[nodiscard]] LightSample sample(const glm::vec3& normal, float choice, const glm::vec2& u) const;

    /// Calls visit(light, luminance, density in 1/sr with which sample() draws it) for each sun in a unit
    /// direction.
    template <class Visit>
    void each_sun(const glm::vec3& direction, const glm::vec3& normal, const Visit& visit) const {
        if (!any_suns_) return;
        for (const scene::Light* light : lights_) {
            if (meets(*light, direction))
                visit(*light, luminance_nit(*light, direction), pdf(*light, normal));
        }
    }

  private:
    [[nodiscard]] static bool meets(const scene::Light& light, const glm::vec3& direction);
    [[nodiscard]] static glm::vec3 luminance_nit(const scene::Light& light, const glm::vec3& direction);
    [[nodiscard]] float pdf(const scene::Light& light, const glm::vec3& normal) const;

    std::vector<const scene::Light*> lights_;
    bool any_suns_ = false;
};

}  // namespace candela::truth
