#pragma once

#include "candela/scene/scene.hpp"
#include "shading/probes/volume.glsl"

namespace candela::test {

/// Adds a reflection probe and an irradiance volume that see the same luminance everywhere.
inline void add_constant_probes(scene::Scene& s, float nit) {
    scene::ReflectionProbe reflection;
    reflection.half_size_m = glm::vec3(200.0f);
    reflection.capture.size = 16;
    for (std::uint32_t size = 16; size >= 4; size /= 2) {
        reflection.capture.levels.emplace_back(std::size_t{size} * size, glm::vec4(glm::vec3(nit), 1.0f));
    }
    s.reflection_probes = {reflection};
    scene::IrradianceVolume volume;
    volume.half_size_m = glm::vec3(200.0f);
    volume.cells = glm::ivec3(2);
    scene::IrradianceProbe probe;
    probe.irradiance_sh[0] = glm::vec3(nit / 0.282094792f);
    probe.distances.assign(std::size_t(shading::kDistanceSize) * shading::kDistanceSize,
                           glm::vec2(1000.0f, 1.0e6f));
    probe.valid = true;
    volume.probes.assign(volume.probe_count(), probe);
    s.irradiance_volumes = {volume};
}

}  // namespace candela::test
