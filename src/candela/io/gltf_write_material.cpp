#include <algorithm>
#include <cmath>

#include "candela/io/gltf_write_parts.hpp"
#include "candela/io/image_write.hpp"

namespace candela::io {
namespace {

using nlohmann::json;

json color_json(const glm::vec4& c) {
    return {c.x, c.y, c.z, c.w};
}

int wrap_code(scene::Wrap wrap) {
    switch (wrap) {
        case scene::Wrap::repeat:
            return 10497;
        case scene::Wrap::mirrored_repeat:
            return 33648;
        case scene::Wrap::clamp_to_edge:
            return 33071;
    }
    return 10497;
}

int minify_code(const scene::Sampler& s) {
    const bool linear = s.minify == scene::Filter::linear;
    switch (s.mip) {
        case scene::MipFilter::none:
            return linear ? 9729 : 9728;
        case scene::MipFilter::nearest:
            return linear ? 9985 : 9984;
        case scene::MipFilter::linear:
            return linear ? 9987 : 9986;
    }
    return 9987;
}

json sampler_json(const scene::Sampler& s) {
    return {{"wrapS", wrap_code(s.wrap_s)},
            {"wrapT", wrap_code(s.wrap_t)},
            {"magFilter", s.magnify == scene::Filter::linear ? 9729 : 9728},
            {"minFilter", minify_code(s)}};
}

/// Writes members that are not what they would be without being written.
class MaterialWriter {
  public:
    MaterialWriter(GltfTextureWriter& textures, GltfFile& file) : textures_(textures), file_(file) {}

    void texture(json& out, const char* key, const scene::TextureRef& ref) const {
        if (json info = textures_.info(ref); !info.is_null()) out[key] = std::move(info);
    }
    void texture(json& out, const char* key, const scene::TextureRef& ref, const char* factor,
                 float value) const {
        texture(out, key, ref);
        if (out.contains(key) && value != 1.0f) out[key][factor] = value;
    }
    static void number(json& out, const char* key, float value, float otherwise) {
        if (value != otherwise) out[key] = value;
    }
    static void color(json& out, const char* key, const glm::vec3& value, const glm::vec3& otherwise) {
        if (value != otherwise) out[key] = to_json(value);
    }
    void extension(json& material, const char* name, const json& content) const {
        if (content.empty()) return;
        material["extensions"][name] = content;
        file_.declare(name);
    }

    void core(const scene::Material& m, json& out) const {
        if (!m.name.empty()) out["name"] = m.name;
        if (m.workflow == scene::Workflow::metallic_roughness) {
            json pbr = json::object();
            if (m.base_color != glm::vec4(1.0f)) pbr["baseColorFactor"] = color_json(m.base_color);
            texture(pbr, "baseColorTexture", m.base_color_texture);
            number(pbr, "metallicFactor", m.metallic, 1.0f);
            number(pbr, "roughnessFactor", m.perceptual_roughness, 1.0f);
            texture(pbr, "metallicRoughnessTexture", m.metallic_roughness_texture);
            if (!pbr.empty()) out["pbrMetallicRoughness"] = pbr;
        }
        texture(out, "normalTexture", m.normal_texture, "scale", m.normal_scale);
        texture(out, "occlusionTexture", m.occlusion_texture, "strength", m.occlusion_strength);
        texture(out, "emissiveTexture", m.emissive_texture);
        if (m.alpha_mode == scene::AlphaMode::mask) out["alphaMode"] = "MASK";
        if (m.alpha_mode == scene::AlphaMode::blend) out["alphaMode"] = "BLEND";
        number(out, "alphaCutoff", m.alpha_cutoff, 0.5f);
        if (m.double_sided) out["doubleSided"] = true;
        if (m.fully_rough) out["extras"]["fullyRough"] = true;
    }

    /// emissiveFactor stays within 1, so what is beyond moves into the strength.
    void emission(const scene::Material& m, json& out) const {
        const float largest = std::max({m.emissive_nit.x, m.emissive_nit.y, m.emissive_nit.z});
        if (!(largest > 0.0f)) return;
        const float strength = covering_power_of_two(largest);
        out["emissiveFactor"] = to_json(m.emissive_nit / strength);
        if (strength != 1.0f)
            extension(out, "KHR_materials_emissive_strength", {{"emissiveStrength", strength}});
    }

