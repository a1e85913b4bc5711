#pragma once

#include <vector>

#include "candela/realtime/gpu_scene.hpp"

namespace candela::realtime {

/// The triangles of blended surfaces, back to front: draws by the centre of their bounds, and the triangles
/// of each draw by their centroids, so that a double-sided or folded surface covers itself in the right
/// order. Triangles that cross one another have no order and stay approximate.
class BlendOrder {
  public:
    BlendOrder(const gpu::Device& device, const GpuScene& scene);

    /// Sorts for a viewer; free when nothing moved since the last call. The device must not be drawing.
    void sort(const GpuScene& scene, const glm::vec3& eye, const glm::vec3& backward);

    [[nodiscard]] bool empty() const noexcept { return draws_.empty(); }
    [[nodiscard]] const std::vector<const Draw*>& draws() const noexcept { return order_; }
    [[nodiscard]] const gpu::Buffer& indices() const noexcept { return indices_; }

  private:
    struct Surface {
        std::uint32_t source = 0;  ///< into GpuScene::blended_surfaces
        Draw draw;                 ///< its indices lie in indices_
    };
    void sort_triangles(const GpuScene& scene, const Surface& surface, const glm::vec3& backward);

    std::vector<Surface> draws_;
    std::vector<const Draw*> order_;
    gpu::Buffer indices_;
    glm::vec3 eye_{0.0f};
    glm::vec3 backward_{0.0f};
    std::vector<std::pair<float, std::uint32_t>> keys_;
};

}  // namespace candela::realtime
