#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "candela/scene/diagnostics.hpp"
#include "candela/scene/scene.hpp"

namespace candela::io {

/// The whole file. Throws Error (Fault::input) when missing, a folder, unreadable or larger than max_bytes.
[[nodiscard]] std::vector<std::byte> read_file(const std::filesystem::path& file, std::size_t max_bytes);

/// Whether the content is PNG, JPEG or WebP, by how it begins.
[[nodiscard]] bool is_display_picture(std::span<const std::byte> bytes);

/// Decodes PNG, JPEG or WebP (by content) to RGBA8. The header is checked before memory is taken: more than
/// 16384 on a side or more than 2^28 texels is an Error, as is truncated data. `where` names the source in
/// messages.
[[nodiscard]] scene::Image decode_image(std::span<const std::byte> bytes, const std::string& where);

/// What decode_image will take for these bytes, by their header alone; 0 where that is broken.
[[nodiscard]] std::uint64_t decoded_bytes(std::span<const std::byte> bytes);

/// A layer picture as written by write_exr, or any EXR: 32 bit float channels by full name ("R", "albedo.R").
struct FloatImage {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::string> channels;
    std::vector<std::vector<float>> data;  ///< one plane per channel, width * height, row 0 on top
    [[nodiscard]] const std::vector<float>* find(const std::string& channel) const;
};
[[nodiscard]] FloatImage read_exr(const std::filesystem::path& file);

}  // namespace candela::io
