#pragma once

#include <cmath>

#include "candela/scene/scene.hpp"
#include "shading/environment.glsl"

namespace candela::tests {

/// A picture of a function of direction.
template <class Luminance>
scene::Environment environment_of(std::uint32_t width, const Luminance& luminance) {
    scene::Environment e;
    e.width = width;
    e.height = width / 2;
    for (std::uint32_t y = 0; y < e.height; ++y) {
        for (std::uint32_t x = 0; x < e.width; ++x)
            e.luminance_nit.push_back(luminance(shading::equirect_direction(
                {(static_cast<float>(x) + 0.5f) / static_cast<float>(e.width),
                 (static_cast<float>(y) + 0.5f) / static_cast<float>(e.height)})));
    }
    return e;
}

/// A blue sky that brightens towards the horizon over a dim ground.
inline scene::Environment sky(std::uint32_t width) {
    return environment_of(width, [](const glm::vec3& d) {
        const float horizon = 1.0f - std::abs(d.y);
        return d.y > 0.0f ? glm::vec3(1200.0f, 2000.0f, 4000.0f) * (0.3f + horizon)
                          : glm::vec3(180.0f, 160.0f, 120.0f);
    });
}

/// One texel as bright as the sun's disc in a dim sky.
inline scene::Environment one_texel_sun(std::uint32_t width, float row, float column) {
    scene::Environment e = environment_of(width, [](const glm::vec3&) { return glm::vec3(2.0f); });
    const auto x = static_cast<std::size_t>(column * static_cast<float>(e.width));
    const auto y = static_cast<std::size_t>(row * static_cast<float>(e.height));
    e.luminance_nit[y * e.width + x] = glm::vec3(1.6e9f);
    return e;
}

/// Softboxes of hard edges in a dark room: contrasts of thousands without a peak.
inline scene::Environment dark_studio(std::uint32_t width) {
    return environment_of(width, [](const glm::vec3& d) {
        if (d.x > 0.8f) return glm::vec3(3000.0f, 2700.0f, 2400.0f);
        if (d.y > 0.6f && d.z < -0.3f) return glm::vec3(900.0f, 1000.0f, 1200.0f);
        return glm::vec3(1.0f, 1.2f, 1.5f);
    });
}

/// Sum of radiance times solid angle in cd/m^2 sr.
inline glm::dvec3 energy(const scene::Environment& e) {
    glm::dvec3 sum(0.0);
    for (std::uint32_t y = 0; y < e.height; ++y) {
        for (std::uint32_t x = 0; x < e.width; ++x)
            sum += glm::dvec3(e.luminance_nit[std::size_t{y} * e.width + x]) *
                   double(shading::equirect_texel_solid_angle(y, e.width, e.height));
    }
    return sum * double(e.scale);
}

}  // namespace candela::tests
