#include "candela/io/gltf_accessor.hpp"

#include <algorithm>
#include <cstring>
#include <glm/gtc/type_ptr.hpp>

#include "candela/scene/error.hpp"

namespace candela::io {
namespace {

/// An accessor without data (or sparse over zeros) takes no bytes of the file; this bounds what it may ask
/// for.
constexpr std::uint64_t kMaxElements = std::uint64_t{1} << 26;
constexpr std::size_t kMaxCachedAccessors = 256;
constexpr std::size_t kMaxCachedBytes = std::size_t{1} << 28;

enum ComponentType : std::uint64_t {
    byte = 5120,
    ubyte = 5121,
    sshort = 5122,
    ushort = 5123,
    uint = 5125,
    real = 5126
};

struct Layout {
    std::uint64_t component = 0;
    std::size_t component_bytes = 0;
    std::size_t components = 0;
    std::size_t columns = 1;  // of a matrix; columns start on 4 byte boundaries
    bool normalized = false;

    [[nodiscard]] std::size_t rows() const { return components / columns; }
    [[nodiscard]] std::size_t column_bytes() const {
        const std::size_t bytes = rows() * component_bytes;
        return columns == 1 ? bytes : (bytes + 3) & ~std::size_t{3};
    }
    [[nodiscard]] std::size_t element_bytes() const { return column_bytes() * columns; }
};

std::size_t bytes_of(const JsonView& type) {
    switch (type.unsigned_or(0)) {
        case byte:
        case ubyte:
            return 1;
        case sshort:
        case ushort:
            return 2;
        case uint:
        case real:
            return 4;
        default:
            type.fail("is not a component type of glTF");
    }
}

Layout layout_of(const JsonView& accessor) {
    Layout layout;
    layout.component = accessor["componentType"].unsigned_or(0);
    layout.component_bytes = bytes_of(accessor["componentType"]);
    layout.normalized =
        accessor["normalized"].bool_or(false) && layout.component != real && layout.component != uint;
    const std::string type = accessor["type"].string_or("");
    if (type == "SCALAR") layout.components = 1;
    if (type == "VEC2") layout.components = 2;
    if (type == "VEC3") layout.components = 3;
    if (type == "VEC4") layout.components = 4;
    for (std::size_t n = 2; n <= 4; ++n) {
        if (type != "MAT" + std::to_string(n)) continue;
        layout.components = n * n;
        layout.columns = n;
    }
    if (layout.components == 0) accessor["type"].fail("is not an accessor type of glTF");
    return layout;
}

template <class T>
double load(const std::byte* at) {
    T value;
    std::memcpy(&value, at, sizeof(T));
    return static_cast<double>(value);
}

double component(const std::byte* at, const Layout& layout) {
    double value = 0.0;
    double largest = 1.0;
    switch (layout.component) {
        case byte:
            value = load<std::int8_t>(at), largest = 127.0;
            break;
        case ubyte:
            value = load<std::uint8_t>(at), largest = 255.0;
            break;
        case sshort:
            value = load<std::int16_t>(at), largest = 32767.0;
            break;
        case ushort:
            value = load<std::uint16_t>(at), largest = 65535.0;
            break;
        case uint:
            value = load<std::uint32_t>(at);
            break;
        default:
            return load<float>(at);
    }
    return layout.normalized ? std::max(value / largest, -1.0) : value;
}

/// Calls put(row, component, value) for `count` elements of a buffer view from byte `offset`.
template <class Put>
void read_elements(const GltfDocument& document, std::uint32_t view, std::uint64_t offset,
                   std::uint64_t count, const Layout& layout, const JsonView& where, const Put& put) {
    if (count == 0) return;
    const std::span<const std::byte> bytes = document.buffer_view(view);
    const std::size_t stride = document.buffer_view_stride(view);
    const std::size_t step = stride ? stride : layout.element_bytes();
    if (step < layout.element_bytes()) where.fail("its elements overlap: byteStride is less than their size");
    // Each term is below 2^37 before they are added, so that nothing wraps.
    if (offset > bytes.size() || count > kMaxElements)
        where.fail("passes the end of its buffer view: starts at byte " + std::to_string(offset) + " of " +
                   std::to_string(bytes.size()));
    const std::uint64_t needed = offset + (count - 1) * step + layout.element_bytes();
    if (needed > bytes.size()) {
        where.fail("passes the end of its buffer view: needs " + std::to_string(needed) + " bytes of " +
                   std::to_string(bytes.size()));
    }
    for (std::size_t i = 0; i < count; ++i) {
        const std::byte* element = bytes.data() + offset + i * step;
        for (std::size_t c = 0; c < layout.components; ++c) {
            const std::size_t column = c / layout.rows();
            const std::size_t row = c % layout.rows();
            put(i, c,
                component(element + column * layout.column_bytes() + row * layout.component_bytes, layout));
        }
    }
}

/// Visits every number of an accessor, the sparse ones last, so that they win.
template <class Put>
void visit(const GltfDocument& document, const JsonView& accessor, const Layout& layout, std::uint64_t count,
           const Put& put) {
    const std::size_t views = document.count("bufferViews");
    if (const auto view = accessor["bufferView"].strict_index_below(views)) {
        read_elements(document, *view, accessor["byteOffset"].unsigned_or(0), count, layout, accessor, put);
    }
    const JsonView sparse = accessor["sparse"];
    if (!sparse.exists()) return;
    const std::uint64_t changed = sparse["count"].unsigned_or(0);
    if (changed > count) sparse["count"].fail("is more than the accessor has");
    const JsonView indices = sparse["indices"];
    Layout index_layout;
    index_layout.component = indices["componentType"].unsigned_or(0);
    index_layout.component_bytes = bytes_of(indices["componentType"]);
    index_layout.components = 1;
    if (index_layout.component != ubyte && index_layout.component != ushort &&
        index_layout.component != uint) {
        indices["componentType"].fail("must be an unsigned integer type");
    }
    document.charge(changed * sizeof(std::size_t), sparse);
    std::vector<std::size_t> targets(static_cast<std::size_t>(changed));
    read_elements(
        document, indices["bufferView"].required_index_below(views), indices["byteOffset"].unsigned_or(0),
        changed, index_layout, indices, [&](std::size_t i, std::size_t, double value) {
            if (value >= static_cast<double>(count))
                indices.repaired("an index of a sparse accessor is out of range: its value is skipped");
            targets[i] = static_cast<std::size_t>(value);
        });
    const JsonView values = sparse["values"];
    read_elements(document, values["bufferView"].required_index_below(views),
                  values["byteOffset"].unsigned_or(0), changed, layout, values,
                  [&](std::size_t i, std::size_t c, double value) {
                      if (targets[i] < count) put(targets[i], c, value);
                  });
}

std::uint64_t checked_count(const JsonView& accessor) {
    if (!accessor["count"].exists()) accessor["count"].fail("is missing");
    const std::uint64_t count = accessor["count"].unsigned_or(0);
    if (count > kMaxElements)
        accessor["count"].fail("is too large: " + std::to_string(count), "at most 67,108,864");
    return count;
}

/// Takes memory only for what the file can back: without a buffer view the accessor is zeros, and those are
/// bounded.
void check_backing(const GltfDocument& document, const JsonView& accessor, const Layout& layout,
                   std::uint64_t count) {
    if (const auto view = accessor["bufferView"].strict_index_below(document.count("bufferViews"))) {
        const std::size_t bytes = document.buffer_view(*view).size();
        const std::size_t stride = document.buffer_view_stride(*view);
        const std::uint64_t step = stride ? stride : layout.element_bytes();
        if (count > 0 && (count - 1) * step > bytes) {
            accessor.fail("passes the end of its buffer view: " + std::to_string(count) + " elements in " +
                          std::to_string(bytes) + " bytes");
        }
    } else if (count > (std::uint64_t{1} << 22)) {
        accessor["count"].fail("is too large for an accessor without data");
    }
}

}  // namespace

AccessorData read_accessor(const GltfDocument& document, std::uint32_t index) {
    const JsonView accessor = document.element("accessors", index);
    const Layout layout = layout_of(accessor);
    const std::uint64_t count = checked_count(accessor);
    check_backing(document, accessor, layout, count);
    AccessorData data;
    data.count = static_cast<std::size_t>(count);
    data.components = layout.components;
    data.integers = layout.component != real && !layout.normalized;
    document.charge(count * layout.components * sizeof(float), accessor);
    data.values.resize(data.count * layout.components);
    visit(document, accessor, layout, count, [&](std::size_t i, std::size_t c, double value) {
        data.values[i * layout.components + c] = static_cast<float>(value);
    });
    return data;
}

std::vector<std::uint32_t> read_indices(const GltfDocument& document, std::uint32_t index) {
    const JsonView accessor = document.element("accessors", index);
    const Layout layout = layout_of(accessor);
    if (layout.component == real || layout.component == byte || layout.component == sshort) {
        accessor["componentType"].fail("must be an unsigned integer type");
    }
    if (layout.components != 1) accessor["type"].fail("indices must be SCALAR");
    const std::uint64_t count = checked_count(accessor);
    check_backing(document, accessor, layout, count);
    document.charge(count * layout.components * sizeof(std::uint32_t), accessor);
    std::vector<std::uint32_t> values(static_cast<std::size_t>(count) * layout.components);
    Layout whole = layout;
    whole.normalized = false;
    visit(document, accessor, whole, count, [&](std::size_t i, std::size_t c, double value) {
        values[i * layout.components + c] = static_cast<std::uint32_t>(value);
    });
    return values;
}

std::shared_ptr<const AccessorData> AccessorCache::read(std::uint32_t index) {
    const auto found =
        std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.index == index; });
    if (found != entries_.end()) {
        std::rotate(entries_.begin(), found, found + 1);
        return entries_.front().data;
    }
    auto data = std::make_shared<const AccessorData>(read_accessor(*document_, index));
    bytes_ += data->values.size() * sizeof(float);
    entries_.push_front({index, data});
    while (entries_.size() > kMaxCachedAccessors || (bytes_ > kMaxCachedBytes && entries_.size() > 1)) {
        bytes_ -= entries_.back().data->values.size() * sizeof(float);
        entries_.pop_back();
    }
    return data;
}

