#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "candela/scene/diagnostics.hpp"
#include "candela/scene/memory_budget.hpp"

namespace candela::io {

using nlohmann::json;

/// A JSON value together with the JSON pointer that an error names. Every read checks the type; absent is not
/// wrong.
class JsonView {
  public:
    JsonView(const json* value, std::string where) : value_(value), where_(std::move(where)) {}

    [[nodiscard]] bool exists() const noexcept { return value_ != nullptr; }
    [[nodiscard]] const std::string& where() const noexcept { return where_; }

    /// Member `key` of an object; does not exist when absent. Throws Error when this is not an object.
    [[nodiscard]] JsonView operator[](const char* key) const;
    /// Element of an array; throws Error when out of range.
    [[nodiscard]] JsonView operator[](std::size_t index) const;
    /// Elements of an array; 0 when absent.
    [[nodiscard]] std::size_t size() const;
    [[nodiscard]] std::vector<std::string> keys() const;

    [[nodiscard]] std::string string_or(const std::string& fallback) const;
    [[nodiscard]] bool bool_or(bool fallback) const;
    [[nodiscard]] float float_or(float fallback) const;  ///< finite
    [[nodiscard]] std::optional<std::uint64_t> unsigned_integer() const;
    [[nodiscard]] std::uint64_t unsigned_or(std::uint64_t fallback) const;
    /// An index below `count`; nullopt when absent.
    [[nodiscard]] std::optional<std::uint32_t> index_below(std::size_t count) const;
    /// An index that has to be there.
    [[nodiscard]] std::uint32_t required_index_below(std::size_t count) const;
    /// Exactly N finite numbers into `out`; false when absent.
    bool floats(std::span<float> out) const;
    bool doubles(std::span<double> out) const;

    [[noreturn]] void fail(const std::string& what, const std::string& hint = {}) const;

  private:
    const json* value_;
    std::string where_;
};

/// A parsed .gltf or .glb with its buffers in memory.
class GltfDocument {
  public:
    /// `folder`: where external buffers are looked for; nullopt makes every external URI an error. The bytes
    /// must outlive the document: a .glb's buffer stays among them.
    GltfDocument(std::span<const std::byte> bytes, std::string name,
                 std::optional<std::filesystem::path> folder,
                 const scene::MemoryBudget& memory = scene::available_memory());

    [[nodiscard]] JsonView root() const { return {&json_, name_ + ": "}; }
    [[nodiscard]] JsonView array(const char* key) const { return root()[key]; }
    [[nodiscard]] JsonView element(const char* key, std::size_t index) const { return root()[key][index]; }
    [[nodiscard]] std::size_t count(const char* key) const { return array(key).size(); }
    [[nodiscard]] const std::string& name() const noexcept { return name_; }
    [[nodiscard]] const std::optional<std::filesystem::path>& folder() const noexcept { return folder_; }

    /// Bytes of a buffer view, decompressed where EXT_meshopt_compression says so. Throws Error when it
    /// leaves its buffer.
    [[nodiscard]] std::span<const std::byte> buffer_view(std::uint32_t index) const;
    /// Counts bytes taken on behalf of `where`; throws Error when they outgrow what files of this size need.
    /// What may be referred to again and again (accessors, meshes) must not turn a small file into a large
    /// scene.
    void charge(std::uint64_t bytes, const JsonView& where) const;
    /// Counts bytes that nothing but the machine's memory bounds, such as decoded images; throws Error when
    /// the scene then takes more than the budget.
    void reserve(std::uint64_t bytes, const JsonView& where) const;

    /// byteStride of a view, 0 when tightly packed.
    [[nodiscard]] std::size_t buffer_view_stride(std::uint32_t index) const;

    /// Bytes behind a URI: base64 data or a file of the scene's folder.
    [[nodiscard]] std::vector<std::byte> read_uri(const std::string& uri, const std::string& where) const;

  private:
    void load_buffers(std::span<const std::byte> binary_chunk);
    [[nodiscard]] std::vector<std::byte> decompress(std::uint32_t view) const;
    [[nodiscard]] std::span<const std::byte> slice(const JsonView& view) const;

    std::string name_;
    std::optional<std::filesystem::path> folder_;
    json json_;
    std::vector<std::span<const std::byte>> buffers_;
    std::deque<std::vector<std::byte>> owned_;  ///< of those that are not a part of the file
    mutable std::vector<std::optional<std::vector<std::byte>>> decompressed_;
    std::uint64_t file_bytes_ = 0;
    mutable std::uint64_t charged_bytes_ = 0;
    scene::MemoryBudget memory_;
    mutable std::uint64_t reserved_bytes_ = 0;
};

}  // namespace candela::io
