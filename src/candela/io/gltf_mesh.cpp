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
constexpr std::uint64_t kTriangles = 4;
constexpr std::uint64_t kTriangleStrip = 5;
constexpr std::uint64_t kTriangleFan = 6;

/// Where a primitive's attributes come from: accessors, or Draco.
class Attributes {
  public:
    Attributes(const GltfDocument& document, const JsonView& primitive)
        : document_(document), attributes_(primitive["attributes"]) {
        const JsonView draco = primitive["extensions"]["KHR_draco_mesh_compression"];
        if (draco.exists()) draco_ = decode_draco(document, draco);
    }

    [[nodiscard]] std::optional<AccessorData> read(const char* name) const {
        if (draco_) {
            if (const DracoAttribute* a = draco_->find(name)) {
                return AccessorData{draco_->vertices, a->components, false, a->values};
            }
        }
        const auto index = attributes_[name].index_below(document_.count("accessors"));
        if (!index) return std::nullopt;
        return read_accessor(document_, *index);
    }
    [[nodiscard]] std::string where(const char* name) const { return attributes_.where() + "/" + name; }
    [[nodiscard]] const std::optional<DracoGeometry>& draco() const { return draco_; }

  private:
    const GltfDocument& document_;
    JsonView attributes_;
    std::optional<DracoGeometry> draco_;
};

