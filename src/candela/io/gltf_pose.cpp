#include "candela/io/gltf_pose.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace candela::io {
namespace {

void morph(const SourcePrimitive& source, const std::vector<float>& weights, scene::Primitive& p) {
    for (std::size_t t = 0; t < source.targets.size() && t < weights.size(); ++t) {
        if (weights[t] == 0.0f) continue;
        const SourcePrimitive::MorphTarget& target = source.targets[t];
        for (std::size_t i = 0; i < target.positions.size(); ++i)
            p.positions[i] += weights[t] * target.positions[i];
        if (!p.normals.empty()) {
            for (std::size_t i = 0; i < target.normals.size(); ++i)
                p.normals[i] += weights[t] * target.normals[i];
        }
        if (!p.tangents.empty()) {
            for (std::size_t i = 0; i < target.tangents.size(); ++i) {
                p.tangents[i] += glm::vec4(weights[t] * target.tangents[i], 0.0f);
            }
        }
    }
}

/// Joints that the skin does not have are left out; the weights of the others add up to 1.
glm::dmat4 joint_of_vertex(const SourcePrimitive& source, std::size_t vertex,
                           const std::vector<glm::dmat4>& joints) {
    glm::dmat4 sum(0.0);
    double weights = 0.0;
    for (const SourcePrimitive::Influences& set : source.influences) {
        for (std::size_t c = 0; c < 4; ++c) {
            const std::size_t joint = set.joints[vertex][c];
            const double weight = set.weights[vertex][static_cast<int>(c)];
            if (weight == 0.0 || joint >= joints.size()) continue;
            sum += weight * joints[joint];
            weights += weight;
        }
    }
    return weights > 0.0 ? sum / weights : joints.front();
}

void skin(const SourcePrimitive& source, const std::vector<glm::dmat4>& joints, scene::Primitive& p) {
    if (source.influences.empty()) return;
    for (std::size_t i = 0; i < p.positions.size(); ++i) {
        const glm::dmat4 exact = joint_of_vertex(source, i, joints);
        p.positions[i] = glm::vec3(exact * glm::dvec4(p.positions[i], 1.0));
        const glm::mat4 m(exact);
        if (!p.normals.empty()) {
            // Cofactors transform normals under any scale, mirrored or singular.
            const glm::mat3 a(m);
            const glm::mat3 cofactors(glm::cross(a[1], a[2]), glm::cross(a[2], a[0]), glm::cross(a[0], a[1]));
            p.normals[i] = cofactors * p.normals[i];
        }
        if (!p.tangents.empty())
            p.tangents[i] = glm::vec4(glm::mat3(m) * glm::vec3(p.tangents[i]), p.tangents[i].w);
    }
}

void normalize(scene::Primitive& p) {
    for (glm::vec3& n : p.normals) {
        const float length = glm::length(n);
        n = length > 1e-20f && std::isfinite(length) ? n / length : glm::vec3(0, 0, 1);
    }
    for (glm::vec4& t : p.tangents) {
        const float length = glm::length(glm::vec3(t));
        const glm::vec3 unit =
            length > 1e-20f && std::isfinite(length) ? glm::vec3(t) / length : glm::vec3(1, 0, 0);
        t = glm::vec4(unit, t.w < 0.0f ? -1.0f : 1.0f);
    }
}

}  // namespace

scene::Primitive pose(const SourcePrimitive& source, const std::vector<float>& weights,
                      const std::vector<glm::dmat4>& joints) {
    scene::Primitive p = source.primitive;
    p.bounds = {};  // of the vertices as they are in the file
    morph(source, weights, p);
    if (!joints.empty()) skin(source, joints, p);
    normalize(p);
    return p;
}

}  // namespace candela::io
