#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "candela/scene/environment_resample.hpp"
#include "candela/scene/memory_budget.hpp"

/// The finest level of a texture file that holds light: one picture, or the six of a cube.
namespace candela::io::detail {

struct TextureFile {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t faces = 1;                ///< 1 or 6, and then width is height
    std::vector<glm::vec3> texels;          ///< face after face, in cd/m^2; what the file says, NaN and all
    std::optional<scene::CubeSpace> space;  ///< when the file says it
    bool absolute = false;                  ///< the file says what a value is in cd/m^2
};

[[nodiscard]] bool is_ktx2(std::span<const std::byte> bytes) noexcept;
[[nodiscard]] bool is_dds(std::span<const std::byte> bytes) noexcept;

/// RGBA16F, RGBA32F, E5B9G9R9 and B10G11R11; plain or compressed with zlib or Zstandard. Throws Error
/// (Fault::input), before memory is taken for what the bytes cannot hold.
[[nodiscard]] TextureFile decode_ktx2(std::span<const std::byte> bytes, const std::string& where,
                                      const std::optional<scene::MemoryBudget>& memory = {});

/// The DX10 header with those formats, or the legacy codes 113 (RGBA16F) and 116 (RGBA32F).
[[nodiscard]] TextureFile decode_dds(std::span<const std::byte> bytes, const std::string& where,
                                     const std::optional<scene::MemoryBudget>& memory = {});

/// Formats of both files.
enum class LightFormat : std::uint8_t { rgba16f, rgba32f, rgb32f, rgb9e5, b10g11r11 };
[[nodiscard]] std::uint32_t texel_bytes(LightFormat format) noexcept;
/// `bytes` is a multiple of texel_bytes.
void append_texels(std::span<const std::byte> bytes, LightFormat format, std::vector<glm::vec3>& texels);

}  // namespace candela::io::detail