namespace {

void expect_components(const AccessorData& data, std::size_t least, std::size_t most,
                       const std::string& where) {
    if (data.components < least || data.components > most)
        throw input_error("its accessor has the wrong type", where);
}

template <class Vec, class Make>
std::vector<Vec> gather(const AccessorData& data, AccessorRows rows, const Make& make) {
    std::vector<Vec> out(rows.empty() ? data.count : rows.size());
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = make(data.row(rows.empty() ? i : rows[i]));
    return out;
}

}  // namespace

std::vector<glm::vec2> as_vec2(const AccessorData& data, const std::string& where, AccessorRows rows) {
    expect_components(data, 2, 2, where);
    return gather<glm::vec2>(data, rows, [](const float* r) { return glm::vec2(r[0], r[1]); });
}

std::vector<glm::vec3> as_vec3(const AccessorData& data, const std::string& where, AccessorRows rows) {
    expect_components(data, 3, 3, where);
    return gather<glm::vec3>(data, rows, [](const float* r) { return glm::vec3(r[0], r[1], r[2]); });
}

std::vector<glm::vec4> as_vec4(const AccessorData& data, const std::string& where, float w,
                               AccessorRows rows) {
    expect_components(data, 3, 4, where);
    const bool four = data.components == 4;
    return gather<glm::vec4>(data, rows,
                             [&](const float* r) { return glm::vec4(r[0], r[1], r[2], four ? r[3] : w); });
}

std::vector<glm::mat4> as_mat4(const AccessorData& data, const std::string& where) {
    expect_components(data, 16, 16, where);
    std::vector<glm::mat4> out(data.count);
    for (std::size_t i = 0; i < data.count; ++i) out[i] = glm::make_mat4(data.row(i));
    return out;
}

}  // namespace candela::io
