#pragma once

#include <tbb/parallel_for.h>

#include <vector>

#include "candela/truth/camera_rays.hpp"
#include "candela/truth/path_integrator.hpp"
#include "common/scenes.hpp"

namespace candela::test {

inline shading::BsdfTechniques best() {
    return shading::techniques_best();
}

inline truth::PathOptions path_options(bool direct_only = false, bool furnace = false) {
    truth::PathOptions o;
    o.techniques = best();
    o.direct_only = direct_only;
    o.furnace = furnace;
    return o;
}

/// Mean luminance of a square picture of side * side pixels, `samples` paths each, that a camera sees.
inline glm::dvec3 mean_luminance(const scene::Scene& scene, const scene::Camera& camera,
                                 const truth::PathOptions& options, std::uint32_t samples = 4096,
                                 std::uint32_t side = 8) {
    const truth::PathIntegrator integrator(scene, options);
    const truth::CameraRays rays(camera, side, side);
    std::vector<glm::dvec3> rows(side, glm::dvec3(0.0));
    tbb::parallel_for(0u, side, [&](std::uint32_t y) {
        for (std::uint32_t x = 0; x < side; ++x) {
            for (std::uint32_t i = 0; i < samples; ++i) {
                const truth::PathSampler sampler({x, y}, i, 7);
                rows[y] += glm::dvec3(
                    integrator
                        .trace(rays.through(glm::vec2(x, y) + sampler.pixel(), glm::vec2(0.5f)), sampler)
                        .luminance_nit);
            }
        }
    });
    glm::dvec3 sum(0.0);
    for (const glm::dvec3& row : rows) sum += row;
    return sum / (static_cast<double>(side) * side * samples);
}

/// Looks straight down at a spot of a few millimetres about the origin.
inline scene::Camera spot_meter(const glm::vec3& from = {0.0f, 3.0f, 0.0f},
                                const glm::vec3& at = glm::vec3(0.0f)) {
    return scene::look_at(from, at, 0.001f);
}

/// Adds a primitive as an instance with a material of its own.
inline void place(scene::Scene& s, scene::Primitive p, scene::Material m,
                  const glm::mat4& world = glm::mat4(1.0f)) {
    p.material = static_cast<std::uint32_t>(s.materials.size());
    s.materials.push_back(std::move(m));
    s.meshes.push_back({"mesh", {std::move(p)}});
    s.instances.push_back({"instance", static_cast<std::uint32_t>(s.meshes.size() - 1), world});
}

inline scene::Material lamp(float luminance_nit) {
    scene::Material m = grey(0.0f);
    m.emissive_nit = glm::vec3(luminance_nit);
    return m;
}

/// A square of side 2 * half_m about `center`, whose front looks along +Y (up) or -Y.
inline scene::Primitive flat_square(float half_m, const glm::vec3& center, bool up) {
    scene::Primitive p;
    const float turn = up ? -1.0f : 1.0f;
    for (const auto& [x, z] : {std::pair{-1.0f, -1.0f}, {1.0f, -1.0f}, {1.0f, 1.0f}, {-1.0f, 1.0f}}) {
        p.positions.push_back(center + half_m * glm::vec3(x, 0.0f, turn * z));
        p.normals.emplace_back(0.0f, up ? 1.0f : -1.0f, 0.0f);
        p.bounds.extend(p.positions.back());
    }
    p.indices = {0, 1, 2, 0, 2, 3};
    p.material = 0;
    return p;
}

}  // namespace candela::test
