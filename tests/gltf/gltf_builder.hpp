#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "candela/io/gltf.hpp"
#include "candela/scene/error.hpp"

namespace candela::test {

using nlohmann::json;

template <class T>
struct ComponentType;
template <>
struct ComponentType<std::int8_t> : std::integral_constant<int, 5120> {};
template <>
struct ComponentType<std::uint8_t> : std::integral_constant<int, 5121> {};
template <>
struct ComponentType<std::int16_t> : std::integral_constant<int, 5122> {};
template <>
struct ComponentType<std::uint16_t> : std::integral_constant<int, 5123> {};
template <>
struct ComponentType<std::uint32_t> : std::integral_constant<int, 5125> {};
template <>
struct ComponentType<float> : std::integral_constant<int, 5126> {};

/// A glTF document in the making: `doc` is free to be changed, and broken, by hand.
struct GltfBuilder {
    json doc = {{"asset", {{"version", "2.0"}}}};
    std::vector<std::byte> binary;

    int view(std::span<const std::byte> bytes, int stride = 0) {
        while (binary.size() % 4 != 0) binary.push_back(std::byte{0});
        json v = {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}};
        if (stride > 0) v["byteStride"] = stride;
        binary.insert(binary.end(), bytes.begin(), bytes.end());
        return push("bufferViews", v);
    }
    /// Numbers as they lie in the file; `columns` of `type` a row.
    template <class T>
    int accessor(const std::vector<T>& numbers, const std::string& type, std::size_t columns,
                 bool normalized = false) {
        json a = {{"bufferView", view(std::as_bytes(std::span(numbers)))},
                  {"componentType", ComponentType<T>::value},
                  {"count", numbers.size() / columns},
                  {"type", type}};
        if (normalized) a["normalized"] = true;
        return push("accessors", a);
    }
    int push(const std::string& list, const json& element) {
        doc[list].push_back(element);
        return static_cast<int>(doc[list].size()) - 1;
    }
    /// One mesh of one primitive on one node of the only scene.
    void show(const json& primitive) {
        push("meshes", {{"primitives", json::array({primitive})}});
        push("nodes", {{"mesh", 0}});
        doc["scenes"] = {{{"nodes", {0}}}};
    }
    [[nodiscard]] std::string glb() const {
        json with_buffer = doc;
        if (!binary.empty() && !doc.contains("buffers"))
            with_buffer["buffers"] = {{{"byteLength", binary.size()}}};
        return pack(with_buffer.dump(-1, ' ', false, json::error_handler_t::replace), binary);
    }
    [[nodiscard]] static std::string pack(std::string text, std::span<const std::byte> bin) {
        while (text.size() % 4 != 0) text += ' ';
        std::string padded(reinterpret_cast<const char*>(bin.data()), bin.size());
        while (padded.size() % 4 != 0) padded += '\0';
        std::string out = "glTF";
        const auto word = [&](std::size_t w) {
            const auto narrow = static_cast<std::uint32_t>(w);
            out.append(reinterpret_cast<const char*>(&narrow), 4);
        };
        word(2);
        word(12 + 8 + text.size() + (bin.empty() ? 0 : 8 + padded.size()));
        word(text.size());
        out += "JSON" + text;
        if (!bin.empty()) {
            word(padded.size());
            out += std::string("BIN\0", 4) + padded;
        }
        return out;
    }
};

/// One triangle in the xy plane, facing +Z, with indices.
inline GltfBuilder triangle() {
    GltfBuilder b;
    const int positions = b.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 3);
    const int indices = b.accessor<std::uint16_t>({0, 1, 2}, "SCALAR", 1);
    b.show({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
    return b;
}

inline scene::Scene load(const GltfBuilder& b, Diagnostics& diagnostics, io::GltfOptions options = {}) {
    const std::string bytes = b.glb();
    return io::load_gltf_from_memory(std::as_bytes(std::span(bytes)), "test.glb", options, diagnostics);
}

inline scene::Scene load(const GltfBuilder& b, io::GltfOptions options = {}) {
    Diagnostics ignored;
    return load(b, ignored, options);
}

inline std::string error_of(const GltfBuilder& b) {
    try {
        (void)load(b);
    } catch (const Error& error) {
        return error.line();
    }
    return "no error";
}

inline const scene::Primitive& only_primitive(const scene::Scene& s) {
    return s.meshes.at(0).primitives.at(0);
}

inline bool near(const glm::vec3& a, const glm::vec3& b, float tolerance = 1e-5f) {
    return std::abs(a.x - b.x) <= tolerance && std::abs(a.y - b.y) <= tolerance &&
           std::abs(a.z - b.z) <= tolerance;
}

}  // namespace candela::test
