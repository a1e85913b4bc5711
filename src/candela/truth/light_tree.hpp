#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>

#include "candela/scene/scene.hpp"

namespace candela::truth {

/// Where one light is, which way it shines and how much: what decides how often it is drawn.
struct LightBounds {
    scene::Aabb box;
    glm::vec3 axis{0.0f, 0.0f, 1.0f};  ///< unit
    float cos_normals = 1.0f;          ///< normals lie within this of the axis; -1: everywhere
    float cos_emission = 0.0f;         ///< light leaves a normal within this
    float power = 0.0f;                ///< any unit that is the same for all lights
    bool two_sided = false;
    scene::Aabb reach = everywhere();  ///< outside of it nothing arrives: the windows of ranges

    [[nodiscard]] static scene::Aabb everywhere() {
        constexpr float infinity = std::numeric_limits<float>::infinity();
        return {glm::vec3(-infinity), glm::vec3(infinity)};
    }
};

/// Draws one of many lights in proportion to an estimate of what it gives at a point: a binary tree of
/// bounds, Conty Estevez & Kulla 2018 ("Importance Sampling of Many Lights with Adaptive Tree Splitting"),
/// without the splitting.
class LightTree {
  public:
    LightTree() = default;
    explicit LightTree(const std::vector<LightBounds>& lights);

    struct Choice {
        std::uint32_t light = 0;
        float probability = 0.0f;  ///< 0: no light reaches this point
    };
    /// u in [0,1) is used up and comes back as a new number in [0,1). normal: unit, of the receiver.
    [[nodiscard]] Choice sample(const glm::vec3& point, const glm::vec3& normal, float& u) const;
    /// Probability that sample() draws this light.
    [[nodiscard]] float probability(const glm::vec3& point, const glm::vec3& normal,
                                    std::uint32_t light) const;

  private:
    struct Node {
        LightBounds bounds;
        std::uint32_t second_child = 0;  ///< the first one follows its parent; 0: a leaf
        std::uint32_t parent = 0;
        std::uint32_t light = 0;
    };
    std::uint32_t build(std::vector<std::uint32_t>& order, std::size_t begin, std::size_t end,
                        std::uint32_t parent, const std::vector<LightBounds>& lights);

    std::vector<Node> nodes_;
    std::vector<std::uint32_t> leaf_of_;
};

}  // namespace candela::truth