template <class T>
void expect_count(const std::vector<T>& values, std::size_t count, const std::string& where) {
    if (values.size() != count) {
        throw input_error(
            "has " + std::to_string(values.size()) + " elements for " + std::to_string(count) + " vertices",
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

void read_indices_of(const GltfDocument& document, const JsonView& source, const Attributes& attributes,
                     std::uint64_t mode, scene::Primitive& p) {
    std::vector<std::uint32_t> raw;
    if (attributes.draco()) {
        p.indices = attributes.draco()->indices;
        if (!p.indices.empty() && *std::max_element(p.indices.begin(), p.indices.end()) >= p.positions.size())
            source.fail("its Draco triangles refer to vertices that its positions lack");
        return;
    }
    if (const auto index = source["indices"].index_below(document.count("accessors"))) {
        raw = read_indices(document, *index);
    } else {
        raw.resize(p.positions.size());
        for (std::uint32_t i = 0; i < raw.size(); ++i) raw[i] = i;
    }
    for (const std::uint32_t i : raw) {
        if (i >= p.positions.size()) {
            source["indices"].fail("vertex " + std::to_string(i) + " is out of range: there are " +
                                   std::to_string(p.positions.size()));
        }
    }
    p.indices = as_list(raw, mode);
}

void read_skin(const Attributes& attributes, std::size_t vertices, SourcePrimitive& out,
               Diagnostics& diagnostics) {
    const auto joints = attributes.read("JOINTS_0");
    const auto weights = attributes.read("WEIGHTS_0");
    if (!joints || !weights) return;
    if (attributes.read("JOINTS_1"))
        diagnostics.warn("more than four joints a vertex: the first four are used");
    const std::vector<glm::vec4> j = as_vec4(*joints, attributes.where("JOINTS_0"), 0.0f);
    out.weights = as_vec4(*weights, attributes.where("WEIGHTS_0"), 0.0f);
    expect_count(j, vertices, attributes.where("JOINTS_0"));
    expect_count(out.weights, vertices, attributes.where("WEIGHTS_0"));
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

void read_targets(const GltfDocument& document, const JsonView& source, std::size_t vertices,
                  SourcePrimitive& out) {
    const JsonView targets = source["targets"];
    for (std::size_t t = 0; t < targets.size(); ++t) {
        SourcePrimitive::MorphTarget target;
        const JsonView attributes = targets[t];
        const auto read = [&](const char* name, std::vector<glm::vec3>& to) {
            const auto index = attributes[name].index_below(document.count("accessors"));
            if (!index) return;
            to = as_vec3(read_accessor(document, *index), attributes.where() + "/" + name);
            expect_count(to, vertices, attributes.where() + "/" + name);
        };
        read("POSITION", target.positions);
        read("NORMAL", target.normals);
        read("TANGENT", target.tangents);
        out.targets.push_back(std::move(target));
    }
}

void read_attributes(const Attributes& attributes, scene::Primitive& p, SourcePrimitive& out) {
    const std::size_t vertices = p.positions.size();
    if (const auto normals = attributes.read("NORMAL")) {
        p.normals = as_vec3(*normals, attributes.where("NORMAL"));
        expect_count(p.normals, vertices, attributes.where("NORMAL"));
        for (glm::vec3& n : p.normals) {
            const float length = glm::length(n);
            n = length > 0.0f && std::isfinite(length) ? n / length : glm::vec3(0, 0, 1);
        }
        out.had_normals = true;
    }
    if (const auto tangents = attributes.read("TANGENT"); tangents && out.had_normals) {
        p.tangents = as_vec4(*tangents, attributes.where("TANGENT"), 1.0f);
        expect_count(p.tangents, vertices, attributes.where("TANGENT"));
        if (!all_finite(p.tangents)) p.tangents.clear();
    }
    for (std::size_t set = 0; set < p.uv.size(); ++set) {
        const std::string name = "TEXCOORD_" + std::to_string(set);
        if (const auto uv = attributes.read(name.c_str())) {
            p.uv[set] = as_vec2(*uv, attributes.where(name.c_str()));
            expect_count(p.uv[set], vertices, attributes.where(name.c_str()));
            for (glm::vec2& v : p.uv[set]) {
                if (!std::isfinite(v.x) || !std::isfinite(v.y)) v = glm::vec2(0.0f);
            }
        }
    }
    if (const auto colors = attributes.read("COLOR_0")) {
        p.colors = as_vec4(*colors, attributes.where("COLOR_0"), 1.0f);
        expect_count(p.colors, vertices, attributes.where("COLOR_0"));
        // Colours are multipliers of an albedo: above 1 a surface would make light.
        for (glm::vec4& c : p.colors) {
            for (int i = 0; i < 4; ++i) c[i] = std::isfinite(c[i]) ? std::clamp(c[i], 0.0f, 1.0f) : 1.0f;
        }
    }
}

std::optional<SourcePrimitive> read_primitive(const GltfDocument& document, const JsonView& source,
                                              Diagnostics& diagnostics) {
    const std::uint64_t mode = source["mode"].unsigned_or(kTriangles);
    if (mode > kTriangleFan) source["mode"].fail("is not a primitive mode of glTF");
    const Attributes attributes(document, source);
    const auto positions = attributes.read("POSITION");
    if (!positions) {
        diagnostics.warn("a primitive without positions: skipped");
        return std::nullopt;
    }
    SourcePrimitive out;
    if (mode < kTriangles)
        out.stroke = mode == kPoints ? scene::StrokeKind::points : scene::StrokeKind::lines;
    scene::Primitive& p = out.primitive;
    p.positions = as_vec3(*positions, attributes.where("POSITION"));
    if (!all_finite(p.positions)) {
        diagnostics.warn("a primitive with NaN or infinite positions: skipped");
        return std::nullopt;
    }
    read_attributes(attributes, p, out);
    read_indices_of(document, source, attributes, mode, p);
    if (p.indices.empty()) {
        diagnostics.warn(out.stroke ? "a primitive without points or lines: skipped"
                                    : "a primitive without triangles: skipped");
        return std::nullopt;
    }
    read_skin(attributes, p.positions.size(), out, diagnostics);
    read_targets(document, source, p.positions.size(), out);
    if (const auto material = source["material"].index_below(document.count("materials")))
        p.material = *material;
    return out;
}

}  // namespace

SourceMesh read_mesh(const GltfDocument& document, std::uint32_t index, Diagnostics& diagnostics) {
    const JsonView mesh = document.element("meshes", index);
    SourceMesh out;
    out.name = mesh["name"].string_or("");
    const JsonView primitives = mesh["primitives"];
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        if (auto primitive = read_primitive(document, primitives[i], diagnostics))
            out.primitives.push_back(std::move(*primitive));
    }
    out.weights.resize(mesh["weights"].size());
    mesh["weights"].floats(out.weights);
    return out;
}

}  // namespace candela::io
