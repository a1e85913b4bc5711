#pragma once

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <meshoptimizer.h>
#include <png.h>
#include <webp/encode.h>

#include <stdexcept>

#include "gltf_builder.hpp"

/// Small scenes that use one feature each; the tests look at them and the fuzzer starts from them.
namespace candela::test {

/// 2 x 2 texels: red, green, blue, white, alpha 255.
inline std::vector<unsigned char> four_texels() {
    return {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255};
}

inline std::vector<std::byte> png_of_four_texels() {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = image.height = 2;
    image.format = PNG_FORMAT_RGBA;
    std::vector<std::byte> out(4096);
    png_alloc_size_t size = out.size();
    if (png_image_write_to_memory(&image, out.data(), &size, 0, four_texels().data(), 8, nullptr) == 0)
        throw std::runtime_error("libpng cannot write");
    out.resize(size);
    return out;
}

inline std::vector<std::byte> webp_of_four_texels() {
    std::uint8_t* data = nullptr;
    const std::size_t size = WebPEncodeLosslessRGBA(four_texels().data(), 2, 2, 8, &data);
    std::vector<std::byte> out(size);
    std::memcpy(out.data(), data, size);
    WebPFree(data);
    return out;
}

inline json& primitive_of(GltfBuilder& b) {
    return b.doc["meshes"][0]["primitives"][0];
}

/// The triangle with normals, UVs and `material`.
inline GltfBuilder with_material(const json& material) {
    GltfBuilder b = triangle();
    json& attributes = primitive_of(b)["attributes"];
    attributes["NORMAL"] = b.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3);
    attributes["TEXCOORD_0"] = b.accessor<float>({0, 0, 1, 0, 0, 1}, "VEC2", 2);
    attributes["TEXCOORD_1"] = b.accessor<float>({0, 0, 0.5, 0, 0, 0.5}, "VEC2", 2);
    primitive_of(b)["material"] = b.push("materials", material);
    return b;
}

inline void add_texture(GltfBuilder& b, const std::vector<std::byte>& picture) {
    const int image = b.push("images", {{"bufferView", b.view(picture)}});
    b.push("textures", {{"source", image}});
}

/// One animation channel of node 0.
inline void animate(GltfBuilder& b, const char* path, const char* mode, const std::vector<float>& times,
                    const std::vector<float>& values, const char* type, std::size_t columns) {
    const int input = b.accessor<float>(times, "SCALAR", 1);
    const int output = b.accessor<float>(values, type, columns);
    b.push("animations", {{"samplers", {{{"input", input}, {"output", output}, {"interpolation", mode}}}},
                          {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}}}});
}

