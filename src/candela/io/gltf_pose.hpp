#pragma once

#include <glm/gtc/quaternion.hpp>

#include "candela/io/gltf_mesh.hpp"

namespace candela::io {

struct Node {
    std::string name;
    std::vector<std::uint32_t> children;
    glm::vec3 translation{0.0f};
    glm::quat rotation{1.0f, 0.0f, 0.0f, 0.0f};
    glm::vec3 scale{1.0f};
    std::optional<glm::mat4> matrix;  ///< instead of the three, unless animated
    std::vector<float> weights;       ///< of morph targets; empty: the mesh's
    glm::mat4 world{1.0f};
    bool reachable = false;  ///< from the scene's roots
};

/// Reads every node, checks that the hierarchy is a forest (no cycles, one parent each), and poses it at
/// `time_s`.
[[nodiscard]] std::vector<Node> read_posed_nodes(const GltfDocument& document, float time_s,
                                                 Diagnostics& diagnostics);

/// Joint matrices of a skin, in world space.
[[nodiscard]] std::vector<glm::mat4> joint_matrices(const GltfDocument& document, std::uint32_t skin,
                                                    const std::vector<Node>& nodes);

/// Geometry after morphing by `weights` and skinning by `joints` (empty: not skinned; else the result is in
/// world space).
[[nodiscard]] scene::Primitive pose(const SourcePrimitive& source, const std::vector<float>& weights,
                                    const std::vector<glm::mat4>& joints);

}  // namespace candela::io
