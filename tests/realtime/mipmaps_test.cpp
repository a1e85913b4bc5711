#include "candela/realtime/mipmaps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "candela/realtime/alpha_coverage.hpp"
#include "shading/footprint.glsl"

using namespace candela;
using realtime::AlphaUse;
using realtime::mip_chain;
using realtime::MipOptions;
using realtime::TexelContent;

namespace {

using Levels = std::vector<std::vector<std::uint8_t>>;

/// `texel(x, y)`: four bytes.
template <class Texel>
scene::Image image(std::uint32_t width, std::uint32_t height, const Texel& texel) {
    scene::Image out{"test", width, height, {}};
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x)
            for (const int byte : texel(x, y)) out.rgba.push_back(static_cast<std::uint8_t>(byte));
    }
    return out;
}

std::array<int, 4> with_alpha(bool there) {
    return {200, 100, 50, there ? 255 : 0};
}

float covered(const Levels& levels, std::size_t level, std::uint32_t size, float cutoff) {
    const std::uint32_t side = size >> level;
    return realtime::coverage(
        {side, side, [&](std::size_t i) { return static_cast<float>(levels[level][4 * i + 3]) / 255.0f; }},
        cutoff);
}

int byte(float x) {
    return static_cast<int>(std::lround(255.0f * (0.5f + 0.5f * x)));
}

glm::vec3 normal_of(const std::uint8_t* texel) {
    return 2.0f * glm::vec3(texel[0], texel[1], texel[2]) / 255.0f - 1.0f;
}

float length_of(const std::uint8_t* texel) {
    return shading::average_normal_length(static_cast<float>(texel[3]) / 255.0f);
}

}  // namespace

// Fences, leaves and nets: what is there stays there, and what is open stays open, at every level that there
// is.
TEST(Mipmaps, MasksCoverAsMuchAtEveryLevel) {
    constexpr std::uint32_t size = 128;
    const auto wires = image(size, size, [](auto x, auto y) { return with_alpha(x % 16 < 2 || y % 32 < 2); });
    const auto net = image(size, size, [](auto x, auto y) { return with_alpha(x % 16 > 3 || y % 16 > 3); });
    const auto dots = image(size, size, [](auto x, auto y) {
        const int dx = static_cast<int>(x % 32) - 16;
        const int dy = static_cast<int>(y % 32) - 16;
        return with_alpha(dx * dx + dy * dy < 40);
    });
    const auto soft = image(size, size, [](auto x, auto y) {
        return std::array<int, 4>{255, 255, 255, static_cast<int>((x * 7 + y * 13) % 256)};
    });
    const std::vector<scene::Image> masks{wires, net, dots, soft};
    for (const scene::Image& mask : masks) {
        for (const float cutoff : {0.2f, 0.5f, 0.9f}) {
            const Levels levels = mip_chain(mask, {TexelContent::color, AlphaUse::cutout, cutoff});
            const float wanted = covered(levels, 0, size, cutoff);
            EXPECT_GE(levels.size(), cutoff == 0.5f ? 4u : 1u) << "mask " << &mask - masks.data();
            for (std::size_t level = 1; level < levels.size(); ++level) {
                EXPECT_NEAR(covered(levels, level, size, cutoff), wanted,
                            0.1f * std::min(wanted, 1.0f - wanted))
                    << "level " << level << ", cutoff " << cutoff;
            }
        }
    }
}

TEST(Mipmaps, MasksThatHideNothingOrAllHaveEveryLevel) {
    const auto all = image(16, 16, [](auto, auto) { return with_alpha(true); });
    EXPECT_EQ(mip_chain(all, {TexelContent::color, AlphaUse::cutout, 0.5f}).size(), 5u);
    const auto none = image(16, 16, [](auto, auto) { return with_alpha(false); });
    EXPECT_EQ(mip_chain(none, {TexelContent::color, AlphaUse::cutout, 0.5f}).size(), 5u);
}

