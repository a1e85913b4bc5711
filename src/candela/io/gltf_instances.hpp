#pragma once

#include <glm/mat4x4.hpp>
#include <optional>
#include <vector>

#include "candela/io/gltf_accessor.hpp"

namespace candela::io {

/// Transforms of EXT_mesh_gpu_instancing, relative to the node: translation after rotation after scale, each
/// absent or an accessor of one row an instance. nullopt where the node has no such extension, or one without
/// attributes. Transforms that are not finite are left out with a warning.
[[nodiscard]] std::optional<std::vector<glm::dmat4>> read_gpu_instances(const GltfDocument& document,
                                                                        const JsonView& node,
                                                                        Diagnostics& diagnostics);

}  // namespace candela::io
