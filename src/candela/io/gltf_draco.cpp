#include <draco/compression/decode.h>
#include <draco/core/decoder_buffer.h>

#include <algorithm>

#include "candela/io/gltf_mesh.hpp"

namespace candela::io {

const DracoAttribute* DracoGeometry::find(const std::string& name) const {
    const auto same = [&](const DracoAttribute& a) { return a.name == name; };
    const auto found = std::find_if(attributes.begin(), attributes.end(), same);
    return found == attributes.end() ? nullptr : &*found;
}

namespace {

/// Draco takes memory for what its header claims before it reads the data. Two counts follow the header of 11
/// bytes. The ratio is a bound of ours, far above what meshes of the tests reach.
void check_claims(std::span<const std::byte> bytes, const JsonView& where) {
    constexpr std::size_t header_bytes = 11;
    constexpr std::uint64_t most_per_byte = 512;
    constexpr auto metadata_flag = std::byte{0x80};
    if (bytes.size() < header_bytes + 2) where.fail("its Draco data is truncated");
    const bool edgebreaker = bytes[8] == std::byte{1};
    // Metadata would come first; exporters of glTF write none, and what follows it is bounded by Draco's own
    // checks.
    if ((bytes[10] & metadata_flag) != std::byte{0})
        where.fail("its Draco data holds metadata", "not supported");
    if (std::to_integer<int>(bytes[5]) * 10 + std::to_integer<int>(bytes[6]) < 22)
        where.fail("its Draco data is older than version 2.2");
    std::size_t at = header_bytes + (edgebreaker ? 1 : 0);
    for (int number = 0; number < 2; ++number) {
        std::uint64_t value = 0;
        for (int shift = 0; shift < 35 && at < bytes.size(); shift += 7) {
            const auto b = std::to_integer<std::uint64_t>(bytes[at++]);
            value |= (b & 0x7f) << shift;
            if ((b & 0x80) == 0) break;
        }
        if (value > most_per_byte * bytes.size())
            where.fail("its Draco data claims " + std::to_string(value) + " faces or vertices in " +
                       std::to_string(bytes.size()) + " bytes");
    }
}

}  // namespace

DracoGeometry decode_draco(const GltfDocument& document, const JsonView& extension) {
    const std::uint32_t view = extension["bufferView"].required_index_below(document.count("bufferViews"));
    const std::span<const std::byte> bytes = document.buffer_view(view);
    check_claims(bytes, extension);
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok()) extension.fail("its Draco data cannot be decoded", "the file is damaged");
    const std::unique_ptr<draco::Mesh> mesh = std::move(decoded).value();

    DracoGeometry out;
    out.vertices = mesh->num_points();
    document.charge(std::uint64_t{mesh->num_faces()} * 3 * sizeof(std::uint32_t), extension);
    for (draco::FaceIndex f(0); f < mesh->num_faces(); ++f) {
        for (const draco::PointIndex& point : mesh->face(f)) {
            if (point.value() >= out.vertices)
                extension.fail("its Draco data refers to a vertex that is not there");
            out.indices.push_back(point.value());
        }
    }
    const JsonView names = extension["attributes"];
    for (const std::string& name : names.keys()) {
        const std::uint64_t id = names[name.c_str()].unsigned_or(0);
        const draco::PointAttribute* attribute = mesh->GetAttributeByUniqueId(static_cast<std::uint32_t>(id));
        if (!attribute) names[name.c_str()].fail("is not an attribute of the Draco data");
        DracoAttribute a;
        a.name = name;
        a.components = static_cast<std::size_t>(attribute->num_components());
        if (a.components < 1 || a.components > 4) names[name.c_str()].fail("has an odd number of components");
        document.charge(std::uint64_t{out.vertices} * a.components * sizeof(float), extension);
        a.values.resize(out.vertices * a.components);
        for (draco::PointIndex point(0); point < mesh->num_points(); ++point) {
            attribute->ConvertValue<float>(attribute->mapped_index(point),
                                           static_cast<std::int8_t>(a.components),
                                           a.values.data() + point.value() * a.components);
        }
        out.attributes.push_back(std::move(a));
    }
    return out;
}

}  // namespace candela::io
