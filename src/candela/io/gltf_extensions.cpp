#include "candela/io/gltf_extensions.hpp"

#include <algorithm>
#include <iterator>
#include <set>
#include <string>

namespace candela::io {
namespace {

const std::set<std::string>& supported_extensions() {
    static const std::set<std::string> names{"KHR_lights_punctual",
                                             "EXT_lights_ies",
                                             "EXT_lights_area",
                                             "KHR_texture_transform",
                                             "KHR_materials_emissive_strength",
                                             "KHR_materials_unlit",
                                             "KHR_materials_ior",
                                             "KHR_materials_specular",
                                             "KHR_materials_clearcoat",
                                             "KHR_materials_sheen",
                                             "KHR_materials_anisotropy",
                                             "KHR_materials_pbrSpecularGlossiness",
                                             "KHR_mesh_quantization",
                                             "EXT_meshopt_compression",
                                             "EXT_mesh_gpu_instancing",
                                             "KHR_draco_mesh_compression",
                                             "EXT_texture_webp"};
    return names;
}

/// Extensions without which the geometry is still right: they add looks, sounds, behaviour or remarks to it.
/// What compresses or replaces geometry is not among them.
bool can_be_left_out(const std::string& name) {
    static constexpr const char* families[] = {"KHR_materials_",
                                               "KHR_xmp",
                                               "KHR_audio",
                                               "KHR_animation_pointer",
                                               "KHR_node_",
                                               "KHR_interactivity",
                                               "KHR_physics_",
                                               "KHR_texture_",
                                               "KHR_techniques_webgl",
                                               "KHR_lights_",
                                               "EXT_materials_",
                                               "EXT_lights_",
                                               "EXT_texture_",
                                               "EXT_structural_metadata",
                                               "EXT_feature_metadata",
                                               "EXT_mesh_features",
                                               "EXT_instance_features",
                                               "EXT_mesh_manifold",
                                               "MSFT_lod",
                                               "MSFT_packing_",
                                               "MSFT_texture_dds",
                                               "MSFT_audio_",
                                               "MSFT_collision",
                                               "MSFT_physics",
                                               "ADOBE_materials_",
                                               "AGI_",
                                               "CESIUM_primitive_outline",
                                               "FB_",
                                               "GOOGLE_",
                                               "GRIFFEL_",
                                               "OMI_",
                                               "VRM",
                                               "VRMC_",
                                               "MPEG_",
                                               "NV_materials_",
                                               "WEB3D_"};
    return std::any_of(std::begin(families), std::end(families),
                       [&](const char* family) { return name.starts_with(family); });
}

}  // namespace

void check_extensions(const GltfDocument& document, Diagnostics& diagnostics) {
    constexpr std::size_t max_named = 16;
    std::set<std::string> required;
    const JsonView list = document.array("extensionsRequired");
    for (std::size_t i = 0; i < list.size(); ++i) {
        const std::string name = list[i].string_or("");
        if (supported_extensions().contains(name)) continue;
        if (!can_be_left_out(name)) list[i].fail("the scene requires " + name + ", which is not supported");
        required.insert(name);
        list[i].repaired("the scene requires " + name + ", which is not supported: drawn without it");
    }
    std::set<std::string> unknown;
    const JsonView used = document.array("extensionsUsed");
    for (std::size_t i = 0; i < used.size(); ++i) {
        const std::string name = used[i].string_or("");
        if (supported_extensions().contains(name) || required.contains(name) || !unknown.insert(name).second)
            continue;
        if (unknown.size() <= max_named) diagnostics.warn("extension " + name + " is not supported: ignored");
    }
    if (unknown.size() > max_named)
        diagnostics.warn(std::to_string(unknown.size() - max_named) + " more extensions are not supported");
}

}  // namespace candela::io
