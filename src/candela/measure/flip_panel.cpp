#include "candela/measure/flip_panel.hpp"

#include "candela/measure/color_map.hpp"
#include "candela/measure/flip.hpp"
#include "shading/transfer.glsl"

namespace candela::measure {
namespace {

Picture linear_picture(const Panel& panel) {
    Picture out{panel.width, panel.height, {}};
    for (std::size_t i = 0; i + 2 < panel.rgb.size(); i += 3) {
        const glm::vec3 encoded(panel.rgb[i], panel.rgb[i + 1], panel.rgb[i + 2]);
        out.pixels.push_back(shading::linear_from_srgb(encoded / 255.0f));
    }
    return out;
}

}  // namespace

Panel flip_panel(const Panel& x, const Panel& reference) {
    Panel out = reference;
    out.rgb.clear();
    for (const float error : flip(linear_picture(x), linear_picture(reference), pixels_per_degree()).values)
        for (const std::uint8_t c : magma(error)) out.rgb.push_back(c);
    return out;
}

}  // namespace candela::measure