    void layers(const scene::Material& m, json& out) const {
        json coat = json::object();
        number(coat, "clearcoatFactor", m.clearcoat.factor, 0.0f);
        texture(coat, "clearcoatTexture", m.clearcoat.texture);
        number(coat, "clearcoatRoughnessFactor", m.clearcoat.perceptual_roughness, 0.0f);
        texture(coat, "clearcoatRoughnessTexture", m.clearcoat.roughness_texture);
        texture(coat, "clearcoatNormalTexture", m.clearcoat.normal_texture, "scale",
                m.clearcoat.normal_scale);
        extension(out, "KHR_materials_clearcoat", coat);
        json sheen = json::object();
        color(sheen, "sheenColorFactor", m.sheen.color, glm::vec3(0.0f));
        texture(sheen, "sheenColorTexture", m.sheen.color_texture);
        number(sheen, "sheenRoughnessFactor", m.sheen.perceptual_roughness, 0.0f);
        texture(sheen, "sheenRoughnessTexture", m.sheen.roughness_texture);
        extension(out, "KHR_materials_sheen", sheen);
        json anisotropy = json::object();
        number(anisotropy, "anisotropyStrength", m.anisotropy.strength, 0.0f);
        number(anisotropy, "anisotropyRotation", m.anisotropy.rotation_rad, 0.0f);
        texture(anisotropy, "anisotropyTexture", m.anisotropy.texture);
        extension(out, "KHR_materials_anisotropy", anisotropy);
    }

    void reflection(const scene::Material& m, json& out) const {
        json ior = json::object();
        number(ior, "ior", m.ior, 1.5f);
        extension(out, "KHR_materials_ior", ior);
        json specular = json::object();
        number(specular, "specularFactor", m.specular, 1.0f);
        texture(specular, "specularTexture", m.specular_texture);
        texture(specular, "specularColorTexture", m.specular_color_texture);
        if (m.workflow == scene::Workflow::metallic_roughness) {
            color(specular, "specularColorFactor", m.specular_color, glm::vec3(1.0f));
        } else {
            json old{{"diffuseFactor", color_json(m.base_color)},
                     {"specularFactor", to_json(m.specular_color)},
                     {"glossinessFactor", 1.0 - static_cast<double>(m.perceptual_roughness)}};
            texture(old, "diffuseTexture", m.base_color_texture);
            texture(old, "specularGlossinessTexture", m.metallic_roughness_texture);
            extension(out, "KHR_materials_pbrSpecularGlossiness", old);
        }
        extension(out, "KHR_materials_specular", specular);
        if (m.unlit) {
            out["extensions"]["KHR_materials_unlit"] = json::object();
            file_.declare("KHR_materials_unlit");
        }
    }

  private:
    GltfTextureWriter& textures_;
    GltfFile& file_;
};

}  // namespace

float covering_power_of_two(float x) {
    return x <= 1.0f ? 1.0f : std::exp2(std::ceil(std::log2(x)));
}

json GltfTextureWriter::info(const scene::TextureRef& ref) {
    if (!ref) return {};
    const std::uint32_t picture = scene_.textures[ref.texture].image;
    if (picture == scene::no_index || scene_.images[picture].rgba.empty()) return {};
    json out{{"index", texture(ref.texture)}};
    if (ref.uv_set != 0) out["texCoord"] = ref.uv_set;
    json transform = json::object();
    if (ref.offset != glm::vec2(0.0f)) transform["offset"] = {ref.offset.x, ref.offset.y};
    if (ref.scale != glm::vec2(1.0f)) transform["scale"] = {ref.scale.x, ref.scale.y};
    if (ref.rotation_rad != 0.0f) transform["rotation"] = ref.rotation_rad;
    if (!transform.empty()) {
        out["extensions"]["KHR_texture_transform"] = transform;
        file_.declare("KHR_texture_transform");
    }
    return out;
}

std::size_t GltfTextureWriter::texture(std::uint32_t index) {
    const auto [entry, fresh] = textures_.try_emplace(index, 0u);
    if (fresh) {
        const scene::Texture& source = scene_.textures[index];
        const std::size_t picture = image(source.image);
        const std::size_t sampler = file_.push("samplers", sampler_json(source.sampler));
        entry->second = file_.push("textures", {{"source", picture}, {"sampler", sampler}});
    }
    return entry->second;
}

std::size_t GltfTextureWriter::image(std::uint32_t index) {
    const auto [entry, fresh] = images_.try_emplace(index, 0u);
    if (fresh) {
        json out{{"bufferView", file_.add_view(encode_png(scene_.images[index]))}, {"mimeType", "image/png"}};
        if (!scene_.images[index].name.empty()) out["name"] = scene_.images[index].name;
        entry->second = file_.push("images", std::move(out));
    }
    return entry->second;
}

json material_to_gltf(const scene::Material& material, GltfTextureWriter& textures, GltfFile& file) {
    const MaterialWriter writer(textures, file);
    json out = json::object();
    writer.core(material, out);
    writer.emission(material, out);
    writer.reflection(material, out);
    writer.layers(material, out);
    return out;
}

}  // namespace candela::io
