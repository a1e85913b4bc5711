#include "candela/measure/report_pixels.hpp"

#include <ImathConfig.h>
#include <half.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <new>

#include "candela/scene/half_range.hpp"

namespace candela::measure::detail {
namespace {

/// Each byte of a row less the one before it: smooth pictures become runs of small numbers.
void difference_rows(std::vector<std::uint8_t>& bytes, std::size_t width) {
    for (std::size_t start = 0; start < bytes.size(); start += width) {
        for (std::size_t i = width - 1; i > 0; --i)
            bytes[start + i] = static_cast<std::uint8_t>(bytes[start + i] - bytes[start + i - 1]);
    }
}

std::string pack(std::vector<std::uint8_t> bytes, std::size_t width) {
    difference_rows(bytes, width);
    uLongf size = compressBound(static_cast<uLong>(bytes.size()));
    std::vector<std::uint8_t> out(size);
    constexpr int level = 6;
    if (compress2(out.data(), &size, bytes.data(), static_cast<uLong>(bytes.size()), level) != Z_OK)
        throw std::bad_alloc();
    out.resize(size);
    return base64(out);
}

}  // namespace

float half_scale(const std::vector<const Picture*>& pictures, float exposure) {
    float brightest = 0.0f;
    for (const Picture* picture : pictures)
        for (const glm::vec3& p : picture->pixels)
            for (int c = 0; c < 3; ++c)
                if (std::isfinite(p[c])) brightest = std::max(brightest, std::abs(p[c]));
    int power = static_cast<int>(std::floor(std::log2(exposure)));
    while (power > -120 && std::ldexp(brightest, power) > scene::kLargestHalf) --power;
    return std::ldexp(1.0f, power);
}

std::string pack_halves(const Picture& picture, float scale) {
    const std::size_t count = picture.pixels.size();
    std::vector<std::uint8_t> planes(6 * count);
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            const std::uint16_t bits = half(picture.pixels[i][int(c)] * scale).bits();
            planes[c * count + i] = static_cast<std::uint8_t>(bits >> 8);
            planes[(c + 3) * count + i] = static_cast<std::uint8_t>(bits & 0xff);
        }
    }
    return pack(std::move(planes), picture.width);
}

std::string pack_errors(const ErrorMap& map) {
    std::vector<std::uint8_t> plane(map.values.size());
    std::transform(map.values.begin(), map.values.end(), plane.begin(), [](float v) {
        return static_cast<std::uint8_t>(std::isnan(v) ? 255.0f : std::clamp(v, 0.0f, 1.0f) * 254.0f + 0.5f);
    });
    return pack(std::move(plane), map.width);
}

/// RFC 4648, section 4.
std::string base64(const std::vector<std::uint8_t>& bytes) {
    constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t left = std::min<std::size_t>(bytes.size() - i, 3);
        std::uint32_t group = 0;
        for (std::size_t j = 0; j < 3; ++j) group = group << 8 | (j < left ? bytes[i + j] : 0u);
        for (std::size_t j = 0; j < 4; ++j) out += j <= left ? digits[group >> (18 - 6 * j) & 63] : '=';
    }
    return out;
}

}  // namespace candela::measure::detail
