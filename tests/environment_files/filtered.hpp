#pragma once

#include "candela/scene/cube_map.hpp"
#include "sky_of_directions.hpp"

/// A filtered environment whose every value is known.
namespace candela::test {

inline constexpr float kNitPerUnit = 100.0f;

/// What level `level` of `filtered()` holds in a direction, in cd/m^2.
inline glm::vec3 specular_nit(const glm::vec3& d, std::uint32_t level) {
    return kNitPerUnit * float(level + 1) * colorful(d);
}

/// Irradiance over pi in cd/m^2: every term of the harmonics has its own share.
inline glm::vec3 irradiance_over_pi_nit(const glm::vec3& n) {
    return kNitPerUnit *
           (glm::vec3(4.0f) + n.y * glm::vec3(0.5f, 0, 0) + n.z * glm::vec3(0, 0.75f, 0) +
            n.x * glm::vec3(0, 0, 1.0f) + n.x * n.y * glm::vec3(0.25f, 0.5f, 0) +
            n.y * n.z * glm::vec3(0, 0.25f, 0.5f) + (3.0f * n.z * n.z - 1.0f) * glm::vec3(0.125f, 0.25f, 0) +
            n.x * n.z * glm::vec3(0.5f, 0, 0.25f) + (n.x * n.x - n.y * n.y) * glm::vec3(0.25f, 0.125f, 0.5f));
}

inline scene::FilteredEnvironment filtered(scene::RoughnessMapping mapping, std::uint32_t size,
                                           std::uint32_t levels) {
    scene::FilteredEnvironment out;
    out.mapping = mapping;
    out.nit_per_unit = kNitPerUnit;
    for (std::uint32_t level = 0; level < levels; ++level)
        out.specular.push_back(
            {size >> level, faces_of([&](const glm::vec3& d) { return specular_nit(d, level) / kNitPerUnit; },
                                     size >> level)});
    out.irradiance = {
        8, faces_of([](const glm::vec3& d) { return irradiance_over_pi_nit(d) / kNitPerUnit; }, 8)};
    // Each polynomial over the constant that makes the harmonic orthonormal.
    const double pi = std::numbers::pi;
    const double k0 = std::sqrt(1 / (4 * pi)), k1 = std::sqrt(3 / (4 * pi)), k2 = std::sqrt(15 / (4 * pi)),
                 k20 = std::sqrt(5 / (16 * pi)), k22 = std::sqrt(15 / (16 * pi));
    const auto over = [](const glm::vec3& v, double k) { return glm::vec3(glm::dvec3(v) / k); };
    out.irradiance_sh = {
        over({4, 4, 4}, k0),           over({0.5f, 0, 0}, k1),     over({0, 0.75f, 0}, k1),
        over({0, 0, 1}, k1),           over({0.25f, 0.5f, 0}, k2), over({0, 0.25f, 0.5f}, k2),
        over({0.125f, 0.25f, 0}, k20), over({0.5f, 0, 0.25f}, k2), over({0.25f, 0.125f, 0.5f}, k22)};
    // Radiance is what the clamped cosine has not yet convolved.
    for (std::size_t i = 0; i < 9; ++i)
        out.radiance_sh[i] = out.irradiance_sh[i] * (i == 0 ? 1.0f : i < 4 ? 1.5f : 4.0f);
    return out;
}

}  // namespace candela::test
