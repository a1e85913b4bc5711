#include "candela/io/gltf_material.hpp"

#include <algorithm>

namespace candela::io {
namespace {

/// Reads members of one material; `in` is the object that holds them.
class MaterialReader {
  public:
    MaterialReader(const GltfDocument& document, Diagnostics& diagnostics)
        : document_(document), diagnostics_(diagnostics) {}

    scene::TextureRef texture(const JsonView& info) const {
        scene::TextureRef ref;
        if (!info.exists()) return ref;
        ref.texture = info["index"].required_index_below(document_.count("textures"));
        ref.uv_set =
            static_cast<std::uint32_t>(std::min<std::uint64_t>(info["texCoord"].unsigned_or(0), 1000));
        const JsonView transform = info["extensions"]["KHR_texture_transform"];
        if (transform.exists()) {
            std::array<float, 2> pair{};
            if (transform["offset"].floats(pair)) ref.offset = {pair[0], pair[1]};
            if (transform["scale"].floats(pair)) ref.scale = {pair[0], pair[1]};
            ref.rotation_rad = transform["rotation"].float_or(0.0f);
            ref.uv_set = static_cast<std::uint32_t>(
                std::min<std::uint64_t>(transform["texCoord"].unsigned_or(ref.uv_set), 1000));
        }
        if (ref.uv_set > 1) {
            diagnostics_.warn("a texture uses a UV set beyond the second: the first is used instead");
            ref.uv_set = 0;
        }
        return ref;
    }

    /// A factor that multiplies colours and the like; negative and above 1 is out of the specification.
    float factor(const JsonView& value, float fallback) const {
        const float x = value.float_or(fallback);
        if (x < 0.0f || x > 1.0f)
            diagnostics_.warn(std::string("material factors outside [0, 1] are clamped"));
        return std::clamp(x, 0.0f, 1.0f);
    }

    template <int N>
    glm::vec<N, float> color(const JsonView& value, float fallback) const {
        std::array<float, N> numbers;
        numbers.fill(fallback);
        value.floats(numbers);
        glm::vec<N, float> out;
        for (int i = 0; i < N; ++i) out[i] = std::max(numbers[static_cast<std::size_t>(i)], 0.0f);
        return out;
    }

    void core(const JsonView& m, scene::Material& out) const {
        out.name = m["name"].string_or("");
        const JsonView pbr = m["pbrMetallicRoughness"];
        out.base_color = glm::min(color<4>(pbr["baseColorFactor"], 1.0f), glm::vec4(1.0f));
        out.base_color_texture = texture(pbr["baseColorTexture"]);
        out.metallic = factor(pbr["metallicFactor"], 1.0f);
        out.perceptual_roughness = factor(pbr["roughnessFactor"], 1.0f);
        out.metallic_roughness_texture = texture(pbr["metallicRoughnessTexture"]);
        out.normal_texture = texture(m["normalTexture"]);
        out.normal_scale = m["normalTexture"]["scale"].float_or(1.0f);
        out.occlusion_texture = texture(m["occlusionTexture"]);
        out.occlusion_strength = factor(m["occlusionTexture"]["strength"], 1.0f);
        out.emissive_nit = color<3>(m["emissiveFactor"], 0.0f);
        out.emissive_texture = texture(m["emissiveTexture"]);
        const std::string mode = m["alphaMode"].string_or("OPAQUE");
        if (mode == "MASK") out.alpha_mode = scene::AlphaMode::mask;
        if (mode == "BLEND") out.alpha_mode = scene::AlphaMode::blend;
        if (mode != "OPAQUE" && mode != "MASK" && mode != "BLEND")
            m["alphaMode"].fail("must be OPAQUE, MASK or BLEND");
        out.alpha_cutoff = m["alphaCutoff"].float_or(0.5f);
        out.double_sided = m["doubleSided"].bool_or(false);
    }

    void extensions(const JsonView& e, scene::Material& out) const {
        if (!e.exists()) return;
        // The sun's disc has 1.6e9 cd/m^2; what is far beyond overflows when it is squared.
        constexpr float brightest_nit = 1e15f;
        out.emissive_nit *= std::clamp(
            e["KHR_materials_emissive_strength"]["emissiveStrength"].float_or(1.0f), 0.0f, brightest_nit);
        out.unlit = e["KHR_materials_unlit"].exists();
        out.ior = ior(e["KHR_materials_ior"]["ior"]);
        const JsonView specular = e["KHR_materials_specular"];
        out.specular = factor(specular["specularFactor"], 1.0f);
        out.specular_texture = texture(specular["specularTexture"]);
        out.specular_color = color<3>(specular["specularColorFactor"], 1.0f);
        out.specular_color_texture = texture(specular["specularColorTexture"]);
        const JsonView coat = e["KHR_materials_clearcoat"];
        out.clearcoat.factor = factor(coat["clearcoatFactor"], 0.0f);
        out.clearcoat.texture = texture(coat["clearcoatTexture"]);
        out.clearcoat.perceptual_roughness = factor(coat["clearcoatRoughnessFactor"], 0.0f);
        out.clearcoat.roughness_texture = texture(coat["clearcoatRoughnessTexture"]);
        out.clearcoat.normal_texture = texture(coat["clearcoatNormalTexture"]);
        out.clearcoat.normal_scale = coat["clearcoatNormalTexture"]["scale"].float_or(1.0f);
        const JsonView sheen = e["KHR_materials_sheen"];
        out.sheen.color = glm::min(color<3>(sheen["sheenColorFactor"], 0.0f), glm::vec3(1.0f));
        out.sheen.color_texture = texture(sheen["sheenColorTexture"]);
        out.sheen.perceptual_roughness = factor(sheen["sheenRoughnessFactor"], 0.0f);
        out.sheen.roughness_texture = texture(sheen["sheenRoughnessTexture"]);
        const JsonView anisotropy = e["KHR_materials_anisotropy"];
        out.anisotropy.strength = factor(anisotropy["anisotropyStrength"], 0.0f);
        out.anisotropy.rotation_rad = anisotropy["anisotropyRotation"].float_or(0.0f);
        out.anisotropy.texture = texture(anisotropy["anisotropyTexture"]);
        specular_glossiness(e["KHR_materials_pbrSpecularGlossiness"], out);
    }

  private:
    static float ior(const JsonView& value) {
        const float x = value.float_or(1.5f);
        if (x != 0.0f && x < 1.0f)
            value.fail("an index of refraction is 1 or more, or 0 for a perfect reflector");
        return x;
    }

    void specular_glossiness(const JsonView& e, scene::Material& out) const {
        if (!e.exists()) return;
        out.workflow = scene::Workflow::specular_glossiness;
        out.base_color = glm::min(color<4>(e["diffuseFactor"], 1.0f), glm::vec4(1.0f));
        out.base_color_texture = texture(e["diffuseTexture"]);
        out.specular_color = glm::min(color<3>(e["specularFactor"], 1.0f), glm::vec3(1.0f));
        out.metallic = 0.0f;
        out.perceptual_roughness = 1.0f - factor(e["glossinessFactor"], 1.0f);
        out.metallic_roughness_texture = texture(e["specularGlossinessTexture"]);
    }

    const GltfDocument& document_;
    Diagnostics& diagnostics_;
};

}  // namespace

scene::Material read_material(const GltfDocument& document, std::uint32_t index, Diagnostics& diagnostics) {
    const MaterialReader reader(document, diagnostics);
    const JsonView m = document.element("materials", index);
    scene::Material out;
    reader.core(m, out);
    reader.extensions(m["extensions"], out);
    return out;
}

}  // namespace candela::io
