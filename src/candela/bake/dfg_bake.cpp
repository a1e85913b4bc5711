#include "candela/bake/dfg_bake.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <mutex>

#include "shading/dfg.glsl"

namespace candela::bake {

glm::vec4 dfg_entry(DfgVisibility visibility, float NoV, float perceptual_roughness,
                    std::uint32_t sample_count) {
    if (visibility == DfgVisibility::schlick_smith)
        return shading::integrate_dfg_ue4(NoV, perceptual_roughness, sample_count);
    if (visibility == DfgVisibility::smith_correlated)
        return shading::integrate_dfg(NoV, perceptual_roughness, sample_count);
    const glm::vec2 specular =
        shading::integrate_ggx_albedo_uncorrelated(NoV, perceptual_roughness, sample_count);
    return {specular.x, specular.y, shading::albedo_DisneyRenormalized(NoV, perceptual_roughness),
            shading::integrate_sheen_albedo(NoV, perceptual_roughness, sample_count)};
}

DfgTable bake_dfg(DfgVisibility visibility, std::uint32_t size, std::uint32_t sample_count,
                  const ProgressFunction& progress) {
    DfgTable table;
    table.size = size;
    table.texels.resize(std::size_t{size} * size);
    std::mutex counting;
    std::uint32_t rows = 0;
    tbb::parallel_for(0u, size, [&](std::uint32_t y) {
        for (std::uint32_t x = 0; x < size; ++x) {
            const float root = static_cast<float>(x) / static_cast<float>(size - 1);
            table.texels[std::size_t{y} * size + x] = dfg_entry(
                visibility, root * root, static_cast<float>(y) / static_cast<float>(size - 1), sample_count);
        }
        if (!progress) return;
        const std::lock_guard lock(counting);
        progress(double(++rows) / size);
    });
    return table;
}

glm::vec4 DfgTable::read(float NoV, float perceptual_roughness) const {
    const auto last = static_cast<float>(size - 1);
    const float x = std::sqrt(std::clamp(NoV, 0.0f, 1.0f)) * last;
    const float y = std::clamp(perceptual_roughness, 0.0f, 1.0f) * last;
    const auto left = std::min(static_cast<std::uint32_t>(x), size - 2);
    const auto top = std::min(static_cast<std::uint32_t>(y), size - 2);
    const glm::vec4* row = texels.data() + std::size_t{top} * size + left;
    const float fx = x - static_cast<float>(left);
    const float fy = y - static_cast<float>(top);
    return glm::mix(glm::mix(row[0], row[1], fx), glm::mix(row[size], row[size + 1], fx), fy);
}

}  // namespace candela::bake
