#include "candela/realtime/mipmaps.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "shading/transfer.glsl"

namespace candela::realtime {
namespace {

constexpr std::size_t kEncodeSteps = 4096;

struct SrgbTables {
    SrgbTables() {
        for (std::size_t i = 0; i < decode.size(); ++i) {
            decode[i] = shading::linear_from_srgb(static_cast<float>(i) / 255.0f);
        }
        for (std::size_t i = 0; i < encode.size(); ++i) {
            const float linear = static_cast<float>(i) / static_cast<float>(kEncodeSteps - 1);
            // Indexed by sqrt(linear): even steps where the eye sees steps.
            encode[i] =
                static_cast<std::uint8_t>(std::lround(255.0f * shading::srgb_from_linear(linear * linear)));
        }
    }
    std::array<float, 256> decode{};
    std::array<std::uint8_t, kEncodeSteps> encode{};
};

const SrgbTables& tables() {
    static const SrgbTables instance;
    return instance;
}

std::uint8_t encode(float linear) {
    return tables().encode[static_cast<std::size_t>(
        std::lround(std::sqrt(std::clamp(linear, 0.0f, 1.0f)) * static_cast<float>(kEncodeSteps - 1)))];
}

struct Level {
    std::uint32_t width;
    std::uint32_t height;
    std::vector<std::uint8_t> rgba;
};

Level halve(const Level& from, bool srgb) {
    Level to{std::max(1u, from.width / 2), std::max(1u, from.height / 2), {}};
    to.rgba.resize(std::size_t{to.width} * to.height * 4);
    const auto& decode = tables().decode;
    for (std::uint32_t y = 0; y < to.height; ++y) {
        const std::size_t y0 = std::min(2 * y, from.height - 1);
        const std::size_t y1 = std::min(2 * y + 1, from.height - 1);
        for (std::uint32_t x = 0; x < to.width; ++x) {
            const std::size_t x0 = std::min(2 * x, from.width - 1);
            const std::size_t x1 = std::min(2 * x + 1, from.width - 1);
            const std::array taps{
                &from.rgba[(y0 * from.width + x0) * 4], &from.rgba[(y0 * from.width + x1) * 4],
                &from.rgba[(y1 * from.width + x0) * 4], &from.rgba[(y1 * from.width + x1) * 4]};
            std::uint8_t* out = &to.rgba[(std::size_t{y} * to.width + x) * 4];
            for (int c = 0; c < 4; ++c) {
                if (srgb && c < 3) {
                    out[c] = encode(0.25f * (decode[taps[0][c]] + decode[taps[1][c]] + decode[taps[2][c]] +
                                             decode[taps[3][c]]));
                } else {
                    out[c] = static_cast<std::uint8_t>(
                        (taps[0][c] + taps[1][c] + taps[2][c] + taps[3][c] + 2) / 4);
                }
            }
        }
    }
    return to;
}

}  // namespace

std::vector<std::vector<std::uint8_t>> mip_chain(const scene::Image& image, bool srgb) {
    std::vector<std::vector<std::uint8_t>> levels;
    Level level{image.width, image.height, image.rgba};
    while (true) {
        levels.push_back(level.rgba);
        if (level.width == 1 && level.height == 1) return levels;
        level = halve(level, srgb);
    }
}

}  // namespace candela::realtime
