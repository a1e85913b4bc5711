#include "candela/bake/filter_harmonic.hpp"

#include <algorithm>
#include <cmath>

namespace candela::bake {
namespace {

/// Where the work of harmonics, which grows with the square, passes that of points.
constexpr float kNarrowAlpha = 0.01f;

TexelNodes texel_nodes(float alpha, std::uint32_t size, TexelValue texel) {
    if (texel == TexelValue::center) return TexelNodes::center();
    // A texel that spans the sphere sees the horizon of the lobe, too.
    if (size <= 8) return TexelNodes::gauss(32 / size);
    const float texels_in_lobe = alpha * static_cast<float>(size);
    return TexelNodes::gauss(static_cast<std::uint32_t>(std::ceil(std::max(1.8f / texels_in_lobe, 1.0f))));
}

}  // namespace

Harmonics analyze_for(const EquirectLight& light, float least_alpha) {
    const std::uint32_t degree = ld_degree(least_alpha);
    // A degree needs rows: where the map has too few, of the same bilinear function.
    const std::uint32_t factor = (degree * 5 / 4 + light.height - 1) / light.height;
    return factor > 1 ? analyze(refined(light, factor), degree) : analyze(light, degree);
}

bool is_narrow(float alpha) {
    return alpha < kNarrowAlpha;
}

scene::CubeMap sample_cube(const LobeField& field, float rotation_rad, float alpha, std::uint32_t size,
                           TexelValue texel) {
    return cube_of(size, texel_nodes(alpha, size, texel), rotation_rad,
                   [&](Directions& directions) { field.evaluate(directions); });
}

}  // namespace candela::bake
