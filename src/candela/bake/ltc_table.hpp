#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "candela/gpu/commands.hpp"

/// The matrices of shading/lights/ltc.glsl, fitted by `candela bake ltc` and embedded in the library.
namespace candela::bake {

/// Of the meaning of a texel; a file of another version is not read.
constexpr std::uint32_t kLtcVersion = 1;

struct LtcTable {
    /// kLtcSize rows of kLtcSize, at dfg_parameters(x, y), as ltc_inverse_matrix takes them.
    std::vector<glm::vec4> texels;
    /// Of each, half the integral of |lobe - fit| over the hemisphere: no light of uniform luminance is
    /// further off, in shares of the lobe.
    std::vector<float> errors;

    /// Bilinear, as a sampler reads it. Both in [0,1].
    [[nodiscard]] glm::vec4 read(float NoV, float perceptual_roughness) const;
};

/// The one that is embedded.
[[nodiscard]] const LtcTable& ltc_table();

/// As a file: "CLTC", version, size (32 bits each), then the texels and the errors as 32-bit floats, all
/// little-endian.
[[nodiscard]] std::string encode_ltc_table(const LtcTable& table);
/// Throws Error (Fault::input) for what is not such a file; `where` names it.
[[nodiscard]] LtcTable decode_ltc_table(std::string_view bytes, const std::string& where);

/// The embedded table, kLtcSize x kLtcSize, RGBA32F, for a linear sampler and ltc_uv.
[[nodiscard]] gpu::Image create_ltc_table(const gpu::Device& device, gpu::Commands& commands);

}  // namespace candela::bake
