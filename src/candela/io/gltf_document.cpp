#include "candela/io/gltf_document.hpp"

#include <meshoptimizer.h>

#include <algorithm>
#include <charconv>

#include "candela/io/data_uri.hpp"
#include "candela/io/file_kind.hpp"
#include "candela/io/glb.hpp"
#include "candela/io/image_read.hpp"
#include "candela/io/json_reader.hpp"
#include "candela/io/scene_uri.hpp"
#include "candela/io/text_encoding.hpp"
#include "candela/scene/error.hpp"

namespace candela::io {
namespace {

constexpr std::size_t kMaxBufferBytes = (std::size_t{1} << 32) - 1;
/// What a scene may take before its files have to justify it, and how much each byte of them justifies: a
/// normalized byte becomes a float, vertices are shared by primitives and split at seams.
constexpr std::uint64_t kFreeBytes = std::uint64_t{1} << 29;
constexpr std::uint64_t kBytesPerFileByte = 64;

/// "2.1" as 2 and 1; nullopt for what is no version.
std::optional<std::pair<int, int>> parsed_version(const std::string& text) {
    std::pair<int, int> out{0, 0};
    const char* end = text.data() + text.size();
    const auto major = std::from_chars(text.data(), end, out.first);
    if (major.ec != std::errc{}) return std::nullopt;
    if (major.ptr == end) return out;
    if (*major.ptr != '.') return std::nullopt;
    const auto minor = std::from_chars(major.ptr + 1, end, out.second);
    if (minor.ec != std::errc{}) return std::nullopt;
    return out;
}

/// A version that is written as a number instead of a string.
std::string version_text(const json& document, const char* key) {
    const auto asset = document.find("asset");
    if (asset == document.end() || !asset->is_object() || !asset->contains(key)) return "";
    const json& value = (*asset)[key];
    return value.is_number() ? value.dump() : value.is_string() ? value.get<std::string>() : "";
}

/// What is no glTF at all is said as what it is, and not as JSON with a mistake.
void check_is_text(std::span<const std::byte> bytes, const std::string& name) {
    const FileKind kind = kind_of_file(bytes, name);
    const bool known = !kind.name.empty() && kind.name != "a glTF scene" && kind.name != "a JSON file";
    if (known || is_binary(bytes)) throw input_error(not_a("glTF", kind), name, kind.hint);
}

}  // namespace

GltfDocument::GltfDocument(std::span<const std::byte> bytes, std::string name,
                           std::optional<std::filesystem::path> folder, const scene::MemoryBudget& memory)
    : name_(std::move(name)), folder_(std::move(folder)), memory_(memory) {
    GlbChunks chunks{bytes, {}};
    if (bytes.empty()) throw input_error("the file is empty", name_, "a .gltf or .glb file is expected");
    if (is_glb(bytes))
        chunks = split_glb(bytes, name_, warnings_);
    else
        check_is_text(bytes, name_);
    std::string utf8;
    const std::string_view text(reinterpret_cast<const char*>(chunks.json.data()), chunks.json.size());
    if (!is_utf8(text)) {
        utf8 = repaired_utf8(text);
        chunks.json = std::as_bytes(std::span(utf8.data(), utf8.size()));
        warnings_.warn_at(name_, "text that is not UTF-8: read as Latin-1");
    }
    json_ = parse_json(chunks.json, name_, false, 64, &warnings_);
    if (!json_.is_object()) throw input_error("not a glTF file: the JSON is not an object", name_);
    check_version();
    // Also what this scene happens not to use: a list of the wrong type is a broken file, not an empty list.
    for (const char* list : {"buffers", "bufferViews", "accessors", "meshes", "nodes", "scenes", "materials",
                             "textures", "images", "samplers", "skins", "cameras", "animations"}) {
        if (array(list).exists() && !array(list).is_array()) array(list).fail("must be an array");
    }
    file_bytes_ = bytes.size();
    binary_chunk_ = chunks.binary;
    buffers_.resize(count("buffers"));
    decompressed_.resize(count("bufferViews"));
}

void GltfDocument::check_version() const {
    const std::string place = name_ + ": /asset/";
    const std::string text = version_text(json_, "version"), least = version_text(json_, "minVersion");
    const auto version = parsed_version(text);
    if (!version || version->first != 2) {
        throw input_error("not glTF 2.0", place + "version",
                          text.empty() ? "every glTF file states its version" : "it says " + text);
    }
    const auto needed = parsed_version(least);
    if (needed && *needed > std::pair(2, 0))
        throw input_error("the file needs glTF " + least, place + "minVersion", "glTF 2.0 is read");
    if (!least.empty() && !needed) warnings_.warn_at(place + "minVersion", "is no version: read as absent");
    if (*version != std::pair(2, 0))
        warnings_.warn_at(place + "version", "is " + text + ": what glTF 2.0 has of it is drawn");
    if (json_["asset"]["version"].is_number())
        warnings_.warn_at(place + "version", "must be a string: the number is read as one");
}

void GltfDocument::check_uri(const std::string& uri, const std::string& where) const {
    if (uri.starts_with("data:") || is_web_uri(uri) || uri.empty() || !folder_) return;
    PlacedWarnings said_later;
    (void)file_of_scene_uri(*folder_, uri, where, said_later);
}

std::vector<std::byte> GltfDocument::read_uri(const std::string& uri, const std::string& where,
                                              PlacedWarnings& warnings) const {
    if (uri.starts_with("data:")) return decode_data_uri(uri, where, warnings);
    if (!folder_) throw input_error("names an external file, but the scene was read from memory", where);
    return read_file(file_of_scene_uri(*folder_, uri, where, warnings), kMaxBufferBytes);
}

std::span<const std::byte> GltfDocument::buffer(std::uint32_t index) const {
    if (buffers_[index]) return *buffers_[index];
    const JsonView json_buffer = element("buffers", index);
    const std::uint64_t length = json_buffer["byteLength"].unsigned_or(0);
    const JsonView uri = json_buffer["uri"];
    std::span<const std::byte> bytes;
    if (uri.exists()) {
        bytes = owned_.emplace_back(read_uri(uri.string_or(""), uri.where(), warnings_));
    } else if (index == 0 && !binary_chunk_.empty()) {
        bytes = binary_chunk_;
    } else {
        json_buffer.fail("a buffer without data", "it needs a uri, or the .glb's binary chunk");
    }
    if (bytes.size() < length) {
        warnings_.warn_at(json_buffer["byteLength"].where(),
                          "promises " + std::to_string(length) + " bytes, there are " +
                              std::to_string(bytes.size()) + ": what is there is read");
    }
    file_bytes_ += bytes.size();
    reserve(bytes.size(), json_buffer);
    buffers_[index] = bytes;
    return bytes;
}

void GltfDocument::charge(std::uint64_t bytes, const JsonView& where) const {
    const std::uint64_t most = kFreeBytes + kBytesPerFileByte * file_bytes_;
    if (bytes > most || charged_bytes_ > most - bytes) {
        out_of_memory_ = true;
        where.fail("the scene takes more memory than files of " + std::to_string(file_bytes_) +
                   " bytes can need");
    }
    charged_bytes_ += bytes;
    reserve(bytes, where);
}

void GltfDocument::reserve(std::uint64_t bytes, const JsonView& where) const {
    memory_.require(reserved_bytes_ + bytes, "the scene takes", where.where());
    reserved_bytes_ += bytes;
}

std::span<const std::byte> GltfDocument::slice(const JsonView& view) const {
    const std::uint32_t index = view["buffer"].required_index_below(buffers_.size());
    const std::span<const std::byte> bytes = buffer(index);
    const std::uint64_t offset = view["byteOffset"].unsigned_or(0);
    const std::uint64_t length = view["byteLength"].unsigned_or(0);
    if (offset > bytes.size()) {
        view.fail("starts behind the end of its buffer: byte " + std::to_string(offset) + " of " +
                  std::to_string(bytes.size()));
    }
    const std::uint64_t there = bytes.size() - offset;
    const std::uint64_t declared = element("buffers", index)["byteLength"].unsigned_or(0);
    if (length <= there && offset + length > declared) {
        warnings_.warn_at(view.where(), "passes its buffer's byteLength of " + std::to_string(declared) +
                                            ": the data that is there is read");
    }
    if (length > there) {
        warnings_.warn_at(view.where(), "passes the end of its buffer by " + std::to_string(length - there) +
                                            " bytes: what is there is read");
    }
    return bytes.subspan(static_cast<std::size_t>(offset), static_cast<std::size_t>(std::min(length, there)));
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
    // Of what is cut off nothing can be decoded.
    if (source.size() < packed["byteLength"].unsigned_or(0)) packed.fail("passes the end of its buffer");
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
