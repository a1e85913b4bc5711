#include "candela/scene/shared_primitives.hpp"

#include <cmath>
#include <glm/matrix.hpp>
#include <map>

namespace candela::scene {
namespace {

/// Fewer copied triangles of a primitive are not worth a tree of their own.
constexpr std::size_t kFewTriangles = 256;

bool invertible(const glm::mat4& world) {
    const glm::dmat4 inverse = glm::inverse(glm::dmat4(world));
    for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 4; ++r) {
            if (!std::isfinite(static_cast<float>(inverse[c][r]))) return false;
        }
    }
    return glm::determinant(glm::dmat3(world)) != 0.0;
}

}  // namespace

std::set<const Primitive*> shared_primitives(const Scene& scene, std::size_t max_copied_triangles) {
    std::map<std::uint32_t, std::size_t> uses;
    std::set<std::uint32_t> flat;
    for (const Instance& instance : scene.instances) {
        ++uses[instance.mesh];
        if (!invertible(instance.world)) flat.insert(instance.mesh);
    }
    std::set<const Primitive*> out;
    std::size_t copied = 0;
    for (const auto& [mesh, count] : uses) {
        for (const Primitive& p : scene.meshes[mesh].primitives) {
            const std::size_t copies = (count - 1) * (p.indices.size() / 3);
            copied += copies;
            if (copies >= kFewTriangles && !flat.contains(mesh)) out.insert(&p);
        }
    }
    if (copied <= max_copied_triangles) out.clear();
    return out;
}

std::size_t stored_triangles(const Scene& scene, const std::set<const Primitive*>& shared) {
    std::size_t count = 0;
    for (const Instance& instance : scene.instances) {
        for (const Primitive& p : scene.meshes[instance.mesh].primitives) {
            if (!shared.contains(&p)) count += p.indices.size() / 3;
        }
    }
    for (const Primitive* p : shared) count += p->indices.size() / 3;
    return count;
}

}  // namespace candela::scene