TEST(Mipmaps, WhatIsNotSeenDoesNotBleed) {
    const auto leaf = image(8, 8, [](auto x, auto y) {
        return (x + y) % 2 == 0 ? std::array<int, 4>{180, 20, 40, 255} : std::array<int, 4>{0, 0, 0, 0};
    });
    for (const AlphaUse use : {AlphaUse::weight, AlphaUse::cutout}) {
        const Levels levels = mip_chain(leaf, {TexelContent::color, use, 0.5f});
        for (const auto& level : levels) {
            if (&level == &levels.front()) continue;
            EXPECT_NEAR(level[0], 180, 1);
            EXPECT_NEAR(level[1], 20, 1);
            EXPECT_NEAR(level[2], 40, 1);
        }
    }
    const Levels weighted = mip_chain(leaf, {TexelContent::color, AlphaUse::weight});
    EXPECT_NEAR(weighted.back()[3], 128, 1);
    const Levels opaque = mip_chain(leaf, {TexelContent::color, AlphaUse::none});
    EXPECT_LT(opaque.back()[0], 140) << "an opaque surface shows all texels";
}

TEST(Mipmaps, ColoursAreAveragedAsLight) {
    const auto checker = image(32, 32, [](auto x, auto y) {
        const int v = (x + y) % 2 == 0 ? 255 : 0;
        return std::array<int, 4>{v, v, v, 255};
    });
    for (const auto& level : mip_chain(checker, {TexelContent::color})) {
        if (level.size() == checker.rgba.size()) continue;
        EXPECT_NEAR(level[0], 188, 1);
    }
    for (const auto& level : mip_chain(checker, {TexelContent::data})) {
        if (level.size() == checker.rgba.size()) continue;
        EXPECT_NEAR(level[0], 128, 1);
    }
}

TEST(Mipmaps, OddSizesLoseNoTexel) {
    for (const std::uint32_t bright : {0u, 1u, 2u, 3u, 4u}) {
        const auto line = image(5, 1, [&](auto x, auto) {
            return std::array<int, 4>{x == bright ? 250 : 0, 0, 0, 255};
        });
        EXPECT_NEAR(mip_chain(line, {TexelContent::data}).back()[0], 50, 1) << bright;
    }
}

TEST(Mipmaps, NormalsStayUnitAndKeepTheLengthOfTheirMean) {
    const float tilt = 0.35f;
    const auto grooves = image(64, 64, [&](auto x, auto) {
        return std::array<int, 4>{byte((x % 2 == 0 ? 1.0f : -1.0f) * std::sin(tilt)), 128,
                                  byte(std::cos(tilt)), 7};
    });
    const Levels levels = mip_chain(grooves, {TexelContent::normals});
    EXPECT_EQ(levels[0][3], 255) << "a normal map's own alpha means nothing";
    EXPECT_EQ(levels[0][0], grooves.rgba[0]);
    for (std::size_t level = 1; level < levels.size(); ++level) {
        EXPECT_NEAR(glm::length(normal_of(levels[level].data())), 1.0f, 0.01f);
        EXPECT_NEAR(length_of(levels[level].data()), std::cos(tilt), 0.003f) << level;
    }
}

TEST(Mipmaps, AFlatMapSpreadsNothingHoweverItIsRounded) {
    for (const float tilt : {0.0f, 0.1f, 0.5236f, 1.0f}) {
        const auto flat = image(16, 16, [&](auto, auto) {
            return std::array<int, 4>{byte(std::sin(tilt)), 128, byte(std::cos(tilt)), 255};
        });
        for (const auto& level : mip_chain(flat, {TexelContent::normals}))
            EXPECT_GT(length_of(level.data()), 0.99998f) << tilt;
    }
}

// By the normals themselves: of a narrow cone about a tilted mean, scaled.
TEST(Mipmaps, TheScaleOfANormalMapScalesTheSpreadOfItsNormals) {
    for (const float tilt : {0.0f, 0.4f, 0.9f}) {
        for (const float scale : {0.25f, 0.5f, 1.0f, 1.5f}) {
            const glm::dvec3 mean(std::sin(tilt), 0.0, std::cos(tilt));
            const glm::dvec3 along(std::cos(tilt), 0.0, -std::sin(tilt));
            glm::dvec3 before(0.0);
            glm::dvec3 after(0.0);
            for (int i = 0; i < 64; ++i) {
                const double angle = 6.283185307 * i / 64.0;
                const glm::dvec3 n = glm::normalize(
                    mean + 0.02 * (std::cos(angle) * along + std::sin(angle) * glm::dvec3(0, 1, 0)));
                before += n / 64.0;
                after += glm::normalize(n * glm::dvec3(scale, scale, 1.0)) / 64.0;
            }
            const double ratio = (1.0 - glm::length(after)) / (1.0 - glm::length(before));
            EXPECT_NEAR(shading::scaled_normal_variance(std::cos(tilt), scale), ratio, 0.01 * ratio)
                << tilt << " " << scale;
        }
    }
}
