#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

/// Texture files of the tests' own making.
namespace candela::test {

using Text = std::string;

inline void put(Text& out, std::uint64_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> 8 * i & 0xff);
}
inline void put32(Text& out, std::initializer_list<std::uint32_t> words) {
    for (const std::uint32_t w : words) put(out, w, 4);
}

/// Rounded down: the values of the tests have few digits.
inline std::uint16_t half_of(float v) {
    const auto bits = std::bit_cast<std::uint32_t>(v);
    const int exponent = int(bits >> 23 & 0xff) - 127;
    if (v == 0.0f || exponent < -14) return 0;
    return static_cast<std::uint16_t>((bits >> 31) << 15 | std::uint32_t(exponent + 15) << 10 |
                                      (bits >> 13 & 0x3ff));
}
inline float float_of_half(std::uint32_t h) {
    const std::uint32_t e = h >> 10 & 31, m = h & 1023;
    const float magnitude =
        e == 0 ? std::ldexp(float(m), -24) : std::ldexp(1.0f + float(m) / 1024.0f, int(e) - 15);
    return (h & 0x8000) != 0 ? -magnitude : magnitude;
}
inline glm::vec3 rgb_of_e5b9g9r9(std::uint32_t t) {
    const float scale = std::ldexp(1.0f, int(t >> 27) - 24);
    return glm::vec3(t & 511, t >> 9 & 511, t >> 18 & 511) * scale;
}
inline glm::vec3 rgb_of_b10g11r11(std::uint32_t t) {
    const auto small = [](std::uint32_t bits, int mantissa) {
        const std::uint32_t e = bits >> mantissa, m = bits & ((1u << mantissa) - 1);
        const float unit = std::ldexp(1.0f, -mantissa);
        return e == 0 ? std::ldexp(float(m) * unit, -14) : std::ldexp(1.0f + float(m) * unit, int(e) - 15);
    };
    return {small(t & 0x7ff, 6), small(t >> 11 & 0x7ff, 6), small(t >> 22, 5)};
}

/// Vulkan formats 97 (RGBA16F), 106 (RGB32F), 109 (RGBA32F) of `texels`; others as given in `raw`.
inline Text pixels(const std::vector<glm::vec3>& texels, std::uint32_t format) {
    Text out;
    for (const glm::vec3& t : texels) {
        for (int c = 0; c < (format == 106 ? 3 : 4); ++c) {
            const float value = c < 3 ? t[c] : 1.0f;
            if (format == 97)
                put(out, half_of(value), 2);
            else
                put(out, std::bit_cast<std::uint32_t>(value), 4);
        }
    }
    return out;
}

struct Ktx2 {
    std::uint32_t format = 97;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t depth = 0;
    std::uint32_t layers = 0;
    std::uint32_t faces = 6;
    std::uint32_t levels = 1;
    std::uint32_t packing = 0;
    Text data;                   ///< of the finest level, as stored
    std::uint64_t unpacked = 0;  ///< 0: the size of data
    Text keys;

    [[nodiscard]] Text bytes() const {
        Text out("\xabKTX 20\xbb\r\n\x1a\n", 12);
        put32(out, {format, 2, width, height, depth, layers, faces, levels, packing});
        const std::uint32_t keys_at = 104;
        put32(out, {0, 0, keys.empty() ? 0 : keys_at, static_cast<std::uint32_t>(keys.size())});
        put(out, 0, 8);
        put(out, 0, 8);
        put(out, keys_at + keys.size(), 8);
        put(out, data.size(), 8);
        put(out, unpacked != 0 ? unpacked : data.size(), 8);
        return out + keys + data;
    }
};

inline Text ktx_key(const Text& key, const Text& value) {
    Text out;
    const Text entry = key + '\0' + value;
    put(out, entry.size(), 4);
    out += entry;
    while (out.size() % 4 != 0) out += '\0';
    return out;
}

struct Dds {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t four_cc = 113;  ///< 0x30315844: a DX10 header follows
    std::uint32_t dxgi = 10;
    bool cube = true;
    std::uint32_t levels = 1;
    Text data;

    [[nodiscard]] Text bytes() const {
        const bool dx10 = four_cc == 0x30315844;
        Text out("DDS ");
        put32(out, {124, 0x1007, height, width, 0, 0, levels});
        out += Text(44, '\0');
        put32(out, {32, 4, four_cc, 0, 0, 0, 0, 0, 0x1000, cube ? 0xfe00u : 0u, 0, 0, 0});
        if (dx10) put32(out, {dxgi, 3, cube ? 4u : 0u, 1, 0});
        return out + data;
    }
};

}  // namespace candela::test
