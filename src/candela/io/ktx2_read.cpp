#include <zlib.h>
#include <zstd.h>

#include <charconv>
#include <cmath>
#include <cstring>

#include "candela/io/byte_reader.hpp"
#include "candela/io/image_read_limits.hpp"
#include "candela/io/texture_read.hpp"

namespace candela::io::detail {
namespace {

constexpr std::string_view kIdentifier = "\xabKTX 20\xbb\r\n\x1a\n";

enum class Packing : std::uint32_t { none = 0, zstd = 2, zlib = 3 };

struct Header {
    LightFormat format = LightFormat::rgba16f;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t faces = 1;
    Packing packing = Packing::none;
};

LightFormat format_of(std::uint32_t vulkan, const ByteReader& file) {
    switch (vulkan) {
        case 97:
            return LightFormat::rgba16f;
        case 106:
            return LightFormat::rgb32f;
        case 109:
            return LightFormat::rgba32f;
        case 122:
            return LightFormat::b10g11r11;
        case 123:
            return LightFormat::rgb9e5;
        default:
            throw input_error("KTX 2 texture in Vulkan format " + std::to_string(vulkan), file.where(),
                              "RGBA16F, RGBA32F, RGB32F, E5B9G9R9 and B10G11R11 are read");
    }
}

/// KTX File Format Specification 2.0, section 3.1 and following.
Header read_header(const ByteReader& file) {
    Header out;
    const std::uint32_t depth = file.u32(28), layers = file.u32(32), levels = file.u32(40),
                        packing = file.u32(44);
    out.width = file.u32(20);
    out.height = file.u32(24);
    out.faces = file.u32(36);
    if (depth > 1) throw input_error("a texture with depth is no environment", file.where());
    if (layers > 1) throw input_error("a texture of several layers is no environment", file.where());
    if (out.faces != 1 && out.faces != 6) throw file.broken(std::to_string(out.faces) + " faces");
    if (levels > 32) throw file.broken(std::to_string(levels) + " levels");
    if (packing != 0 && packing != 2 && packing != 3)
        throw input_error("KTX 2 supercompression " + std::to_string(packing), file.where(),
                          "none, Zstandard and zlib are read");
    out.packing = static_cast<Packing>(packing);
    out.format = format_of(file.u32(12), file);
    check_size(out.width, out.height, file.where());
    if (out.faces == 6 && out.width != out.height) throw file.broken("the faces of a cube are not square");
    if (std::uint64_t{out.width} * out.height * out.faces > max_texels)
        throw input_error("the picture is too large", file.where(), "at most 2^28 texels");
    return out;
}

/// What one byte can unpack to at best: deflate's 1032, and runs of 128 KiB in four bytes of Zstandard.
std::uint64_t most_per_byte(Packing packing) {
    return packing == Packing::none ? 1 : packing == Packing::zlib ? 1032 : std::uint64_t{1} << 16;
}

std::vector<std::byte> unpacked(std::span<const std::byte> packed, std::uint64_t size, Packing packing,
                                const ByteReader& file) {
    std::vector<std::byte> out(size);
    bool good = false;
    if (packing == Packing::zlib) {
        uLongf written = out.size();
        good = ::uncompress(reinterpret_cast<Bytef*>(out.data()), &written,
                            reinterpret_cast<const Bytef*>(packed.data()), packed.size()) == Z_OK &&
               written == out.size();
    } else {
        good = ZSTD_decompress(out.data(), out.size(), packed.data(), packed.size()) == out.size();
    }
    if (!good) throw file.broken("the compressed data is damaged");
    return out;
}

struct Keys {
    std::optional<scene::CubeSpace> space;
    float nit_per_unit = 1.0f;
    bool absolute = false;
};

void read_key(const std::string& key, const std::string& value, const ByteReader& file, Keys& keys) {
    if (key == "candela.cubeSpace" && value == "direct") keys.space = scene::CubeSpace::direct;
    if (key != "candela.nitPerUnit") return;
    const char* end = value.data() + value.size();
    const auto [stop, failure] = std::from_chars(value.data(), end, keys.nit_per_unit);
    if (failure != std::errc{} || stop != end || !std::isfinite(keys.nit_per_unit) ||
        !(keys.nit_per_unit > 0.0f))
        throw file.broken("candela.nitPerUnit is not a positive number");
    keys.absolute = true;
}

Keys read_keys(const ByteReader& file) {
    Keys keys;
    const std::uint64_t start = file.u32(56), size = file.u32(60);
    (void)file.part(start, size);
    for (std::uint64_t at = start; at + 4 <= start + size;) {
        const std::uint64_t length = file.u32(at);
        if (length > start + size - at - 4) throw file.broken("a key leaves the key data");
        const auto bytes = file.part(at + 4, length);
        const std::string entry(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        const std::size_t zero = entry.find('\0');
        if (zero == std::string::npos) throw file.broken("a key without end");
        std::string value = entry.substr(zero + 1);
        while (value.ends_with('\0')) value.pop_back();
        read_key(entry.substr(0, zero), value, file, keys);
        at += 4 + (length + 3) / 4 * 4;
    }
    return keys;
}

}  // namespace

bool is_ktx2(std::span<const std::byte> bytes) noexcept {
    return bytes.size() >= kIdentifier.size() &&
           std::memcmp(bytes.data(), kIdentifier.data(), kIdentifier.size()) == 0;
}

TextureFile decode_ktx2(std::span<const std::byte> bytes, const std::string& where,
                        const std::optional<scene::MemoryBudget>& memory) {
    const ByteReader file(bytes, "KTX 2 texture", where);
    const Header header = read_header(file);
    const std::uint64_t texels = std::uint64_t{header.width} * header.height * header.faces;
    const std::uint64_t size = texels * texel_bytes(header.format);
    const std::uint64_t stored = file.u64(88), claimed = file.u64(96);
    const std::span<const std::byte> data = file.part(file.u64(80), stored);
    if (header.packing == Packing::none && stored != size)
        throw file.broken("the finest level has " + std::to_string(stored) + " bytes instead of " +
                          std::to_string(size));
    if (header.packing != Packing::none && claimed != size)
        throw file.broken("the finest level unpacks to another size than its faces have");
    check_claim(size, stored, most_per_byte(header.packing), where);
    check_memory(header.width, std::uint64_t{header.height} * header.faces, memory, where);
    const Keys keys = read_keys(file);
    TextureFile out{header.width, header.height, header.faces, {}, keys.space, keys.absolute};
    out.texels.reserve(texels);
    if (header.packing == Packing::none)
        append_texels(data, header.format, out.texels);
    else
        append_texels(unpacked(data, size, header.packing, file), header.format, out.texels);
    for (glm::vec3& texel : out.texels) texel *= keys.nit_per_unit;
    return out;
}

}  // namespace candela::io::detail
