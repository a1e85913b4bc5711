#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "candela/scene/index.hpp"

namespace candela::scene {

/// Decoded picture, 4 x 8 bit RGBA, row 0 on top, as stored in the file (no transfer function applied).
struct Image {
    std::string name;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::uint8_t> rgba;  ///< width * height * 4
};

enum class Wrap : std::uint8_t { repeat, mirrored_repeat, clamp_to_edge };
enum class Filter : std::uint8_t { nearest, linear };
enum class MipFilter : std::uint8_t { none, nearest, linear };

struct Sampler {
    Wrap wrap_s = Wrap::repeat;
    Wrap wrap_t = Wrap::repeat;
    Filter magnify = Filter::linear;
    Filter minify = Filter::linear;
    MipFilter mip = MipFilter::linear;
    bool operator==(const Sampler&) const = default;
};

struct Texture {
    std::uint32_t image = no_index;  ///< index into Scene::images
    Sampler sampler;
};

/// A use of a texture by a material. uv' = offset + rotate(rotation_rad) * (scale * uv), as
/// KHR_texture_transform.
struct TextureRef {
    std::uint32_t texture = no_index;  ///< index into Scene::textures
    std::uint32_t uv_set = 0;
    glm::vec2 offset{0.0f};
    glm::vec2 scale{1.0f};
    float rotation_rad = 0.0f;  ///< counter-clockwise, as KHR_texture_transform defines it
    [[nodiscard]] explicit operator bool() const noexcept { return texture != no_index; }
};

enum class AlphaMode : std::uint8_t { opaque, mask, blend };

/// How base_color and the metallic-roughness slots are to be read.
enum class Workflow : std::uint8_t {
    metallic_roughness,   ///< glTF core
    specular_glossiness,  ///< KHR_materials_pbrSpecularGlossiness: base_color is the diffuse colour,
                          ///< specular_color the coloured f0, perceptual_roughness is 1 - glossiness;
                          ///< metallic_roughness_texture holds specular (sRGB) in RGB and glossiness in A
};

struct Clearcoat {
    float factor = 0.0f;
    TextureRef texture;  ///< R
    float perceptual_roughness = 0.0f;
    TextureRef roughness_texture;  ///< G
    TextureRef normal_texture;
    float normal_scale = 1.0f;
};

struct Sheen {
    glm::vec3 color{0.0f};
    TextureRef color_texture;  ///< sRGB RGB
    float perceptual_roughness = 0.0f;
    TextureRef roughness_texture;  ///< A
};

struct Anisotropy {
    float strength = 0.0f;
    float rotation_rad = 0.0f;  ///< counter-clockwise from the tangent
    TextureRef texture;         ///< RG direction in [-1,1], B strength
};

/// Colours are linear Rec.709. Factors multiply their textures, as glTF 2.0 and the KHR_materials_*
/// extensions say.
struct Material {
    std::string name;
    Workflow workflow = Workflow::metallic_roughness;

    glm::vec4 base_color{1.0f};
    TextureRef base_color_texture;  ///< sRGB RGB, linear A
    float metallic = 1.0f;
    float perceptual_roughness = 1.0f;
    TextureRef metallic_roughness_texture;  ///< G perceptual roughness, B metallic

    TextureRef normal_texture;
    float normal_scale = 1.0f;
    TextureRef occlusion_texture;  ///< R
    float occlusion_strength = 1.0f;

    glm::vec3 emissive_nit{0.0f};  ///< emissiveFactor * emissiveStrength, luminance in cd/m^2 for RGB 1
    TextureRef emissive_texture;   ///< sRGB RGB

    float ior = 1.5f;             ///< KHR_materials_ior; 0 means infinite (f0 = 1)
    float specular = 1.0f;        ///< KHR_materials_specular
    TextureRef specular_texture;  ///< A
    glm::vec3 specular_color{1.0f};
    TextureRef specular_color_texture;  ///< sRGB RGB

    Clearcoat clearcoat;
    Sheen sheen;
    Anisotropy anisotropy;

    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha_cutoff = 0.5f;
    bool double_sided = false;
    bool unlit = false;
    /// To be shaded without highlights where the profile asks for it (Karis 2014): see is_fully_rough().
    bool fully_rough = false;
};

/// Which materials a profile shades without a specular lobe (shading/fully_rough.glsl).
enum class FullyRoughRule : std::uint8_t {
    none,
    flagged,      ///< those that say so, as Karis 2014 has it
    roughness_1,  ///< these, and those of roughness 1 without a texture for it
    all
};

[[nodiscard]] inline bool is_fully_rough(const Material& m, FullyRoughRule rule) noexcept {
    if (m.unlit || rule == FullyRoughRule::none) return false;
    const bool constant_1 = m.perceptual_roughness >= 1.0f && !m.metallic_roughness_texture;
    return rule == FullyRoughRule::all || m.fully_rough ||
           (rule == FullyRoughRule::roughness_1 && constant_1);
}

}  // namespace candela::scene
