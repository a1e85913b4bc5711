#include "candela/measure/spheres.hpp"

#include <cmath>

#include "shading/transfer.glsl"

namespace candela::measure {
namespace {

constexpr int kGap = 6;  ///< pixels between spheres

struct Canvas {
    Panel& picture;

    void set(int x, int y, const glm::vec3& linear) {
        const glm::vec3 encoded = shading::srgb_from_linear(shading::saturate(linear));
        const std::size_t at = 3 * (std::size_t(y) * picture.width + std::size_t(x));
        for (int c = 0; c < 3; ++c)
            picture.rgb[at + std::size_t(c)] = std::uint8_t(std::lround(255.0f * encoded[c]));
    }
};

void draw(Canvas canvas, int left, int top, int diameter,
          const std::function<glm::vec3(const glm::vec3&)>& shade) {
    const float radius = 0.5f * float(diameter);
    for (int y = 0; y < diameter; ++y) {
        for (int x = 0; x < diameter; ++x) {
            const glm::vec2 at((float(x) + 0.5f - radius) / radius, (radius - float(y) - 0.5f) / radius);
            const float distance = glm::length(at);
            const float coverage = shading::saturate((1.0f - distance) * radius + 0.5f);
            if (coverage <= 0.0f) continue;
            const glm::vec2 inside = at * std::min(1.0f, 0.9995f / std::max(distance, 1e-6f));
            const glm::vec3 n(inside, std::sqrt(1.0f - glm::dot(inside, inside)));
            canvas.set(left + x, top + y, glm::mix(glm::vec3(1.0f), shading::saturate(shade(n)), coverage));
        }
    }
}

}  // namespace

Panel sphere_grid(int rows, int columns, int diameter, const ShadeSphere& shade) {
    Panel out;
    out.width = std::uint32_t(columns * (diameter + kGap) - kGap);
    out.height = std::uint32_t(rows * (diameter + kGap) - kGap);
    out.rgb.assign(std::size_t{3} * out.width * out.height, 255);
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            draw({out}, column * (diameter + kGap), row * (diameter + kGap), diameter,
                 [&](const glm::vec3& n) { return shade(row, column, n); });
        }
    }
    return out;
}

}  // namespace candela::measure
