#include "candela/io/gltf_material.hpp"

#include <algorithm>
#include <set>

namespace candela::io {
namespace {

constexpr std::uint32_t kMostUvSets = 1000;

/// Reads members of one material; `in` is the object that holds them.
class MaterialReader {
  public:
    explicit MaterialReader(const GltfDocument& document) : document_(document) {}

    scene::TextureRef texture(const JsonView& info) const {
        scene::TextureRef ref;
        if (!info.exists()) return ref;
        if (!info["index"].exists()) info.repaired("names no texture: read as absent");
        const auto texture = info["index"].index_below(document_.count("textures"));
        if (!texture) return ref;
        ref.texture = *texture;
        ref.uv_set = uv_set(info["texCoord"], 0);
        const JsonView transform = info["extensions"]["KHR_texture_transform"];
        if (transform.exists()) {
            std::array<float, 2> pair{};
            if (transform["offset"].floats(pair)) ref.offset = {pair[0], pair[1]};
            if (transform["scale"].floats(pair)) ref.scale = {pair[0], pair[1]};
            ref.rotation_rad = transform["rotation"].float_or(0.0f);
            ref.uv_set = uv_set(transform["texCoord"], ref.uv_set);
        }
        return ref;
    }

    /// A factor that multiplies colours and the like; negative and above 1 is out of the specification.
    float factor(const JsonView& value, float fallback) const {
        const float x = value.float_or(fallback);
        if (x < 0.0f || x > 1.0f) value.repaired("material factors outside [0, 1] are clamped");
        return std::clamp(x, 0.0f, 1.0f);
    }

    template <int N>
    glm::vec<N, float> color(const JsonView& value, float fallback) const {
        std::array<float, N> numbers;
        numbers.fill(fallback);
        value.leading_floats(numbers);
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
        const std::string mode = m["alphaMode"].one_of({"OPAQUE", "MASK", "BLEND"});
        if (mode == "MASK") out.alpha_mode = scene::AlphaMode::mask;
        if (mode == "BLEND") out.alpha_mode = scene::AlphaMode::blend;
        out.alpha_cutoff = m["alphaCutoff"].float_or(0.5f);
        out.double_sided = m["doubleSided"].bool_or(false);
        // Extras are the file's own business: what has another form means something else.
        out.fully_rough = m["extras"].has_true("fullyRough");
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
        if (x == 0.0f || x >= 1.0f) return x;
        value.repaired("an index of refraction is 1 or more, or 0 for a perfect reflector: read as 1");
        return 1.0f;
    }

    static std::uint32_t uv_set(const JsonView& value, std::uint32_t fallback) {
        return static_cast<std::uint32_t>(
            std::min<std::uint64_t>(value.optional_unsigned().value_or(fallback), kMostUvSets));
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
};

}  // namespace

std::array<scene::TextureRef*, 13> texture_refs(scene::Material& m) {
    return {&m.base_color_texture,       &m.metallic_roughness_texture, &m.normal_texture,
            &m.occlusion_texture,        &m.emissive_texture,           &m.specular_texture,
            &m.specular_color_texture,   &m.clearcoat.texture,          &m.clearcoat.roughness_texture,
            &m.clearcoat.normal_texture, &m.sheen.color_texture,        &m.sheen.roughness_texture,
            &m.anisotropy.texture};
}

GltfMaterials::GltfMaterials(const GltfDocument& document, scene::Scene& scene)
    : document_(document),
      scene_(scene),
      materials_(document.count("materials")),
      textures_(document.count("textures"), false) {
    scene.materials.resize(materials_.size());
    scene.textures.resize(textures_.size());
    scene.images.resize(document.count("images"));
}

const UvSets& GltfMaterials::uv_sets(std::uint32_t index) {
    static constexpr UvSets first_two{0, 1};
    if (index == scene::no_index) return first_two;
    std::optional<UvSets>& sets = materials_.at(index);
    if (sets) return *sets;
    const MaterialReader reader(document_);
    const JsonView source = document_.element("materials", index);
    scene::Material& material = scene_.materials[index];
    reader.core(source, material);
    reader.extensions(source["extensions"], material);
    for (const scene::TextureRef* ref : texture_refs(material)) {
        if (!*ref || textures_[ref->texture]) continue;
        textures_[ref->texture] = true;
        scene_.textures[ref->texture] = read_texture(document_, ref->texture);
    }
    sets = assign_uv_sets(material, source);
    return *sets;
}

UvSets GltfMaterials::assign_uv_sets(scene::Material& material, const JsonView& source) const {
    std::set<std::uint32_t> used;
    for (const scene::TextureRef* ref : texture_refs(material)) {
        if (*ref) used.insert(ref->uv_set);
    }
    if (used.empty() || *used.rbegin() <= 1) return {0, 1};
    const std::uint32_t first = *used.begin();
    const UvSets sets{first, used.size() > 1 ? *std::next(used.begin()) : 0};
    if (used.size() > 2)
        source.repaired(
            "uses more than two sets of texture coordinates: the further ones are read as its first");
    for (scene::TextureRef* ref : texture_refs(material))
        ref->uv_set = ref->uv_set == sets[1] && sets[1] != first;
    return sets;
}

}  // namespace candela::io
