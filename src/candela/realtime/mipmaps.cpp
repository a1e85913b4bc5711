#include "candela/realtime/mipmaps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "candela/realtime/alpha_coverage.hpp"
#include "candela/realtime/material_block.hpp"
#include "shading/footprint.glsl"
#include "shading/transfer.glsl"

namespace candela::realtime {
namespace {

constexpr std::size_t kEncodeSteps = 4096;
/// Of the smaller of what is covered and what is not: how far a level may be off.
constexpr float kCoverageTolerance = 0.1f;
constexpr int kScaleSteps = 12;

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

std::uint8_t encode_srgb(float linear) {
    return tables().encode[static_cast<std::size_t>(
        std::lround(std::sqrt(std::clamp(linear, 0.0f, 1.0f)) * static_cast<float>(kEncodeSteps - 1)))];
}

std::uint8_t encode_unorm(float x) {
    return static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(x, 0.0f, 1.0f)));
}

/// What is averaged: linear colours and alpha, or mean vectors of normals (w unused).
struct Level {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<glm::vec4> texels;
};

glm::vec4 decode(const std::uint8_t* rgba, TexelContent content) {
    constexpr float unit = 1.0f / 255.0f;
    const glm::vec4 data = glm::vec4(rgba[0], rgba[1], rgba[2], rgba[3]) * unit;
    switch (content) {
        case TexelContent::color: {
            const auto& table = tables().decode;
            return {table[rgba[0]], table[rgba[1]], table[rgba[2]], data.a};
        }
        case TexelContent::normals: {
            const glm::vec3 n = 2.0f * glm::vec3(data) - 1.0f;
            const float length = glm::length(n);
            // 8 bits make no vector a unit vector: what is short by that is no spread of normals.
            return {length > 1e-3f ? n / length : glm::vec3(0.0f, 0.0f, 1.0f), 1.0f};
        }
        default:
            return data;
    }
}

glm::vec4 display_normal(const glm::vec4& mean) {
    const float length = glm::length(glm::vec3(mean));
    const glm::vec3 n = length > 1e-6f ? glm::vec3(mean) / length : glm::vec3(0.0f, 0.0f, 1.0f);
    return {0.5f * n + 0.5f, shading::average_normal_texel(length)};
}

/// Texels of a row or column that one of the next level covers, with the part that each has of it.
struct Taps {
    std::array<std::uint32_t, 3> at{};
    std::array<float, 3> weight{};
};

Taps taps(std::uint32_t i, std::uint32_t from, std::uint32_t to) {
    if (from == 1) return {{0, 0, 0}, {1.0f, 0.0f, 0.0f}};
    if (from == 2 * to) return {{2 * i, 2 * i + 1, 2 * i + 1}, {0.5f, 0.5f, 0.0f}};
    const auto size = static_cast<float>(from);
    return {
        {2 * i, 2 * i + 1, 2 * i + 2},
        {static_cast<float>(to - i) / size, static_cast<float>(to) / size, static_cast<float>(i + 1) / size}};
}

/// `read(index)`: a texel of the finer level.
template <class Read>
Level downsample(std::uint32_t width, std::uint32_t height, bool weight_by_alpha, const Read& read) {
    Level to{std::max(1u, width / 2), std::max(1u, height / 2), {}};
    to.texels.resize(std::size_t{to.width} * to.height);
    for (std::uint32_t y = 0; y < to.height; ++y) {
        const Taps rows = taps(y, height, to.height);
        for (std::uint32_t x = 0; x < to.width; ++x) {
            const Taps columns = taps(x, width, to.width);
            glm::vec4 sum(0.0f);
            glm::vec3 weighted(0.0f);
            for (std::size_t r = 0; r < 3; ++r) {
                for (std::size_t c = 0; c < 3 && rows.weight[r] > 0.0f; ++c) {
                    const float weight = rows.weight[r] * columns.weight[c];
                    if (weight <= 0.0f) continue;
                    const glm::vec4 texel = read(std::size_t{rows.at[r]} * width + columns.at[c]);
                    sum += weight * texel;
                    weighted += weight * texel.a * glm::vec3(texel);
                }
            }
            // Where nothing is seen, the plain mean will do.
            if (weight_by_alpha && sum.a > 0.0f) sum = glm::vec4(weighted / sum.a, sum.a);
            to.texels[std::size_t{y} * to.width + x] = sum;
        }
    }
    return to;
}

