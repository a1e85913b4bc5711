#include <array>
#include <string_view>

#include "candela/io/byte_writer.hpp"
#include "candela/io/cube_file.hpp"
#include "candela/io/packed_texels.hpp"

namespace candela::io::detail {
namespace {

/// What the file formats say about a format of texels.
struct FormatFacts {
    std::uint32_t vulkan;
    std::uint32_t type_bytes;  ///< KTX 2's typeSize
    std::uint32_t texel_bytes;
};

FormatFacts facts_of(TexelFormat format) {
    switch (format) {
        case TexelFormat::rgba32f:
            return {109, 4, 16};
        case TexelFormat::rgb9e5:
            return {123, 4, 4};
        case TexelFormat::b10g11r11:
            return {122, 4, 4};
        default:
            return {97, 2, 8};
    }
}

void put_texel(ByteWriter& out, const glm::vec3& t, TexelFormat format) {
    switch (format) {
        case TexelFormat::rgba16f:
            for (int c = 0; c < 3; ++c) out.u16(to_half(t[c]));
            return out.u16(to_half(1.0f));
        case TexelFormat::rgba32f:
            for (int c = 0; c < 3; ++c) out.f32(t[c]);
            return out.f32(1.0f);
        case TexelFormat::rgb9e5:
            return out.u32(to_rgb9e5(t));
        case TexelFormat::b10g11r11:
            return out.u32(to_b10g11r11(t));
    }
}

void put_faces(ByteWriter& out, const scene::CubeMap& level, TexelFormat format) {
    for (const glm::vec3& texel : level.texels) put_texel(out, texel, format);
}

void put_key(ByteWriter& out, const std::string& key, const std::string& value) {
    const std::string entry = key + '\0' + value;
    out.u32(static_cast<std::uint32_t>(entry.size()));
    out.text(entry);
    out.align(4);
}

/// One sample of a Khronos Data Format Descriptor, version 1.3, section 5.
struct Sample {
    std::uint32_t offset_bits;
    std::uint32_t length_bits;
    std::uint32_t channel;  ///< with its qualifiers
    std::uint32_t lower;
    std::uint32_t upper;
};

std::vector<Sample> samples_of(TexelFormat format) {
    constexpr std::uint32_t alpha = 15, exponent = 0x20, signed_float = 0xc0, unsigned_float = 0x80;
    constexpr std::uint32_t minus_one = 0xbf800000u, one = 0x3f800000u;
    if (format == TexelFormat::b10g11r11)
        return {{0, 11, 0 | unsigned_float, 0, one},
                {11, 11, 1 | unsigned_float, 0, one},
                {22, 10, 2 | unsigned_float, 0, one}};
    if (format == TexelFormat::rgb9e5) {
        // 8448 is 1.0 under the bias of 15; each mantissa is followed by the exponent that it shares.
        constexpr std::uint32_t mantissa_of_one = 8448, bias = 15, largest = 31;
        std::vector<Sample> out;
        for (std::uint32_t c = 0; c < 3; ++c) {
            out.push_back({9 * c, 9, c, 0, mantissa_of_one});
            out.push_back({27, 5, c | exponent, bias, largest});
        }
        return out;
    }
    const std::uint32_t bits = format == TexelFormat::rgba16f ? 16 : 32;
    std::vector<Sample> out;
    for (std::uint32_t c = 0; c < 4; ++c)
        out.push_back({bits * c, bits, (c == 3 ? alpha : c) | signed_float, minus_one, one});
    return out;
}

void put_data_format(ByteWriter& out, TexelFormat format) {
    constexpr std::uint32_t version = 2, rgbsda = 1, bt709 = 1, linear = 1;
    const std::vector<Sample> samples = samples_of(format);
    const auto block_bytes = static_cast<std::uint32_t>(24 + 16 * samples.size());
    out.u32(block_bytes + 4);
    out.u32(0);
    out.u32(version | block_bytes << 16);
    out.u32(rgbsda | bt709 << 8 | linear << 16);
    out.u32(0);
    out.u32(facts_of(format).texel_bytes);
    out.u32(0);
    for (const Sample& s : samples) {
        out.u32(s.offset_bits | (s.length_bits - 1) << 16 | s.channel << 24);
        out.u32(0);
        out.u32(s.lower);
        out.u32(s.upper);
    }
}

}  // namespace

// KTX File Format Specification 2.0, section 3.
std::vector<std::byte> encode_ktx2(std::span<const scene::CubeMap> levels, TexelFormat format,
                                   std::map<std::string, std::string> keys) {
    const FormatFacts facts = facts_of(format);
    const auto count = static_cast<std::uint32_t>(levels.size());
    ByteWriter out;
    out.text("\xabKTX 20\xbb\r\n\x1a\n");
    for (const std::uint32_t word :
         {facts.vulkan, facts.type_bytes, levels[0].size, levels[0].size, 0u, 0u, 6u, count, 0u})
        out.u32(word);
    const std::size_t index_at = out.size();
    for (int i = 0; i < 4; ++i) out.u32(0);
    out.u64(0);
    out.u64(0);
    const std::size_t levels_at = out.size();
    for (std::uint32_t i = 0; i < 3 * count; ++i) out.u64(0);

    const std::size_t data_format_at = out.size();
    put_data_format(out, format);
    const std::size_t keys_at = out.size();
    // The values of KTX's own keys end with a zero.
    keys["KTXorientation"] = std::string("rd") + '\0';
    keys["KTXwriter"] = std::string("candela") + '\0';
    for (const auto& [key, value] : keys) put_key(out, key, value);
    out.u32_at(index_at, static_cast<std::uint32_t>(data_format_at));
    out.u32_at(index_at + 4, static_cast<std::uint32_t>(keys_at - data_format_at));
    out.u32_at(index_at + 8, static_cast<std::uint32_t>(keys_at));
    out.u32_at(index_at + 12, static_cast<std::uint32_t>(out.size() - keys_at));
    for (std::uint32_t i = count; i-- > 0;) {
        out.align(facts.texel_bytes);  // all sizes of texels are multiples of 4
        const std::size_t start = out.size();
        put_faces(out, levels[i], format);
        out.u64_at(levels_at + 24 * i, start);
        out.u64_at(levels_at + 24 * i + 8, out.size() - start);
        out.u64_at(levels_at + 24 * i + 16, out.size() - start);
    }
    return out.take();
}

// KTX File Format Specification 1.0, section 2.
std::vector<std::byte> encode_ktx1(std::span<const scene::CubeMap> levels,
                                   const std::map<std::string, std::string>& keys) {
    constexpr std::uint32_t gl_10f_11f_11f_rev = 0x8c3b, gl_rgb = 0x1907, gl_r11f_g11f_b10f = 0x8c3a;
    ByteWriter key_bytes;
    for (const auto& [key, value] : keys) put_key(key_bytes, key, value + '\0');
    ByteWriter out;
    out.text("\xabKTX 11\xbb\r\n\x1a\n");
    for (const std::uint32_t word :
         {0x04030201u, gl_10f_11f_11f_rev, 4u, gl_rgb, gl_r11f_g11f_b10f, gl_rgb, levels[0].size,
          levels[0].size, 0u, 0u, 6u, static_cast<std::uint32_t>(levels.size()),
          static_cast<std::uint32_t>(key_bytes.size())})
        out.u32(word);
    for (const std::byte b : key_bytes.take()) out.text(std::string(1, static_cast<char>(b)));
    for (const scene::CubeMap& level : levels) {
        out.u32(4 * level.size * level.size);  // of one face: not an array
        put_faces(out, level, TexelFormat::b10g11r11);
    }
    return out.take();
}

// Microsoft, "Programming Guide for DDS".
std::vector<std::byte> encode_dds(std::span<const scene::CubeMap> levels) {
    constexpr std::uint32_t caps_height_width_pitch_format_levels = 0x2100f;
    constexpr std::uint32_t complex_texture_mipmap = 0x401008, cube_of_six = 0xfe00, four_cc = 0x4;
    constexpr std::uint32_t dxgi_rgba16f = 10, texture2d = 3, texture_cube = 4;
    constexpr std::uint32_t texel_bytes = 8;
    const std::uint32_t size = levels[0].size;
    ByteWriter out;
    out.text("DDS ");
    for (const std::uint32_t word : {124u, caps_height_width_pitch_format_levels, size, size,
                                     texel_bytes * size, 0u, static_cast<std::uint32_t>(levels.size())})
        out.u32(word);
    for (int i = 0; i < 11; ++i) out.u32(0);
    out.u32(32);
    out.u32(four_cc);
    out.text("DX10");
    for (int i = 0; i < 5; ++i) out.u32(0);
    for (const std::uint32_t word : {complex_texture_mipmap, cube_of_six, 0u, 0u, 0u}) out.u32(word);
    for (const std::uint32_t word : {dxgi_rgba16f, texture2d, texture_cube, 1u, 0u}) out.u32(word);
    for (std::uint32_t face = 0; face < 6; ++face) {
        for (const scene::CubeMap& level : levels) {
            const std::size_t texels = std::size_t{level.size} * level.size;
            for (std::size_t i = 0; i < texels; ++i)
                put_texel(out, level.texels[face * texels + i], TexelFormat::rgba16f);
        }
    }
    return out.take();
}

}  // namespace candela::io::detail
