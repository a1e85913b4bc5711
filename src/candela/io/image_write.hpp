#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "candela/scene/material.hpp"

/// Files are written under a temporary name in the same folder and renamed, so no half picture is ever seen.
namespace candela::io {

enum class PixelType : std::uint8_t { half, float32, uint32 };

/// One channel of an EXR file: full name ("R", "albedo.R", "depth.Z"), row 0 on top.
struct ExrChannel {
    std::string name;
    PixelType type = PixelType::half;
    std::variant<std::span<const float>, std::span<const std::uint32_t>> pixels;
};

/// Header attributes: standard ones (whiteLuminance, aperture, expTime, isoSpeed as float; chromaticities
/// Rec.709 are always written) and candela/* strings.
using ExrAttribute = std::variant<float, std::string>;

/// ZIP compressed scan-line EXR. Values beyond half range in a half channel make that channel float32.
/// Throws Error (Fault::machine when the disk fails, Fault::input when the folder is missing).
void write_exr(const std::filesystem::path& file, std::uint32_t width, std::uint32_t height,
               const std::vector<ExrChannel>& channels,
               const std::map<std::string, ExrAttribute>& attributes);

/// sRGB-encoded RGB, 8 or 16 bit per channel (16: native endian values). `text` becomes tEXt chunks.
void write_png(const std::filesystem::path& file, std::uint32_t width, std::uint32_t height,
               std::span<const std::uint8_t> rgb, const std::map<std::string, std::string>& text = {});
void write_png(const std::filesystem::path& file, std::uint32_t width, std::uint32_t height,
               std::span<const std::uint16_t> rgb, const std::map<std::string, std::string>& text = {});

/// As PNG in memory, RGBA, the texels as they are.
[[nodiscard]] std::vector<std::byte> encode_png(const scene::Image& image);

/// Writes text or bytes the same safe way.
void write_file(const std::filesystem::path& file, std::span<const std::byte> bytes);

}  // namespace candela::io
