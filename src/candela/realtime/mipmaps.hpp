#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "candela/scene/material.hpp"

namespace candela::realtime {

/// What texels are, which says how they are averaged.
enum class TexelContent : std::uint8_t {
    data,     ///< each channel by itself
    color,    ///< sRGB in RGB, averaged in linear light; alpha is linear
    normals,  ///< unit vectors; levels hold the unit mean, and in alpha average_normal_texel() of its length
};

/// What alpha does to the surface.
enum class AlphaUse : std::uint8_t {
    none,    ///< an average of its own
    weight,  ///< blending: colour counts by its alpha, so that what is not seen does not bleed
    cutout,  ///< mask: as weight, and each level covers as much as level 0 does
};

struct MipOptions {
    TexelContent content = TexelContent::data;
    AlphaUse alpha = AlphaUse::none;
    float cutoff = 0.5f;  ///< of the texture's own alpha: a surface is there where alpha is no smaller
    auto operator<=>(const MipOptions&) const = default;
};

inline constexpr std::size_t kAllLevels = 32;

/// Box-filtered mip chain, level 0 first and as in the file, each level tightly packed RGBA8. The box has
/// fractional weights where a size is odd. Averages are taken in floating point from level 0 on, and rounded
/// once a level.
///
/// Cutout: alpha is scaled level by level until the part of the surface whose bilinear alpha reaches the
/// cutoff is that of level 0 (Castano 2010, "Computing Alpha Mipmaps"). Where a level is too small for that,
/// the chain ends before it: the image then has fewer levels than its size allows.
[[nodiscard]] std::vector<std::vector<std::uint8_t>> mip_chain(const scene::Image& image,
                                                               const MipOptions& options,
                                                               std::size_t max_levels = kAllLevels);

/// How the texture in a slot (TextureSlotName) of a material is to be averaged.
[[nodiscard]] MipOptions mip_options(std::size_t slot, const scene::Material& material);

}  // namespace candela::realtime
