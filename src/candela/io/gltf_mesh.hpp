#pragma once

#include <optional>

#include "candela/io/gltf_accessor.hpp"
#include "candela/io/gltf_material.hpp"
#include "candela/scene/scene.hpp"

namespace candela::io {

/// A primitive before it is posed: what skins and morph targets need beside scene::Primitive. Holds only the
/// vertices that its triangles use.
struct SourcePrimitive {
    scene::Primitive primitive;
    /// JOINTS_n and WEIGHTS_n.
    struct Influences {
        std::vector<std::array<std::uint32_t, 4>> joints;
        std::vector<glm::vec4> weights;
    };
    std::vector<Influences> influences;  ///< one for each n, their weights add up to 1; empty: not skinned
    struct MorphTarget {
        std::vector<glm::vec3> positions;
        std::vector<glm::vec3> normals;
        std::vector<glm::vec3> tangents;
    };
    std::vector<MorphTarget> targets;
    bool had_normals = false;
    std::optional<scene::StrokeKind> stroke;  ///< the indices are points or segments, not triangles
};

struct SourceMesh {
    std::string name;
    std::vector<SourcePrimitive> primitives;
    std::vector<float> weights;  ///< default morph weights
};

/// Reads a mesh; primitives without area or with broken numbers are dropped with a warning. Materials are
/// indices into the document's materials; no_index where there is none.
[[nodiscard]] SourceMesh read_mesh(const GltfDocument& document, AccessorCache& accessors,
                                   GltfMaterials& materials, std::uint32_t index, Diagnostics& diagnostics);

/// Attributes of a KHR_draco_mesh_compression primitive, by glTF name, and its indices.
struct DracoAttribute {
    std::string name;
    std::size_t components = 0;
    std::vector<float> values;
};
struct DracoGeometry {
    std::size_t vertices = 0;
    std::vector<std::uint32_t> indices;
    std::vector<DracoAttribute> attributes;
    [[nodiscard]] const DracoAttribute* find(const std::string& name) const;
};
[[nodiscard]] DracoGeometry decode_draco(const GltfDocument& document, const JsonView& extension);

}  // namespace candela::io
