#include "candela/measure/color_map.hpp"

#include <algorithm>
#include <cmath>

namespace candela::measure {

Rgb8 magma(float error) {
    constexpr std::array<std::array<float, 3>, 18> knots{{{0.001462f, 0.000466f, 0.013866f},
                                                          {0.035520f, 0.028397f, 0.125209f},
                                                          {0.102815f, 0.063010f, 0.257854f},
                                                          {0.191460f, 0.064818f, 0.396152f},
                                                          {0.291366f, 0.064553f, 0.475462f},
                                                          {0.384299f, 0.097855f, 0.501002f},
                                                          {0.475780f, 0.134577f, 0.507921f},
                                                          {0.569172f, 0.167454f, 0.504105f},
                                                          {0.664915f, 0.198075f, 0.488836f},
                                                          {0.761077f, 0.231214f, 0.460162f},
                                                          {0.852126f, 0.276106f, 0.418573f},
                                                          {0.925937f, 0.346844f, 0.374959f},
                                                          {0.969680f, 0.446936f, 0.360311f},
                                                          {0.989363f, 0.557873f, 0.391671f},
                                                          {0.996580f, 0.668256f, 0.456192f},
                                                          {0.996727f, 0.776795f, 0.541039f},
                                                          {0.992440f, 0.884330f, 0.640099f},
                                                          {0.987053f, 0.991438f, 0.749504f}}};
    if (std::isnan(error)) return {0, 255, 0};
    const float position = std::clamp(error, 0.0f, 1.0f) * float(knots.size() - 1);
    const std::size_t below = std::min(static_cast<std::size_t>(position), knots.size() - 2);
    const float t = position - float(below);
    Rgb8 out{};
    for (std::size_t c = 0; c < 3; ++c)
        out[c] = static_cast<std::uint8_t>(
            255.0f * (knots[below][c] + t * (knots[below + 1][c] - knots[below][c])) + 0.5f);
    return out;
}

}  // namespace candela::measure
