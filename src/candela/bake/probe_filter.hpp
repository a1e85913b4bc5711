#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "candela/gpu/commands.hpp"
#include "candela/scene/scene.hpp"

namespace candela::bake {

/// What a reflection probe sees, as six square pictures along the world's axes. rgb: cd/m^2, black where
/// there is only sky; a: 1 where there is more than sky. Row 0 on top.
struct ProbeFaces {
    std::uint32_t size = 0;
    std::array<std::vector<glm::vec4>, 6> faces;
};

/// The camera whose picture is a face of a probe that stands at `position`.
[[nodiscard]] scene::Camera probe_camera(std::size_t face, const glm::vec3& position);

/// The value in a unit direction, bilinear within a face.
[[nodiscard]] glm::vec4 read_faces(const ProbeFaces& faces, const glm::vec3& direction);

/// Irradiance / pi, and the part of the cosine lobe that meets something, as scene::ProbeCapture has them.
[[nodiscard]] std::array<glm::vec4, 9> probe_irradiance_sh(const ProbeFaces& faces);

/// Filters a probe's picture by the filter of environments, colour and visibility alike.
[[nodiscard]] scene::ProbeCapture filter_probe(const gpu::Device& device, gpu::Commands& commands,
                                               const ProbeFaces& faces);

}  // namespace candela::bake
