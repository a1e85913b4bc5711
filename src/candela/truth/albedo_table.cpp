#include "candela/truth/albedo_table.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "shading/dfg.glsl"

namespace candela::truth {

AlbedoTable::AlbedoTable(bool ue4)
    : texels_(static_cast<std::size_t>(shading::kDfgSize) * static_cast<std::size_t>(shading::kDfgSize)) {
    const auto size = static_cast<std::uint32_t>(shading::kDfgSize);
    tbb::parallel_for(0u, size, [&](std::uint32_t y) {
        for (std::uint32_t x = 0; x < size; ++x) {
            const glm::vec2 p = shading::dfg_parameters(x, y);
            texels_[std::size_t{y} * size + x] =
                ue4 ? shading::integrate_dfg_ue4(p.x, p.y, shading::kDfgSamples)
                    : shading::integrate_dfg(p.x, p.y, shading::kDfgSamples);
        }
    });
}

glm::vec4 AlbedoTable::read(float NoV, float perceptual_roughness) const {
    constexpr int size = shading::kDfgSize;
    const glm::vec2 at = shading::dfg_uv(NoV, perceptual_roughness) * static_cast<float>(size) - 0.5f;
    const int x = std::clamp(static_cast<int>(at.x), 0, size - 2);
    const int y = std::clamp(static_cast<int>(at.y), 0, size - 2);
    const float fx = std::clamp(at.x - static_cast<float>(x), 0.0f, 1.0f);
    const float fy = std::clamp(at.y - static_cast<float>(y), 0.0f, 1.0f);
    const glm::vec4* row = texels_.data() + static_cast<std::ptrdiff_t>(y) * size + x;
    return (row[0] * (1.0f - fx) + row[1] * fx) * (1.0f - fy) +
           (row[size] * (1.0f - fx) + row[size + 1] * fx) * fy;
}

}  // namespace candela::truth
