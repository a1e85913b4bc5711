#include "candela/io/gltf_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>

#include "candela/io/gltf_accessor.hpp"
#include "candela/scene/error.hpp"

namespace candela::io {
namespace {

constexpr std::uint64_t kPoints = 0;
constexpr std::uint64_t kLineLoop = 2;
constexpr std::uint64_t kLineStrip = 3;
/// Positions, normals, one set of uv: what most vertices hold.
constexpr std::uint64_t kVertexBytes = 32;
constexpr std::uint64_t kTriangles = 4;
constexpr std::uint64_t kTriangleStrip = 5;
constexpr std::uint64_t kTriangleFan = 6;

/// Where a primitive's attributes come from: accessors, or Draco.
class Attributes {
  public:
    Attributes(const GltfDocument& document, AccessorCache& accessors, const JsonView& primitive)
        : document_(document), accessors_(accessors), attributes_(primitive["attributes"]) {
        const JsonView draco = primitive["extensions"]["KHR_draco_mesh_compression"];
        if (draco.exists()) draco_ = decode_draco(document, draco);
    }

    [[nodiscard]] bool has(const std::string& name) const {
        return (draco_ && draco_->find(name)) || attributes_[name.c_str()].exists();
    }
    /// Null where there is none.
    [[nodiscard]] std::shared_ptr<const AccessorData> read(const char* name) const {
        if (draco_) {
            if (const DracoAttribute* a = draco_->find(name)) {
                return std::make_shared<const AccessorData>(
                    AccessorData{draco_->vertices, a->components, false, a->values});
            }
        }
        const auto index = attributes_[name].strict_index_below(document_.count("accessors"));
        return index ? accessors_.read(*index) : nullptr;
    }
    /// Calls use(data, where) with an attribute that the primitive can be drawn without; one that is broken
    /// is left out, with a warning.
    template <class Use>
    void optional(const std::string& name, std::size_t count, const Use& use) const {
        if (!has(name)) return;
        const JsonView view = attributes_[name.c_str()];
        document_.try_to_read(view, "drawn without it", [&] {
            const auto data = read(name.c_str());
            if (data->count != count) {
                throw input_error("has " + std::to_string(data->count) + " elements for " +
                                      std::to_string(count) + " vertices",
                                  view.where());
            }
            use(*data, view.where());
        });
    }
    [[nodiscard]] std::string where(const char* name) const { return attributes_.where() + "/" + name; }
    [[nodiscard]] const std::optional<DracoGeometry>& draco() const { return draco_; }