std::vector<std::uint8_t> encode(const Level& level, TexelContent content, float alpha_scale) {
    std::vector<std::uint8_t> out;
    out.reserve(level.texels.size() * 4);
    for (const glm::vec4& texel : level.texels) {
        const glm::vec4 shown = content == TexelContent::normals ? display_normal(texel) : texel;
        for (int c = 0; c < 3; ++c)
            out.push_back(content == TexelContent::color ? encode_srgb(shown[c]) : encode_unorm(shown[c]));
        out.push_back(encode_unorm(shown.a * alpha_scale));
    }
    return out;
}

std::vector<std::uint8_t> first_level(const scene::Image& image, TexelContent content) {
    std::vector<std::uint8_t> out = image.rgba;
    if (content == TexelContent::normals) {
        for (std::size_t i = 3; i < out.size(); i += 4) out[i] = 255;
    }
    return out;
}

AlphaTexels stored_alpha(std::uint32_t width, std::uint32_t height, const std::vector<std::uint8_t>& rgba) {
    return {width, height, [&rgba](std::size_t i) { return static_cast<float>(rgba[4 * i + 3]) / 255.0f; }};
}

/// A level as it is stored; nothing where it cannot cover what it should.
std::vector<std::uint8_t> encode_cutout(const Level& level, const MipOptions& options, float wanted) {
    const AlphaTexels alpha{level.width, level.height, [&](std::size_t i) { return level.texels[i].a; }};
    const float tolerance = kCoverageTolerance * std::min(wanted, 1.0f - wanted);
    float scale = alpha_scale_for_coverage(alpha, options.cutoff, wanted);
    float low = 0.0f;
    float high = 0.0f;
    std::vector<std::uint8_t> nearest;
    float nearest_off = tolerance;
    // Alpha that the scale lifts above 1 is cut, which covers less between texels: a bisection on what is
    // stored.
    for (int step = 0; step < kScaleSteps; ++step) {
        std::vector<std::uint8_t> out = encode(level, options.content, scale);
        const float covered = coverage(stored_alpha(level.width, level.height, out), options.cutoff);
        if (std::abs(covered - wanted) < nearest_off) {
            nearest_off = std::abs(covered - wanted);
            nearest = std::move(out);
            if (nearest_off < 0.25f * tolerance) break;
        }
        (covered < wanted ? low : high) = scale;
        scale = low > 0.0f && high > 0.0f ? std::sqrt(low * high)
                : covered < wanted        ? 2.0f * scale
                                          : 0.5f * scale;
    }
    return nearest;
}

}  // namespace

std::vector<std::vector<std::uint8_t>> mip_chain(const scene::Image& image, const MipOptions& options,
                                                 std::size_t max_levels) {
    const bool weighted = options.alpha != AlphaUse::none;
    std::vector<std::vector<std::uint8_t>> levels{first_level(image, options.content)};
    float wanted = 1.0f;
    if (options.alpha == AlphaUse::cutout && max_levels > 1)
        wanted = coverage(stored_alpha(image.width, image.height, levels.front()), options.cutoff);
    // Nothing, or everything, is there at any distance.
    const bool cutout = wanted > 0.0f && wanted < 1.0f;
    Level level{image.width, image.height, {}};
    while ((level.width > 1 || level.height > 1) && levels.size() < max_levels) {
        if (level.texels.empty()) {
            level = downsample(image.width, image.height, weighted,
                               [&](std::size_t i) { return decode(&image.rgba[4 * i], options.content); });
        } else {
            level = downsample(level.width, level.height, weighted,
                               [&](std::size_t i) { return level.texels[i]; });
        }
        levels.push_back(cutout ? encode_cutout(level, options, wanted)
                                : encode(level, options.content, 1.0f));
        if (levels.back().empty()) {
            levels.pop_back();
            break;
        }
    }
    return levels;
}

MipOptions mip_options(std::size_t slot, const scene::Material& m) {
    const bool specular_glossiness = m.workflow == scene::Workflow::specular_glossiness;
    MipOptions out;
    if (slot == slot_base_color || slot == slot_emissive || slot == slot_specular_color ||
        slot == slot_sheen_color || (slot == slot_metallic_roughness && specular_glossiness))
        out.content = TexelContent::color;
    if (slot == slot_normal || slot == slot_clearcoat_normal) out.content = TexelContent::normals;
    if (slot != slot_base_color) return out;
    if (m.alpha_mode == scene::AlphaMode::blend) out.alpha = AlphaUse::weight;
    // Vertex colours may scale alpha once more, each vertex by its own: they are left out.
    const float cutoff = m.base_color.a > 0.0f ? m.alpha_cutoff / m.base_color.a : 0.0f;
    if (m.alpha_mode == scene::AlphaMode::mask && cutoff > 0.0f && cutoff <= 1.0f) {
        out.alpha = AlphaUse::cutout;
        out.cutoff = cutoff;
    }
    return out;
}

}  // namespace candela::realtime
