#include "candela/io/gltf_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

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

    /// Null where there is none.
    [[nodiscard]] std::shared_ptr<const AccessorData> read(const char* name) const {
        if (draco_) {
            if (const DracoAttribute* a = draco_->find(name)) {
                return std::make_shared<const AccessorData>(
                    AccessorData{draco_->vertices, a->components, false, a->values});
            }
        }
        const auto index = attributes_[name].index_below(document_.count("accessors"));
        return index ? accessors_.read(*index) : nullptr;
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

void expect_count(const AccessorData& data, const Vertices& vertices, const std::string& where) {
    if (data.count != vertices.count) {
        throw input_error("has " + std::to_string(data.count) + " elements for " +
                              std::to_string(vertices.count) + " vertices",
                          where);
    }
}

template <class Vec>
bool all_finite(const std::vector<Vec>& values) {
    return std::all_of(values.begin(), values.end(), [](const Vec& v) {
        for (int c = 0; c < Vec::length(); ++c) {
            if (!std::isfinite(v[c])) return false;
        }
        return true;
    });
}

/// Loops and strips of lines as pairs of ends.
std::vector<std::uint32_t> as_segments(const std::vector<std::uint32_t>& in, std::uint64_t mode) {
    if (mode < kLineLoop) return {in.begin(), in.begin() + static_cast<std::ptrdiff_t>(in.size() / 2 * 2)};
    std::vector<std::uint32_t> out;
    for (std::size_t i = 1; i < in.size(); ++i) out.insert(out.end(), {in[i - 1], in[i]});
    if (mode == kLineLoop && in.size() > 2) out.insert(out.end(), {in.back(), in.front()});
    return out;
}

/// Strips, loops and fans as lists; glTF 2.0, 3.7.2.1.
std::vector<std::uint32_t> as_list(const std::vector<std::uint32_t>& in, std::uint64_t mode) {
    if (mode == kPoints) return in;
    if (mode <= kLineStrip) return as_segments(in, mode);
    if (mode == kTriangles) return {in.begin(), in.begin() + static_cast<std::ptrdiff_t>(in.size() / 3 * 3)};
    std::vector<std::uint32_t> out;
    for (std::size_t i = 2; i < in.size(); ++i) {
        if (mode == kTriangleFan) {
            out.insert(out.end(), {in[i - 1], in[i], in[0]});
        } else if (i % 2 == 0) {
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
    if (const auto index = source["indices"].index_below(document.count("accessors"))) {
        raw = read_indices(document, *index);
    } else {
        raw.resize(vertices);
        for (std::uint32_t i = 0; i < raw.size(); ++i) raw[i] = i;
    }
    for (const std::uint32_t i : raw) {
        if (i >= vertices) {
            source["indices"].fail("vertex " + std::to_string(i) + " is out of range: there are " +
                                   std::to_string(vertices));
        }
    }
    return as_list(raw, mode);
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

void read_skin(const Attributes& attributes, const Vertices& vertices, SourcePrimitive& out,
               Diagnostics& diagnostics) {
    const auto joints = attributes.read("JOINTS_0");
    const auto weights = attributes.read("WEIGHTS_0");
    if (!joints || !weights) return;
    if (attributes.read("JOINTS_1"))
        diagnostics.warn("more than four joints a vertex: the first four are used");
    expect_count(*joints, vertices, attributes.where("JOINTS_0"));
    expect_count(*weights, vertices, attributes.where("WEIGHTS_0"));
    const std::vector<glm::vec4> j = as_vec4(*joints, attributes.where("JOINTS_0"), 0.0f, vertices.used);
    out.weights = as_vec4(*weights, attributes.where("WEIGHTS_0"), 0.0f, vertices.used);
    for (const glm::vec4& v : j) {
        std::array<std::uint32_t, 4> four{};
        for (int c = 0; c < 4; ++c)
            // Written so that a NaN (Draco may hold floats) is joint 0: its conversion is undefined.
            four[static_cast<std::size_t>(c)] =
                v[c] > 0.0f ? static_cast<std::uint32_t>(std::min(v[c], 65535.0f)) : 0u;
        out.joints.push_back(four);
    }
    for (glm::vec4& w : out.weights) {
        const float sum = w.x + w.y + w.z + w.w;
        if (sum > 0.0f) w /= sum;
    }
}

void read_targets(const GltfDocument& document, AccessorCache& accessors, const JsonView& source,
                  const Vertices& vertices, SourcePrimitive& out) {
    const JsonView targets = source["targets"];
    for (std::size_t t = 0; t < targets.size(); ++t) {
        SourcePrimitive::MorphTarget target;
        const JsonView attributes = targets[t];
        const auto read = [&](const char* name, std::vector<glm::vec3>& to) {
            const auto index = attributes[name].index_below(document.count("accessors"));
            if (!index) return;
            const auto data = accessors.read(*index);
            expect_count(*data, vertices, attributes.where() + "/" + name);
            to = as_vec3(*data, attributes.where() + "/" + name, vertices.used);
        };
        read("POSITION", target.positions);
        read("NORMAL", target.normals);
        read("TANGENT", target.tangents);
        out.targets.push_back(std::move(target));
    }
}

void read_attributes(const Attributes& attributes, const Vertices& vertices, scene::Primitive& p,
                     SourcePrimitive& out) {
    const auto& rows = vertices.used;
    if (const auto normals = attributes.read("NORMAL")) {
        expect_count(*normals, vertices, attributes.where("NORMAL"));
        p.normals = as_vec3(*normals, attributes.where("NORMAL"), rows);
        for (glm::vec3& n : p.normals) {
            const float length = glm::length(n);
            n = length > 0.0f && std::isfinite(length) ? n / length : glm::vec3(0, 0, 1);
        }
        out.had_normals = true;
    }
    if (const auto tangents = attributes.read("TANGENT"); tangents && out.had_normals) {
        expect_count(*tangents, vertices, attributes.where("TANGENT"));
        p.tangents = as_vec4(*tangents, attributes.where("TANGENT"), 1.0f, rows);
        if (!all_finite(p.tangents)) p.tangents.clear();
    }
    for (std::size_t set = 0; set < p.uv.size(); ++set) {
        const std::string name = "TEXCOORD_" + std::to_string(set);
        if (const auto uv = attributes.read(name.c_str())) {
            expect_count(*uv, vertices, attributes.where(name.c_str()));
            p.uv[set] = as_vec2(*uv, attributes.where(name.c_str()), rows);
            for (glm::vec2& v : p.uv[set]) {
                if (!std::isfinite(v.x) || !std::isfinite(v.y)) v = glm::vec2(0.0f);
            }
        }
    }
    if (const auto colors = attributes.read("COLOR_0")) {
        expect_count(*colors, vertices, attributes.where("COLOR_0"));
        p.colors = as_vec4(*colors, attributes.where("COLOR_0"), 1.0f, rows);
        // Colours are multipliers of an albedo: above 1 a surface would make light.
        for (glm::vec4& c : p.colors) {
            for (int i = 0; i < 4; ++i) c[i] = std::isfinite(c[i]) ? std::clamp(c[i], 0.0f, 1.0f) : 1.0f;
        }
    }
}

std::optional<SourcePrimitive> read_primitive(const GltfDocument& document, AccessorCache& accessors,
                                              const JsonView& source, Diagnostics& diagnostics) {
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
    const Vertices vertices{positions->count, compact(p.indices, positions->count)};
    document.charge(vertices.size() * kVertexBytes, source);
    p.positions = as_vec3(*positions, attributes.where("POSITION"), vertices.used);
    if (!all_finite(p.positions)) {
        diagnostics.warn("a primitive with NaN or infinite positions: skipped");
        return std::nullopt;
    }
    for (const glm::vec3& x : p.positions) p.bounds.extend(x);
    read_attributes(attributes, vertices, p, out);
    read_skin(attributes, vertices, out, diagnostics);
    read_targets(document, accessors, source, vertices, out);
    if (const auto material = source["material"].index_below(document.count("materials")))
        p.material = *material;
    return out;
}

}  // namespace

SourceMesh read_mesh(const GltfDocument& document, AccessorCache& accessors, std::uint32_t index,
                     Diagnostics& diagnostics) {
    const JsonView mesh = document.element("meshes", index);
    SourceMesh out;
    out.name = mesh["name"].string_or("");
    const JsonView primitives = mesh["primitives"];
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        if (auto primitive = read_primitive(document, accessors, primitives[i], diagnostics))
            out.primitives.push_back(std::move(*primitive));
    }
    out.weights.resize(mesh["weights"].size());
    mesh["weights"].floats(out.weights);
    return out;
}

}  // namespace candela::io
