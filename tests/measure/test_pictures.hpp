#pragma once

#include <cmath>
#include <functional>

#include "candela/measure/picture.hpp"

namespace candela::test {

inline measure::Picture uniform(std::uint32_t width, std::uint32_t height, glm::vec3 value) {
    return {width, height, std::vector<glm::vec3>(std::size_t{width} * height, value)};
}

inline measure::Picture draw(std::uint32_t width, std::uint32_t height,
                             const std::function<glm::vec3(int, int)>& value) {
    measure::Picture out = uniform(width, height, glm::vec3(0.0f));
    for (int y = 0; y < int(height); ++y)
        for (int x = 0; x < int(width); ++x)
            out.pixels[std::size_t(y) * width + std::size_t(x)] = value(x, y);
    return out;
}

/// Something with edges, colours and a gradient, in [0,1].
inline measure::Picture motley(std::uint32_t width, std::uint32_t height) {
    return draw(width, height, [&](int x, int y) {
        const float u = float(x) / float(width), v = float(y) / float(height);
        const bool square = (x / 8 + y / 8) % 2 == 0;
        return glm::vec3(square ? 0.8f : 0.1f, 0.5f + 0.4f * std::sin(9.0f * u), v);
    });
}

/// Mean over a square of (2 radius + 1)^2, borders replicated.
inline measure::Picture blurred(const measure::Picture& in, int radius) {
    const int w = int(in.width), h = int(in.height);
    return draw(in.width, in.height, [&](int x, int y) {
        glm::vec3 sum(0.0f);
        for (int j = -radius; j <= radius; ++j)
            for (int i = -radius; i <= radius; ++i) {
                const int px = std::min(std::max(x + i, 0), w - 1), py = std::min(std::max(y + j, 0), h - 1);
                sum += in.pixels[std::size_t(py) * in.width + std::size_t(px)];
            }
        return sum / float((2 * radius + 1) * (2 * radius + 1));
    });
}

}  // namespace candela::test
