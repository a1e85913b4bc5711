#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>

#include "candela/io/gltf.hpp"
#include "candela/io/gltf_mesh.hpp"

namespace candela::io {

struct Node {
    std::string name;
    std::vector<std::uint32_t> children;
    glm::dvec3 translation{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 scale{1.0};
    std::optional<glm::dmat4> matrix;  ///< instead of the three, unless animated
    std::vector<float> weights;        ///< of morph targets; empty: the mesh's
    /// To the world, in double: far from the origin single precision has steps of decimetres.
    glm::dmat4 placed{1.0};
    glm::mat4 world{1.0f};   ///< the same about the scene's own origin (scene::WorldFrame)
    bool reachable = false;  ///< from the scene's roots
};

/// Reads every node and poses it at the options' time by one animation; each node has one parent then.
/// `world` is still about the world's origin. Throws Error for cycles and an animation that is not there.
[[nodiscard]] std::vector<Node> read_posed_nodes(const GltfDocument& document, const GltfOptions& options);

/// Moves the nodes as the animation that the options name does at their time.
void animate(const GltfDocument& document, const GltfOptions& options, std::vector<Node>& nodes);

/// Joint matrices of a skin, to the world.
[[nodiscard]] std::vector<glm::dmat4> joint_matrices(const GltfDocument& document, std::uint32_t skin,
                                                     const std::vector<Node>& nodes);

/// Geometry after morphing by `weights` and skinning by `joints` (empty: not skinned; else the result is
/// where the joints lead to).
[[nodiscard]] scene::Primitive pose(const SourcePrimitive& source, const std::vector<float>& weights,
                                    const std::vector<glm::dmat4>& joints);

}  // namespace candela::io
