#include "candela/realtime/blend_order.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

namespace candela::realtime {

BlendOrder::BlendOrder(const gpu::Device& device, const GpuScene& scene) {
    std::uint32_t count = 0;
    for (const Draw& draw : scene.draws) {
        if (!draw.blended) continue;
        draws_.push_back({draw.blended_surface, draw});
        draws_.back().draw.first_index = count;
        count += draw.index_count;
    }
    if (draws_.empty()) return;
    indices_ = gpu::Buffer(device, count * sizeof(std::uint32_t), VK_BUFFER_USAGE_INDEX_BUFFER_BIT,
                           gpu::MemoryKind::upload);
}

void BlendOrder::sort(const GpuScene& scene, const glm::vec3& eye, const glm::vec3& backward) {
    if (!order_.empty() && eye == eye_ && backward == backward_) return;
    eye_ = eye;
    backward_ = backward;
    order_.clear();
    for (const Surface& surface : draws_) {
        order_.push_back(&surface.draw);
        sort_triangles(scene, surface, backward);
    }
    // The farthest has the smallest coordinate towards the viewer.
    const auto towards_viewer = [&](const Draw* draw) {
        return glm::dot(draw->world_center - eye, backward);
    };
    std::stable_sort(order_.begin(), order_.end(),
                     [&](const Draw* a, const Draw* b) { return towards_viewer(a) < towards_viewer(b); });
}

void BlendOrder::sort_triangles(const GpuScene& scene, const Surface& surface, const glm::vec3& backward) {
    const BlendedSurface& source = scene.blended_surfaces[surface.source];
    const glm::vec3 backward_in_object = glm::transpose(glm::mat3(surface.draw.world)) * backward;
    keys_.clear();
    for (std::uint32_t i = 0; i < source.centroids.size(); ++i) {
        keys_.emplace_back(glm::dot(source.centroids[i], backward_in_object), i);
    }
    std::sort(keys_.begin(), keys_.end());
    std::uint32_t* out = indices_.mapped_as<std::uint32_t>().data() + surface.draw.first_index;
    for (const auto& [key, triangle] : keys_) {
        out = std::copy_n(source.indices.begin() + std::ptrdiff_t{3} * triangle, 3, out);
    }
}

}  // namespace candela::realtime
