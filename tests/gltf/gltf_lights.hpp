#pragma once

#include "gltf_builder.hpp"

/// Scenes whose lights come from the extensions.
namespace candela::test {

/// An absolute profile: 100 cd straight ahead, 50 cd at 90 degrees, nothing behind. Its peak is its aim.
inline std::string small_ies() {
    return "IESNA:LM-63-2002\r\n[TEST] 1\r\n[LUMINAIRE] Small\r\nTILT=NONE\r\n"
           "1 -1 1 3 1 1 2 0 0 0\r\n1 1 10\r\n0 90 180\r\n0\r\n100 50 0\r\n";
}

/// The triangle, and `light` of an extension on a second node that shines down and is scaled by (2, -3, 1).
inline GltfBuilder lit_by(const char* extension, const json& light, const json& use = json::object()) {
    GltfBuilder b = triangle();
    b.doc["extensionsUsed"] = {extension};
    b.doc["extensions"][extension]["lights"] = json::array({light});
    json node_use = use;
    if (!node_use.contains("light")) node_use["light"] = 0;
    const float half = std::sqrt(0.5f);
    const int node = b.push("nodes", {{"name", "Lamp"},
                                      {"translation", {1, 2, 3}},
                                      {"rotation", {-half, 0, 0, half}},
                                      {"scale", {2, -3, 1}},
                                      {"extensions", {{extension, node_use}}}});
    b.doc["scenes"][0]["nodes"].push_back(node);
    return b;
}

/// By a profile in a buffer view.
inline GltfBuilder lit_by_profile(const std::string& ies, const json& use = json::object()) {
    GltfBuilder b = lit_by("EXT_lights_ies", json::object(), use);
    const int view = b.view(std::as_bytes(std::span(ies.data(), ies.size())));
    b.doc["extensions"]["EXT_lights_ies"]["lights"][0] = {{"bufferView", view},
                                                          {"mimeType", "application/x-ies-lm-63"}};
    return b;
}

}  // namespace candela::test
