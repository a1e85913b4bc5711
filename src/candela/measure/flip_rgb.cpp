#include "candela/measure/flip_rgb.hpp"

#include "candela/measure/flip.hpp"
#include "shading/transfer.glsl"

namespace candela::measure {
namespace {

Picture linear_picture(std::span<const std::uint8_t> rgb, std::uint32_t width, std::uint32_t height) {
    Picture out{width, height, {}};
    for (std::size_t i = 0; i + 2 < rgb.size(); i += 3) {
        const glm::vec3 encoded(rgb[i], rgb[i + 1], rgb[i + 2]);
        out.pixels.push_back(shading::linear_from_srgb(encoded / 255.0f));
    }
    return out;
}

}  // namespace

double mean_flip_of_srgb(std::span<const std::uint8_t> x, std::span<const std::uint8_t> reference,
                         std::uint32_t width, std::uint32_t height) {
    return mean(flip(linear_picture(x, width, height), linear_picture(reference, width, height),
                     pixels_per_degree()));
}

}  // namespace candela::measure
