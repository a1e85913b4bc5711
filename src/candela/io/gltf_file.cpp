#include "candela/io/gltf_file.hpp"

#include <algorithm>
#include <cctype>

#include "candela/io/image_write.hpp"
#include "candela/scene/error.hpp"

namespace candela::io {
namespace {

using nlohmann::json;

constexpr int kFloat = 5126, kUnsignedInt = 5125;
constexpr int kVertexTarget = 34962, kIndexTarget = 34963;
/// The length of a .glb is 32 bits wide.
constexpr std::size_t kMostGlbBytes = 0xffffffffu;

template <typename T>
void append_value(std::vector<std::byte>& out, T value) {
    const auto* bytes = reinterpret_cast<const std::byte*>(&value);
    out.insert(out.end(), bytes, bytes + sizeof value);
}

void append_chunk(std::vector<std::byte>& out, std::uint32_t type, std::span<const std::byte> bytes,
                  char padding) {
    const std::size_t padded = (bytes.size() + 3) / 4 * 4;
    append_value(out, static_cast<std::uint32_t>(padded));
    append_value(out, type);
    out.insert(out.end(), bytes.begin(), bytes.end());
    out.insert(out.end(), padded - bytes.size(), static_cast<std::byte>(padding));
}

const char* vector_type(std::size_t columns) {
    static constexpr const char* names[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
    return names[columns - 1];
}

std::span<const std::byte> as_bytes(const std::string& text) {
    return std::as_bytes(std::span(text.data(), text.size()));
}

/// As a URI: what the specification reserves is percent-encoded.
std::string uri_of(const std::string& name) {
    static constexpr char hex[] = "0123456789ABCDEF";
    std::string out;
    for (const char c : name) {
        const auto byte = static_cast<unsigned char>(c);
        const bool plain = std::isalnum(byte) || std::string_view("-._~").find(c) != std::string_view::npos;
        if (plain) {
            out += c;
        } else {
            out += '%';
            out += hex[byte >> 4];
            out += hex[byte & 15];
        }
    }
    return out;
}

}  // namespace

json to_json(const glm::vec3& v) {
    return {v.x, v.y, v.z};
}

json to_json(const glm::mat4& m) {
    json out = json::array();
    for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 4; ++r) out.push_back(m[c][r]);
    }
    return out;
}

json to_json(const glm::dmat4& m) {
    json out = json::array();
    for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 4; ++r) {
            const auto single = static_cast<float>(m[c][r]);
            if (static_cast<double>(single) == m[c][r])
                out.push_back(single);
            else
                out.push_back(m[c][r]);
        }
    }
    return out;
}

GltfFile::GltfFile(const std::string& generator) {
    document["asset"] = {{"version", "2.0"}, {"generator", generator}};
    document["scene"] = 0;
    document["scenes"] = json::array({json::object()});
}

std::size_t GltfFile::push(const char* list, json element) {
    document[list].push_back(std::move(element));
    return document[list].size() - 1;
}

void GltfFile::declare(const std::string& extension) {
    json& used = document["extensionsUsed"];
    if (std::find(used.begin(), used.end(), extension) == used.end()) used.push_back(extension);
}

std::size_t GltfFile::add_root(json node) {
    const std::size_t index = push("nodes", std::move(node));
    document["scenes"][0]["nodes"].push_back(index);
    return index;
}

std::size_t GltfFile::add_view(std::span<const std::byte> bytes, int target) {
    binary_.resize((binary_.size() + 3) / 4 * 4);
    json view{{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}};
    if (target != 0) view["target"] = target;
    binary_.insert(binary_.end(), bytes.begin(), bytes.end());
    return push("bufferViews", std::move(view));
}

std::size_t GltfFile::add_vertices(std::span<const float> numbers, std::size_t columns) {
    return push("accessors", {{"bufferView", add_view(std::as_bytes(numbers), kVertexTarget)},
                              {"componentType", kFloat},
                              {"type", vector_type(columns)},
                              {"count", numbers.size() / columns}});
}

std::size_t GltfFile::add_positions(std::span<const glm::vec3> positions) {
    const std::size_t accessor = add_vertices({&positions[0].x, positions.size() * 3}, 3);
    glm::vec3 low = positions.front(), high = low;
    for (const glm::vec3& p : positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    document["accessors"][accessor]["min"] = to_json(low);
    document["accessors"][accessor]["max"] = to_json(high);
    return accessor;
}

std::size_t GltfFile::add_indices(std::span<const std::uint32_t> indices) {
    return push("accessors", {{"bufferView", add_view(std::as_bytes(indices), kIndexTarget)},
                              {"componentType", kUnsignedInt},
                              {"type", "SCALAR"},
                              {"count", indices.size()}});
}

void GltfFile::save(const std::filesystem::path& file) const {
    json out_document = document;
    if (!binary_.empty()) out_document["buffers"] = json::array({{{"byteLength", binary_.size()}}});
    // Names may hold what is not UTF-8; a file is better than none.
    const auto text_of = [](const json& d, int indent) {
        return d.dump(indent, ' ', false, json::error_handler_t::replace);
    };
    if (file.extension() != ".glb") {
        if (!binary_.empty()) {
            std::filesystem::path binary_file = file;
            binary_file.replace_extension(".bin");
            write_file(binary_file, binary_);
            out_document["buffers"][0]["uri"] = uri_of(binary_file.filename().string());
        }
        write_file(file, as_bytes(text_of(out_document, 2) + "\n"));
        return;
    }
    std::vector<std::byte> chunks;
    append_chunk(chunks, 0x4E4F534A, as_bytes(text_of(out_document, -1)), ' ');  // "JSON"
    if (!binary_.empty()) append_chunk(chunks, 0x004E4942, binary_, 0);          // "BIN"
    if (chunks.size() > kMostGlbBytes - 12)
        throw input_error("the scene is too large for a .glb", file.string(), "write a .gltf");
    std::vector<std::byte> out;
    append_value(out, std::uint32_t{0x46546C67});  // "glTF"
    append_value(out, std::uint32_t{2});
    append_value(out, static_cast<std::uint32_t>(12 + chunks.size()));
    out.insert(out.end(), chunks.begin(), chunks.end());
    write_file(file, out);
}

}  // namespace candela::io
