#pragma once

#include <cstdint>
#include <functional>

namespace candela::realtime {

/// The alpha channel of a level, read with texels wrapping around.
struct AlphaTexels {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::function<float(std::size_t)> at;  ///< of texel y * width + x, in [0,1]
};

/// Part in [0,1] of the level where its bilinear alpha reaches the cutoff.
[[nodiscard]] float coverage(const AlphaTexels& level, float cutoff);

/// The factor on alpha, >= 0, that makes coverage() as near to `wanted` as the level's texels allow.
[[nodiscard]] float alpha_scale_for_coverage(const AlphaTexels& level, float cutoff, float wanted);

}  // namespace candela::realtime