/// The triangle bound half to node 0's world and half to node 1's: vertex 1 follows joint 1 alone.
inline GltfBuilder skinned() {
    GltfBuilder b = triangle();
    json& attributes = primitive_of(b)["attributes"];
    attributes["JOINTS_0"] = b.accessor<std::uint8_t>({0, 1, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, "VEC4", 4);
    attributes["WEIGHTS_0"] = b.accessor<float>({1, 0, 0, 0, 1, 0, 0, 0, 0.5, 0.5, 0, 0}, "VEC4", 4);
    std::vector<float> bind(32, 0.0f);
    for (const std::size_t i : {0u, 5u, 10u, 15u, 16u, 21u, 26u, 31u}) bind[i] = 1.0f;
    bind[28] = -1.0f;  // joint 1 was at x = 1 when bound
    const int matrices = b.accessor<float>(bind, "MAT4", 16);
    b.push("nodes", {{"translation", {1, 0, 0}}, {"children", {2}}});
    b.push("nodes", {{"translation", {1, 2, 0}}});
    b.push("skins", {{"joints", {1, 2}}, {"inverseBindMatrices", matrices}});
    b.doc["nodes"][0]["skin"] = 0;
    b.doc["nodes"][0]["translation"] = {50, 50, 50};  // ignored: a skin places its mesh
    b.doc["scenes"][0]["nodes"] = {0, 1};
    return b;
}

inline GltfBuilder morphed() {
    GltfBuilder b = triangle();
    primitive_of(b)["targets"] = {{{"POSITION", b.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3)}},
                                  {{"POSITION", b.accessor<float>({4, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC3", 3)}}};
    b.doc["meshes"][0]["weights"] = {0.5, 0.0};
    return b;
}

/// A strip of `quads` squares along +x, only in Draco.
inline GltfBuilder draco_strip(int quads) {
    draco::TriangleSoupMeshBuilder soup;
    soup.Start(2 * quads);
    const int position = soup.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    for (int q = 0; q < quads; ++q) {
        const auto x = static_cast<float>(q);
        const float a[3] = {x, 0, 0}, c[3] = {x + 1, 0, 0}, d[3] = {x + 1, 1, 0}, e[3] = {x, 1, 0};
        soup.SetAttributeValuesForFace(position, draco::FaceIndex(static_cast<std::uint32_t>(2 * q)), a, c,
                                       d);
        soup.SetAttributeValuesForFace(position, draco::FaceIndex(static_cast<std::uint32_t>(2 * q + 1)), a,
                                       d, e);
    }
    const std::unique_ptr<draco::Mesh> mesh = soup.Finalize();
    draco::Encoder encoder;
    encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 16);
    draco::EncoderBuffer buffer;
    if (!encoder.EncodeMeshToBuffer(*mesh, &buffer).ok()) throw std::runtime_error("draco cannot encode");
    GltfBuilder b;
    const int view = b.view(std::as_bytes(std::span(buffer.data(), buffer.size())));
    const int positions =
        b.push("accessors", {{"componentType", 5126}, {"count", 2 * quads + 2}, {"type", "VEC3"}});
    const int indices =
        b.push("accessors", {{"componentType", 5125}, {"count", 6 * quads}, {"type", "SCALAR"}});
    const std::uint32_t id = mesh->attribute(position)->unique_id();
    b.show({{"attributes", {{"POSITION", positions}}},
            {"indices", indices},
            {"extensions",
             {{"KHR_draco_mesh_compression", {{"bufferView", view}, {"attributes", {{"POSITION", id}}}}}}}});
    b.doc["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    return b;
}

/// The triangle's positions only in EXT_meshopt_compression.
inline GltfBuilder meshopt_triangle() {
    GltfBuilder b = triangle();
    const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    std::vector<unsigned char> packed(meshopt_encodeVertexBufferBound(3, 12));
    packed.resize(meshopt_encodeVertexBuffer(packed.data(), packed.size(), corners, 3, 12));
    const int holder = b.view(std::as_bytes(std::span(packed)));
    b.doc["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = {
        {"buffer", 0},
        {"byteOffset", b.doc["bufferViews"][static_cast<std::size_t>(holder)]["byteOffset"]},
        {"byteLength", packed.size()},
        {"byteStride", 12},
        {"count", 3},
        {"mode", "ATTRIBUTES"}};
    return b;
}

inline GltfBuilder everything_in_a_material() {
    const json t = {{"index", 0},
                    {"texCoord", 1},
                    {"extensions",
                     {{"KHR_texture_transform",
                       {{"offset", {0.25, 0.5}}, {"rotation", 0.5}, {"scale", {2, 3}}, {"texCoord", 0}}}}}};
    GltfBuilder b = with_material(
        {{"name", "all"},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}},
           {"baseColorTexture", t},
           {"metallicFactor", 0.25},
           {"roughnessFactor", 0.75}}},
         {"normalTexture", {{"index", 0}, {"scale", 0.5}}},
         {"emissiveFactor", {1, 0.5, 0}},
         {"alphaMode", "BLEND"},
         {"doubleSided", true},
         {"extensions",
          {{"KHR_materials_emissive_strength", {{"emissiveStrength", 100}}},
           {"KHR_materials_ior", {{"ior", 1.33}}},
           {"KHR_materials_specular", {{"specularFactor", 0.5}, {"specularColorFactor", {1, 0.5, 2}}}},
           {"KHR_materials_clearcoat",
            {{"clearcoatFactor", 0.5},
             {"clearcoatRoughnessFactor", 0.25},
             {"clearcoatNormalTexture", {{"index", 0}, {"scale", 2}}}}},
           {"KHR_materials_sheen", {{"sheenColorFactor", {0.1, 0.2, 0.3}}, {"sheenRoughnessFactor", 0.5}}},
           {"KHR_materials_anisotropy", {{"anisotropyStrength", 0.5}, {"anisotropyRotation", 1.5}}}}}});
    add_texture(b, png_of_four_texels());
    return b;
}

}  // namespace candela::test