  private:
    const GltfDocument& document_;
    AccessorCache& accessors_;
    JsonView attributes_;
    std::optional<DracoGeometry> draco_;
};

/// The vertices of a primitive: how many its accessors have, and which of them its triangles use.
struct Vertices {
    std::size_t count = 0;
    std::vector<std::uint32_t> used;  ///< in ascending order; empty: all
    [[nodiscard]] std::size_t size() const { return used.empty() ? count : used.size(); }
};

template <class Vec>
bool all_finite(const std::vector<Vec>& values) {
    return std::all_of(values.begin(), values.end(), [](const Vec& v) {
        for (int c = 0; c < Vec::length(); ++c) {
            if (!std::isfinite(v[c])) return false;
        }
        return true;
    });
}

/// Loops and strips of lines as pairs of ends, without those that refer to a vertex that is not there.
std::vector<std::uint32_t> as_segments(const std::vector<std::uint32_t>& in, std::uint64_t mode,
                                       std::size_t vertices) {
    std::vector<std::uint32_t> out;
    const auto add = [&](std::uint32_t a, std::uint32_t b) {
        if (a < vertices && b < vertices) out.insert(out.end(), {a, b});
    };
    const std::size_t step = mode < kLineLoop ? 2 : 1;
    for (std::size_t i = 1; i < in.size(); i += step) add(in[i - 1], in[i]);
    if (mode == kLineLoop && in.size() > 2) add(in.back(), in.front());
    return out;
}

/// Strips, loops and fans as lists (glTF 2.0, 3.7.2.1). What refers to a vertex that is not there is left
/// out; in a strip or fan of triangles another one starts behind such an index.
std::vector<std::uint32_t> as_list(const std::vector<std::uint32_t>& in, std::uint64_t mode,
                                   std::size_t vertices) {
    if (mode == kPoints) {
        std::vector<std::uint32_t> points;
        std::copy_if(in.begin(), in.end(), std::back_inserter(points),
                     [&](std::uint32_t i) { return i < vertices; });
        return points;
    }
    if (mode <= kLineStrip) return as_segments(in, mode, vertices);
    std::vector<std::uint32_t> out;
    out.reserve(mode == kTriangles ? in.size() : 3 * in.size());
    const auto there = [&](std::size_t i) { return in[i] < vertices; };
    if (mode == kTriangles) {
        for (std::size_t i = 0; i + 2 < in.size(); i += 3) {
            if (there(i) && there(i + 1) && there(i + 2))
                out.insert(out.end(), {in[i], in[i + 1], in[i + 2]});
        }
        return out;
    }
    std::size_t first = 0;
    for (std::size_t i = 0; i < in.size(); ++i) {
        if (!there(i)) first = i + 1;
        if (i < first + 2) continue;
        if (mode == kTriangleFan) {
            out.insert(out.end(), {in[i - 1], in[i], in[first]});
        } else if ((i - first) % 2 == 0) {
            out.insert(out.end(), {in[i - 2], in[i - 1], in[i]});
        } else {
            out.insert(out.end(), {in[i - 2], in[i], in[i - 1]});
        }
    }
    return out;
}

std::vector<std::uint32_t> read_triangles(const GltfDocument& document, const JsonView& source,
                                          const Attributes& attributes, std::uint64_t mode,
                                          std::size_t vertices) {
    if (attributes.draco()) {
        std::vector<std::uint32_t> indices = attributes.draco()->indices;
        if (!indices.empty() && *std::max_element(indices.begin(), indices.end()) >= vertices)
            source.fail("its Draco triangles refer to vertices that its positions lack");
        return indices;
    }
    std::vector<std::uint32_t> raw;
    const JsonView indices = source["indices"];
    if (const auto index = indices.is_negative() ? indices.index_below(0)
                                                 : indices.strict_index_below(document.count("accessors"))) {
        raw = read_indices(document, *index);
    } else {
        raw.resize(vertices);
        for (std::uint32_t i = 0; i < raw.size(); ++i) raw[i] = i;
    }
    if (std::any_of(raw.begin(), raw.end(), [&](std::uint32_t i) { return i >= vertices; }))
        indices.repaired("refers to vertices that are not there: those triangles are skipped");
    return as_list(raw, mode, vertices);
}

/// Which of the vertices the indices use; the indices then count among those. Exporters let hundreds of
/// primitives share one long list of vertices.
std::vector<std::uint32_t> compact(std::vector<std::uint32_t>& indices, std::size_t vertices) {
    std::vector<std::uint32_t> used;
    if (indices.size() < vertices / 8) {
        used = indices;
        std::sort(used.begin(), used.end());
        used.erase(std::unique(used.begin(), used.end()), used.end());
        for (std::uint32_t& i : indices)
            i = static_cast<std::uint32_t>(std::lower_bound(used.begin(), used.end(), i) - used.begin());
        return used;
    }
    std::vector<std::uint32_t> place(vertices, 0);
    for (const std::uint32_t i : indices) place[i] = 1;
    for (std::uint32_t i = 0; i < vertices; ++i) {
        if (place[i] == 0) continue;
        place[i] = static_cast<std::uint32_t>(used.size());
        used.push_back(i);
    }
    if (used.size() == vertices) return {};
    for (std::uint32_t& i : indices) i = place[i];
    return used;
}

std::array<std::uint32_t, 4> joints_of(const glm::vec4& v) {
    std::array<std::uint32_t, 4> four{};
    for (int c = 0; c < 4; ++c)
        // Written so that a NaN (Draco may hold floats) is joint 0: its conversion is undefined.
        four[static_cast<std::size_t>(c)] =
            v[c] > 0.0f ? static_cast<std::uint32_t>(std::min(v[c], 65535.0f)) : 0u;
    return four;
}

/// The weights of a vertex over all its sets add up to 1.
void normalize_weights(SourcePrimitive& out, const JsonView& source) {
    bool zero = false;
    for (std::size_t i = 0; i < out.influences.front().weights.size(); ++i) {
        float sum = 0.0f;
        for (SourcePrimitive::Influences& set : out.influences) {
            glm::vec4& w = set.weights[i];
            for (int c = 0; c < 4; ++c) w[c] = std::isfinite(w[c]) ? std::max(w[c], 0.0f) : 0.0f;
            sum += w.x + w.y + w.z + w.w;
        }
        if (!(sum > 0.0f) || !std::isfinite(sum)) {
            zero = true;
            for (SourcePrimitive::Influences& set : out.influences) set.weights[i] = glm::vec4(0.0f);
            out.influences.front().weights[i].x = sum = 1.0f;
        }
        for (SourcePrimitive::Influences& set : out.influences) set.weights[i] /= sum;
    }
    if (zero) source.repaired("has vertices whose weights are all 0: their first joint moves them");
}

void read_skin(const Attributes& attributes, const JsonView& source, const Vertices& vertices,
               SourcePrimitive& out) {
    for (std::size_t n = 0;; ++n) {
        const std::string joints = "JOINTS_" + std::to_string(n), weights = "WEIGHTS_" + std::to_string(n);
        if (!attributes.has(joints) || !attributes.has(weights)) break;
        SourcePrimitive::Influences set;
        attributes.optional(joints, vertices.count, [&](const AccessorData& data, const std::string& where) {
            for (const glm::vec4& v : as_vec4(data, where, 0.0f, vertices.used))
                set.joints.push_back(joints_of(v));
        });
        attributes.optional(weights, vertices.count, [&](const AccessorData& data, const std::string& where) {
            set.weights = as_vec4(data, where, 0.0f, vertices.used);
        });
        if (set.joints.empty() || set.weights.empty()) break;
        out.influences.push_back(std::move(set));
    }
    if (!out.influences.empty()) normalize_weights(out, source);
}

void read_targets(const GltfDocument& document, AccessorCache& accessors, const JsonView& source,
                  const Vertices& vertices, SourcePrimitive& out) {
    const JsonView targets = source["targets"];
    for (std::size_t t = 0; t < targets.size(); ++t) {
        SourcePrimitive::MorphTarget target;
        const JsonView attributes = targets[t];
        const auto read = [&](const char* name, std::vector<glm::vec3>& to) {
            const JsonView view = attributes[name];
            const auto index = view.index_below(document.count("accessors"));
            if (!index) return;
            document.try_to_read(view, "drawn without it", [&] {
                const auto data = accessors.read(*index);
                if (data->count != vertices.count)
                    view.fail("has " + std::to_string(data->count) + " elements for " +
                              std::to_string(vertices.count) + " vertices");
                to = as_vec3(*data, view.where(), vertices.used);
            });
        };
        read("POSITION", target.positions);
        read("NORMAL", target.normals);
        read("TANGENT", target.tangents);
        out.targets.push_back(std::move(target));
    }
}

/// `uv_sets`: which of the file's sets the material reads.
void read_attributes(const Attributes& attributes, const Vertices& vertices, const UvSets& uv_sets,
                     scene::Primitive& p, SourcePrimitive& out) {
    const auto& rows = vertices.used;
    using Where = std::string;
    attributes.optional("NORMAL", vertices.count, [&](const AccessorData& data, const Where& where) {
        p.normals = as_vec3(data, where, rows);
        for (glm::vec3& n : p.normals) {
            const float length = glm::length(n);
            n = length > 0.0f && std::isfinite(length) ? n / length : glm::vec3(0, 0, 1);
        }
        out.had_normals = true;
    });
    if (out.had_normals) {
        attributes.optional("TANGENT", vertices.count, [&](const AccessorData& data, const Where& where) {
            p.tangents = as_vec4(data, where, 1.0f, rows);
            if (!all_finite(p.tangents)) p.tangents.clear();
        });
    }
    for (std::size_t set = 0; set < p.uv.size(); ++set) {
        const std::string name = "TEXCOORD_" + std::to_string(uv_sets[set]);
        attributes.optional(name, vertices.count, [&](const AccessorData& data, const Where& where) {
            p.uv[set] = as_vec2(data, where, rows);
            for (glm::vec2& v : p.uv[set]) {
                if (!std::isfinite(v.x) || !std::isfinite(v.y)) v = glm::vec2(0.0f);
            }
        });
    }
    attributes.optional("COLOR_0", vertices.count, [&](const AccessorData& data, const Where& where) {
        p.colors = as_vec4(data, where, 1.0f, rows);
        // Colours are multipliers of an albedo: above 1 a surface would make light.
        for (glm::vec4& c : p.colors) {
            for (int i = 0; i < 4; ++i) c[i] = std::isfinite(c[i]) ? std::clamp(c[i], 0.0f, 1.0f) : 1.0f;
        }
    });
}

std::optional<SourcePrimitive> read_primitive(const GltfDocument& document, AccessorCache& accessors,
                                              GltfMaterials& materials, const JsonView& source,
                                              Diagnostics& diagnostics) {
    const std::uint64_t mode = source["mode"].unsigned_or(kTriangles);
    if (mode > kTriangleFan) source["mode"].fail("is not a primitive mode of glTF");
    const Attributes attributes(document, accessors, source);
    const auto positions = attributes.read("POSITION");
    if (!positions) {
        diagnostics.warn("a primitive without positions: skipped");
        return std::nullopt;
    }
    SourcePrimitive out;
    if (mode < kTriangles)
        out.stroke = mode == kPoints ? scene::StrokeKind::points : scene::StrokeKind::lines;
    scene::Primitive& p = out.primitive;
    p.indices = read_triangles(document, source, attributes, mode, positions->count);
    if (p.indices.empty()) {
        diagnostics.warn(out.stroke ? "a primitive without points or lines: skipped"
                                    : "a primitive without triangles: skipped");
        return std::nullopt;
    }
    Vertices vertices{positions->count, {}};
    if (attributes.draco() || source["indices"].exists())
        vertices.used = compact(p.indices, positions->count);
    document.charge(vertices.size() * kVertexBytes, source);
    p.positions = as_vec3(*positions, attributes.where("POSITION"), vertices.used);
    if (!all_finite(p.positions)) {
        source["attributes"]["POSITION"].repaired("has NaN or infinite values: the primitive is skipped");
        return std::nullopt;
    }
    for (const glm::vec3& x : p.positions) p.bounds.extend(x);
    if (const auto material = source["material"].index_below(document.count("materials")))
        p.material = *material;
    read_attributes(attributes, vertices, materials.uv_sets(p.material), p, out);
    read_skin(attributes, source, vertices, out);
    read_targets(document, accessors, source, vertices, out);
    return out;
}

}  // namespace

SourceMesh read_mesh(const GltfDocument& document, AccessorCache& accessors, GltfMaterials& materials,
                     std::uint32_t index, Diagnostics& diagnostics) {
    const JsonView mesh = document.element("meshes", index);
    SourceMesh out;
    out.name = mesh["name"].string_or("");
    const JsonView primitives = mesh["primitives"];
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        if (auto primitive = read_primitive(document, accessors, materials, primitives[i], diagnostics))
            out.primitives.push_back(std::move(*primitive));
    }
    out.weights.resize(mesh["weights"].size());
    mesh["weights"].floats(out.weights);
    return out;
}

}  // namespace candela::io
