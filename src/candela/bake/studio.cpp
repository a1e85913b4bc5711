#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "candela/bake/environment.hpp"
#include "shading/environment.glsl"

namespace candela::bake {
namespace {

/// A rectangular softbox on the sphere: seen from the origin it spans width x height, centred on `toward`.
struct Softbox {
    glm::vec3 toward;
    float half_width;   // tangent of the half angle
    float half_height;  // tangent of the half angle
    float luminance_nit;
};

/// Share of the softbox in a direction: 1 inside, falling to 0 over the last tenth towards its cloth's edge.
float coverage(const Softbox& box, const glm::vec3& direction) {
    const glm::vec3 axis = glm::normalize(box.toward);
    const float depth = glm::dot(direction, axis);
    if (depth <= 0.0f) return 0.0f;
    const glm::vec3 right = glm::normalize(glm::cross(glm::vec3(0.0f, 1.0f, 0.001f), axis));
    const glm::vec3 up = glm::cross(axis, right);
    const float x = std::abs(glm::dot(direction, right)) / (depth * box.half_width);
    const float y = std::abs(glm::dot(direction, up)) / (depth * box.half_height);
    return (1.0f - shading::smoothstep(0.9f, 1.0f, x)) * (1.0f - shading::smoothstep(0.9f, 1.0f, y));
}

}  // namespace

scene::Environment studio_environment() {
    // Key from the left, fill from the right, a strip from behind, a large soft one overhead; luminances of
    // real studio softboxes with modelling lamps.
    const Softbox boxes[] = {{{-1.0f, 0.7f, 0.8f}, 0.45f, 0.60f, 3200.0f},
                             {{1.0f, 0.35f, 0.9f}, 0.55f, 0.55f, 900.0f},
                             {{0.5f, 0.6f, -1.0f}, 0.20f, 0.70f, 2600.0f},
                             {{0.0f, 1.0f, 0.15f}, 0.70f, 0.50f, 1500.0f}};
    constexpr float wall_nit = 330.0f;
    constexpr float floor_nit = 200.0f;
    scene::Environment e;
    e.name = "studio";
    e.width = 512;
    e.height = 256;
    e.luminance_nit.resize(std::size_t{e.width} * e.height);
    for (std::uint32_t y = 0; y < e.height; ++y) {
        for (std::uint32_t x = 0; x < e.width; ++x) {
            const glm::vec3 d =
                shading::equirect_direction({(static_cast<float>(x) + 0.5f) / static_cast<float>(e.width),
                                             (static_cast<float>(y) + 0.5f) / static_cast<float>(e.height)});
            float nit = glm::mix(floor_nit, wall_nit, shading::smoothstep(-0.5f, 0.6f, d.y));
            for (const Softbox& box : boxes) nit = glm::mix(nit, box.luminance_nit, coverage(box, d));
            e.luminance_nit[std::size_t{y} * e.width + x] = glm::vec3(nit);
        }
    }
    return e;
}

scene::Environment constant_environment(float luminance_nit) {
    scene::Environment e;
    e.name = "constant";
    e.width = 32;
    e.height = 16;
    e.luminance_nit.assign(std::size_t{e.width} * e.height, glm::vec3(luminance_nit));
    return e;
}

}  // namespace candela::bake
