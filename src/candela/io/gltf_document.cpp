#include "candela/io/gltf_document.hpp"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "candela/io/file_kind.hpp"
#include "candela/io/image_read.hpp"
#include "candela/io/inside_folder.hpp"
#include "candela/io/json_reader.hpp"
#include "candela/scene/error.hpp"

namespace candela::io {
namespace {

constexpr std::size_t kMaxBufferBytes = std::size_t{1} << 30;
/// What a scene may take before its files have to justify it, and how much each byte of them justifies: a
/// normalized byte becomes a float, vertices are shared by primitives and split at seams.
constexpr std::uint64_t kFreeBytes = std::uint64_t{1} << 28;
constexpr std::uint64_t kBytesPerFileByte = 32;
constexpr std::uint32_t kGlbMagic = 0x46546c67;  // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4e4f534a;
constexpr std::uint32_t kBinaryChunk = 0x004e4942;

std::uint32_t word(std::span<const std::byte> bytes, std::size_t at) {
    std::uint32_t w = 0;
    std::memcpy(&w, bytes.data() + at, sizeof(w));
    return w;
}

struct Chunks {
    std::span<const std::byte> json;
    std::span<const std::byte> binary;
};

Chunks split_glb(std::span<const std::byte> bytes, const std::string& name) {
    if (bytes.size() < 20) throw input_error("truncated .glb: no room for its header", name);
    if (word(bytes, 4) != 2) throw input_error("not version 2 of the .glb container", name);
    const std::uint32_t length = word(bytes, 8);
    if (length > bytes.size()) {
        throw input_error(
            "truncated .glb: " + std::to_string(bytes.size()) + " of " + std::to_string(length) + " bytes",
            name);
    }
    Chunks chunks;
    std::size_t at = 12;
    while (at + 8 <= length) {
        const std::uint32_t size = word(bytes, at);
        const std::uint32_t kind = word(bytes, at + 4);
        at += 8;
        if (size > length - at) throw input_error("truncated .glb: a chunk passes the end of the file", name);
        if (kind == kJsonChunk && chunks.json.empty()) chunks.json = bytes.subspan(at, size);
        if (kind == kBinaryChunk && chunks.binary.empty()) chunks.binary = bytes.subspan(at, size);
        at += (std::size_t{size} + 3) & ~std::size_t{3};
    }
    if (chunks.json.empty()) throw input_error("a .glb without a JSON chunk", name);
    return chunks;
}

std::vector<std::byte> decode_base64(std::string_view text, const std::string& where) {
    const auto value_of = [](char c) -> int {
        if (c >= 'A' && c <= 'Z') return c - 'A';
        if (c >= 'a' && c <= 'z') return c - 'a' + 26;
        if (c >= '0' && c <= '9') return c - '0' + 52;
        if (c == '+' || c == '-') return 62;
        if (c == '/' || c == '_') return 63;
        return -1;
    };
    std::vector<std::byte> out;
    out.reserve(text.size() / 4 * 3);
    std::uint32_t bits = 0;
    int count = 0;
    const std::size_t padding = text.find('=');
    if (padding != std::string_view::npos) {
        if (text.size() - padding > 2 || text.find_first_not_of('=', padding) != std::string_view::npos)
            throw input_error("broken base64 data", where);
        text = text.substr(0, padding);
    }
    if (text.size() % 4 == 1) throw input_error("truncated base64 data", where);
    for (const char c : text) {
        const int value = value_of(c);
        if (value < 0) throw input_error("broken base64 data", where);
        bits = bits << 6 | static_cast<std::uint32_t>(value);
        count += 6;
        if (count >= 8) {
            count -= 8;
            out.push_back(static_cast<std::byte>(bits >> count & 0xff));
        }
    }
    return out;
}

/// What is no glTF at all is said as what it is, and not as JSON with a mistake.
void check_is_text(std::span<const std::byte> bytes, const std::string& name) {
    const FileKind kind = kind_of_file(bytes, name);
    const bool known = !kind.name.empty() && kind.name != "a glTF scene" && kind.name != "a JSON file";
    if (known || is_binary(bytes)) throw input_error(not_a("glTF", kind), name, kind.hint);
}

}  // namespace

GltfDocument::GltfDocument(std::span<const std::byte> bytes, std::string name,
                           std::optional<std::filesystem::path> folder)
    : name_(std::move(name)), folder_(std::move(folder)) {
    Chunks chunks{bytes, {}};
    if (bytes.empty()) throw input_error("the file is empty", name_, "a .gltf or .glb file is expected");
    if (bytes.size() >= 4 && word(bytes, 0) == kGlbMagic)
        chunks = split_glb(bytes, name_);
    else
        check_is_text(bytes, name_);
    json_ = parse_json(chunks.json, name_, false);
    if (!json_.is_object()) throw input_error("not a glTF file: the JSON is not an object", name_);
    const std::string version = root()["asset"]["version"].string_or("");
    if (version.empty() || version[0] != '2') {
        throw input_error("not glTF 2.0", name_ + ": /asset/version",
                          version.empty() ? "every glTF file states its version" : "it says " + version);
    }
    // Also what this scene happens not to use: a list of the wrong type is a broken file, not an empty list.
    for (const char* list : {"buffers", "bufferViews", "accessors", "meshes", "nodes", "scenes", "materials",
                             "textures", "images", "samplers", "skins", "cameras", "animations"}) {
        (void)count(list);
    }
    file_bytes_ = bytes.size();
    load_buffers(chunks.binary);
    decompressed_.resize(count("bufferViews"));
}

std::vector<std::byte> GltfDocument::read_uri(const std::string& uri, const std::string& where) const {
    if (uri.starts_with("data:")) {
        const std::size_t comma = uri.find(',');
        if (comma == std::string::npos || uri.substr(0, comma).find(";base64") == std::string::npos) {
            throw input_error("data URI without base64", where);
        }
        return decode_base64(std::string_view(uri).substr(comma + 1), where);
    }
    if (!folder_) throw input_error("names an external file, but the scene was read from memory", where);
    return read_file(inside_folder(*folder_, uri, where), kMaxBufferBytes);
}

void GltfDocument::load_buffers(std::span<const std::byte> binary_chunk) {
    const std::size_t total = count("buffers");
    for (std::size_t i = 0; i < total; ++i) {
        const JsonView buffer = element("buffers", i);
        const std::uint64_t length = buffer["byteLength"].unsigned_or(0);
        const JsonView uri = buffer["uri"];
        const bool fallback = buffer["extensions"]["EXT_meshopt_compression"]["fallback"].bool_or(false);
        std::vector<std::byte> bytes;
        if (uri.exists()) {
            bytes = read_uri(uri.string_or(""), uri.where());
        } else if (i == 0 && !binary_chunk.empty()) {
            bytes.assign(binary_chunk.begin(), binary_chunk.end());
        } else if (!fallback && length > 0) {
            buffer.fail("a buffer without data", "it needs a uri, or the .glb's binary chunk");
        }
        if (!fallback && bytes.size() < length) {
            buffer["byteLength"].fail("promises " + std::to_string(length) + " bytes, there are " +
                                      std::to_string(bytes.size()));
        }
        file_bytes_ += bytes.size();
        if (file_bytes_ > 4 * std::uint64_t{kMaxBufferBytes})
            buffer.fail("the buffers hold more than 4 GiB together");
        buffers_.push_back(std::move(bytes));
    }
}

void GltfDocument::charge(std::uint64_t bytes, const JsonView& where) const {
    const std::uint64_t most = kFreeBytes + kBytesPerFileByte * file_bytes_;
    if (bytes > most || charged_bytes_ > most - bytes) {
        where.fail("the scene takes more memory than files of " + std::to_string(file_bytes_) +
                   " bytes can need");
    }
    charged_bytes_ += bytes;
}

std::span<const std::byte> GltfDocument::slice(const JsonView& view) const {
    const std::uint32_t buffer = view["buffer"].required_index_below(buffers_.size());
    const std::uint64_t offset = view["byteOffset"].unsigned_or(0);
    const std::uint64_t length = view["byteLength"].unsigned_or(0);
    const std::vector<std::byte>& bytes = buffers_[buffer];
    if (offset > bytes.size() || length > bytes.size() - offset) {
        view.fail("passes the end of its buffer: " + std::to_string(offset) + " + " + std::to_string(length) +
                  " of " + std::to_string(bytes.size()) + " bytes");
    }
    return std::span(bytes).subspan(static_cast<std::size_t>(offset), static_cast<std::size_t>(length));
}

std::span<const std::byte> GltfDocument::buffer_view(std::uint32_t index) const {
    const JsonView view = element("bufferViews", index);
    if (!view["extensions"]["EXT_meshopt_compression"].exists()) return slice(view);
    auto& cached = decompressed_.at(index);
    if (!cached) cached = decompress(index);
    return *cached;
}

std::size_t GltfDocument::buffer_view_stride(std::uint32_t index) const {
    const JsonView view = element("bufferViews", index);
    const JsonView meshopt = view["extensions"]["EXT_meshopt_compression"];
    const JsonView stride = meshopt.exists() ? meshopt["byteStride"] : view["byteStride"];
    const std::uint64_t bytes = stride.unsigned_or(0);
    if (bytes > 1024) stride.fail("is too large", "at most 252 in glTF");
    return static_cast<std::size_t>(bytes);
}

std::vector<std::byte> GltfDocument::decompress(std::uint32_t index) const {
    const JsonView packed = element("bufferViews", index)["extensions"]["EXT_meshopt_compression"];
    const std::span<const std::byte> source = slice(packed);
    const std::uint64_t count = packed["count"].unsigned_or(0);
    const std::uint64_t stride = packed["byteStride"].unsigned_or(0);
    const std::string mode = packed["mode"].string_or("");
    const std::string filter = packed["filter"].string_or("NONE");
    const bool index_mode = mode == "TRIANGLES" || mode == "INDICES";
    const bool stride_good =
        index_mode ? (stride == 2 || stride == 4) : (stride > 0 && stride <= 256 && stride % 4 == 0);
    if (!stride_good) packed["byteStride"].fail("does not fit the mode");
    // The codec never packs a vertex byte or an index into less than 1/256 of a byte for long; a larger claim
    // is a bomb.
    if (count > (std::uint64_t{1} << 28) || count * stride > (source.size() + 64) * 1024) {
        packed["count"].fail("promises more than the data can hold");
    }
    charge(count * stride, packed);
    std::vector<std::byte> out(static_cast<std::size_t>(count * stride));
    const auto* data = reinterpret_cast<const unsigned char*>(source.data());
    int result = -1;
    if (mode == "ATTRIBUTES") {
        result = meshopt_decodeVertexBuffer(out.data(), count, stride, data, source.size());
    } else if (mode == "TRIANGLES") {
        if (count % 3 != 0) packed["count"].fail("is not a multiple of three");
        result = meshopt_decodeIndexBuffer(out.data(), count, stride, data, source.size());
    } else if (mode == "INDICES") {
        result = meshopt_decodeIndexSequence(out.data(), count, stride, data, source.size());
    } else {
        packed["mode"].fail("is not a mode of EXT_meshopt_compression");
    }
    if (result != 0) packed.fail("its data cannot be decompressed", "the file is damaged");
    if (filter != "NONE" && mode != "ATTRIBUTES") packed["filter"].fail("is for the mode ATTRIBUTES only");
    if (filter == "OCTAHEDRAL" && (stride == 4 || stride == 8)) {
        meshopt_decodeFilterOct(out.data(), count, stride);
    } else if (filter == "QUATERNION" && stride == 8) {
        meshopt_decodeFilterQuat(out.data(), count, stride);
    } else if (filter == "EXPONENTIAL") {
        meshopt_decodeFilterExp(out.data(), count, stride);
    } else if (filter != "NONE") {
        packed["filter"].fail("is unknown, or does not fit the stride");
    }
    return out;
}

}  // namespace candela::io
