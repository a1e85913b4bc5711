#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "candela/scene/cube_map.hpp"

/// Cube maps with levels as the bytes of a texture file. Faces and rows are those of scene::CubeMap.
namespace candela::io::detail {

enum class TexelFormat : std::uint8_t { rgba16f, rgba32f, rgb9e5, b10g11r11 };

/// Levels finest first, each half the size of the one before. `keys`: KTXwriter and KTXorientation are added.
[[nodiscard]] std::vector<std::byte> encode_ktx2(std::span<const scene::CubeMap> levels, TexelFormat format,
                                                 std::map<std::string, std::string> keys);

/// KTX 1 of R11F_G11F_B10F, with these keys.
[[nodiscard]] std::vector<std::byte> encode_ktx1(std::span<const scene::CubeMap> levels,
                                                 const std::map<std::string, std::string>& keys);

/// RGBA16F with the DX10 header.
[[nodiscard]] std::vector<std::byte> encode_dds(std::span<const scene::CubeMap> levels);

}  // namespace candela::io::detail
