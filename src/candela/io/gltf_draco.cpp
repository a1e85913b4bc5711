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

DracoGeometry decode_draco(const GltfDocument& document, const JsonView& extension) {
    const std::uint32_t view = extension["bufferView"].required_index_below(document.count("bufferViews"));
    const std::span<const std::byte> bytes = document.buffer_view(view);
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok()) extension.fail("its Draco data cannot be decoded", "the file is damaged");
    const std::unique_ptr<draco::Mesh> mesh = std::move(decoded).value();

    DracoGeometry out;
    out.vertices = mesh->num_points();
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
