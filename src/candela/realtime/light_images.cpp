#include "candela/realtime/light_images.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/vec3.hpp>

#include "shading/transfer.glsl"

namespace candela::realtime {
namespace {

constexpr std::uint32_t kMostTexels = 256;

struct Level {
    int width = 1;
    int height = 1;
    std::vector<glm::vec3> texels;

    [[nodiscard]] const glm::vec3& at(int x, int y) const {
        return texels[static_cast<std::size_t>(std::clamp(y, 0, height - 1)) *
                          static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(std::clamp(x, 0, width - 1))];
    }
};

Level linear(const scene::Image& image) {
    Level level{static_cast<int>(image.width), static_cast<int>(image.height), {}};
    std::array<float, 256> decode{};
    for (std::size_t i = 0; i < decode.size(); ++i)
        decode[i] = shading::linear_from_srgb(static_cast<float>(i) / 255.0f);
    level.texels.resize(image.rgba.size() / 4);
    for (std::size_t i = 0; i < level.texels.size(); ++i) {
        level.texels[i] = {decode[image.rgba[4 * i]], decode[image.rgba[4 * i + 1]],
                           decode[image.rgba[4 * i + 2]]};
    }
    return level;
}

/// Share of [first, first + 1) in [from, to).
float overlap(int first, double from, double to) {
    return static_cast<float>(std::max(0.0, std::min(to, first + 1.0) - std::max(from, double(first))));
}

/// Means over equal parts, along x; across: along y.
Level resampled(const Level& from, int size, bool across) {
    Level to{across ? from.width : size, across ? size : from.height, {}};
    const int length = across ? from.height : from.width;
    const double part = double(length) / size;
    to.texels.assign(static_cast<std::size_t>(to.width) * static_cast<std::size_t>(to.height),
                     glm::vec3(0.0f));
    for (int y = 0; y < to.height; ++y) {
        for (int x = 0; x < to.width; ++x) {
            const double begin = (across ? y : x) * part;
            glm::vec3 sum(0.0f);
            for (int i = static_cast<int>(begin); i < std::min(double(length), begin + part); ++i)
                sum += (across ? from.at(x, i) : from.at(i, y)) * overlap(i, begin, begin + part);
            to.texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(to.width) +
                      static_cast<std::size_t>(x)] = sum / static_cast<float>(part);
        }
    }
    return to;
}

/// Half the size by the binomial weights 1 3 3 1: smooth where a mean of two would leave steps.
Level halved(const Level& from) {
    constexpr std::array weights{0.125f, 0.375f, 0.375f, 0.125f};
    Level to{from.width / 2, from.height / 2, {}};
    for (int y = 0; y < to.height; ++y) {
        for (int x = 0; x < to.width; ++x) {
            glm::vec3 sum(0.0f);
            for (int j = 0; j < 4; ++j) {
                for (int i = 0; i < 4; ++i)
                    sum += from.at(2 * x + i - 1, 2 * y + j - 1) *
                           (weights[static_cast<std::size_t>(i)] * weights[static_cast<std::size_t>(j)]);
            }
            to.texels.push_back(sum);
        }
    }
    return to;
}

void append(ImagePyramid& pyramid, const Level& level) {
    for (const glm::vec3& t : level.texels) pyramid.rgb.insert(pyramid.rgb.end(), {t.x, t.y, t.z});
}

}  // namespace

ImagePyramid image_pyramid(const scene::Image& image) {
    if (image.rgba.empty()) return {1, {1.0f, 1.0f, 1.0f}};
    ImagePyramid pyramid;
    pyramid.size =
        static_cast<int>(std::min(kMostTexels, std::bit_ceil(std::max(image.width, image.height))));
    const Level whole = resampled(resampled(linear(image), pyramid.size, false), pyramid.size, true);
    Level level = whole;
    append(pyramid, level);
    while (level.width > 1) {
        level = level.width > 2 ? halved(level) : resampled(resampled(whole, 1, false), 1, true);
        append(pyramid, level);
    }
    return pyramid;
}

}  // namespace candela::realtime
