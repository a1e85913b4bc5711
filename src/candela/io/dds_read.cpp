#include <algorithm>
#include <cstring>

#include "candela/io/byte_reader.hpp"
#include "candela/io/image_read_limits.hpp"
#include "candela/io/texture_read.hpp"

namespace candela::io::detail {
namespace {

// Microsoft, "Programming Guide for DDS": offsets from the start of the file.
constexpr std::uint64_t kHeaderBytes = 128;
constexpr std::uint64_t kDx10Bytes = 20;
constexpr std::uint32_t kFourCc = 0x4;
constexpr std::uint32_t kDx10 = 0x30315844;
constexpr std::uint32_t kCube = 0x200;
constexpr std::uint32_t kAllFaces = 0xfc00;
constexpr std::uint32_t kVolume = 0x200000;

struct Header {
    LightFormat format = LightFormat::rgba16f;
    bool cube = false;
    std::uint64_t data_at = kHeaderBytes;
};

LightFormat legacy_format(std::uint32_t code, const ByteReader& file) {
    if (code == 113) return LightFormat::rgba16f;
    if (code == 116) return LightFormat::rgba32f;
    throw input_error("DDS texture in a format that holds no light", file.where(),
                      "the codes 113 (RGBA16F) and 116 (RGBA32F) and the DX10 header are read");
}

LightFormat dxgi_format(std::uint32_t code, const ByteReader& file) {
    switch (code) {
        case 2:
            return LightFormat::rgba32f;
        case 6:
            return LightFormat::rgb32f;
        case 10:
            return LightFormat::rgba16f;
        case 26:
            return LightFormat::b10g11r11;
        case 67:
            return LightFormat::rgb9e5;
        default:
            throw input_error("DDS texture in DXGI format " + std::to_string(code), file.where(),
                              "RGBA16F, RGBA32F, RGB32F, R9G9B9E5 and R11G11B10 are read");
    }
}

Header read_header(const ByteReader& file) {
    Header out;
    if (file.u32(4) != 124 || file.u32(76) != 32) throw file.broken("its header has another size");
    const std::uint32_t code = (file.u32(80) & kFourCc) != 0 ? file.u32(84) : 0, capabilities = file.u32(112);
    if ((capabilities & kVolume) != 0)
        throw input_error("a texture with depth is no environment", file.where());
    if (code != kDx10) {
        out.format = legacy_format(code, file);
        out.cube = (capabilities & kCube) != 0;
        if (out.cube && (capabilities & kAllFaces) != kAllFaces)
            throw file.broken("a cube without all its faces");
        return out;
    }
    constexpr std::uint32_t texture2d = 3, texture_cube = 4;
    out.format = dxgi_format(file.u32(kHeaderBytes), file);
    if (file.u32(kHeaderBytes + 4) != texture2d)
        throw input_error("a texture with depth or without height is no environment", file.where());
    if (file.u32(kHeaderBytes + 12) > 1)
        throw input_error("a texture of several layers is no environment", file.where());
    out.cube = (file.u32(kHeaderBytes + 8) & texture_cube) != 0;
    out.data_at = kHeaderBytes + kDx10Bytes;
    return out;
}

}  // namespace

bool is_dds(std::span<const std::byte> bytes) noexcept {
    return bytes.size() >= 4 && std::memcmp(bytes.data(), "DDS ", 4) == 0;
}

TextureFile decode_dds(std::span<const std::byte> bytes, const std::string& where,
                       const std::optional<scene::MemoryBudget>& memory) {
    const ByteReader file(bytes, "DDS texture", where);
    const Header header = read_header(file);
    TextureFile out;
    out.height = file.u32(12);
    out.width = file.u32(16);
    out.faces = header.cube ? 6 : 1;
    check_size(out.width, out.height, where);
    if (header.cube && out.width != out.height) throw file.broken("the faces of a cube are not square");
    const std::uint32_t levels = std::max(file.u32(28), 1u);
    if (levels > 32) throw file.broken(std::to_string(levels) + " levels");
    const std::uint64_t texel = texel_bytes(header.format);
    std::uint64_t face_bytes = 0;
    for (std::uint32_t level = 0; level < levels; ++level)
        face_bytes +=
            std::uint64_t{std::max(out.width >> level, 1u)} * std::max(out.height >> level, 1u) * texel;
    const std::uint64_t finest = std::uint64_t{out.width} * out.height;
    // All of it before memory is taken.
    (void)file.part(header.data_at, (out.faces - 1) * face_bytes + finest * texel);
    check_memory(out.width, std::uint64_t{out.height} * out.faces, memory, where);
    out.texels.reserve(finest * out.faces);
    for (std::uint32_t face = 0; face < out.faces; ++face)
        append_texels(file.part(header.data_at + face * face_bytes, finest * texel), header.format,
                      out.texels);
    return out;
}

}  // namespace candela::io::detail
