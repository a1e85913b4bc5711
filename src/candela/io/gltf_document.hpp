#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "candela/io/placed_warnings.hpp"
#include "candela/scene/error.hpp"
#include "candela/scene/memory_budget.hpp"

namespace candela::io {

using nlohmann::json;

/// A JSON value together with the JSON pointer that messages name. Absent is not wrong. A value of the wrong
/// type is read as absent, with a warning, wherever the scene can be drawn without it; what says how much
/// data there is and where must be right.
class JsonView {
  public:
    JsonView(const json* value, std::string where, PlacedWarnings* warnings)
        : value_(value), where_(std::move(where)), warnings_(warnings) {}

    [[nodiscard]] bool exists() const noexcept { return value_ != nullptr; }
    [[nodiscard]] const std::string& where() const noexcept { return where_; }

    /// Member `key` of an object; does not exist when absent or null, or when this is not an object.
    [[nodiscard]] JsonView operator[](const char* key) const;
    /// Element of an array; throws Error when out of range.
    [[nodiscard]] JsonView operator[](std::size_t index) const;
    /// Elements of an array; 0 when absent or not an array.
    [[nodiscard]] std::size_t size() const;
    [[nodiscard]] bool is_array() const;
    /// A number below 0, such as the -1 that some exporters write for "none".
    [[nodiscard]] bool is_negative() const;
    [[nodiscard]] std::vector<std::string> keys() const;

    [[nodiscard]] std::string string_or(const std::string& fallback) const;
    /// One of the names, in whatever case it is written; with a warning the first one for any other value.
    [[nodiscard]] std::string one_of(std::initializer_list<const char*> names, bool optional = true) const;
    [[nodiscard]] bool bool_or(bool fallback) const;
    /// Whether this is an object with this member true; whatever else it is, is no error.
    [[nodiscard]] bool has_true(const char* key) const noexcept;
    [[nodiscard]] float float_or(float fallback) const;  ///< finite
    /// Throws Error for what is not a whole number of 0 or more.
    [[nodiscard]] std::optional<std::uint64_t> unsigned_integer() const;
    [[nodiscard]] std::uint64_t unsigned_or(std::uint64_t fallback) const;
    /// A value that the scene can be drawn without: nullopt, with a warning, for what is no such number.
    [[nodiscard]] std::optional<std::uint64_t> optional_unsigned() const;
    /// An index below `count` of something that the scene can be drawn without; nullopt when absent, and with
    /// a warning when it is out of range.
    [[nodiscard]] std::optional<std::uint32_t> index_below(std::size_t count) const;
    /// As index_below, but throws Error for what is not such an index.
    [[nodiscard]] std::optional<std::uint32_t> strict_index_below(std::size_t count) const;
    /// An index that has to be there.
    [[nodiscard]] std::uint32_t required_index_below(std::size_t count) const;
    /// N finite numbers into `out`; false, with `out` as it was, when absent or (with a warning) not such a
    /// list.
    bool floats(std::span<float> out) const;
    bool doubles(std::span<double> out) const;
    /// As floats, but takes what a list of another length has: the rest of `out` stays.
    void leading_floats(std::span<float> out) const;

    [[noreturn]] void fail(const std::string& what, const std::string& hint = {}) const;
    /// Warns that this value was not taken as it stands: `what` says what it is instead and the repair.
    void repaired(const std::string& what) const;

  private:
    const json* value_;
    std::string where_;
    PlacedWarnings* warnings_;
};

/// A parsed .gltf or .glb with its buffers in memory.
class GltfDocument {
  public:
    /// `folder`: where external buffers are looked for; nullopt makes every external URI an error. The bytes
    /// must outlive the document: a .glb's buffer stays among them.
    GltfDocument(std::span<const std::byte> bytes, std::string name,
                 std::optional<std::filesystem::path> folder,
                 const scene::MemoryBudget& memory = scene::available_memory());

    [[nodiscard]] JsonView root() const { return {&json_, name_ + ": ", &warnings_}; }
    [[nodiscard]] JsonView array(const char* key) const { return root()[key]; }
    [[nodiscard]] JsonView element(const char* key, std::size_t index) const { return root()[key][index]; }
    [[nodiscard]] std::size_t count(const char* key) const { return array(key).size(); }
    [[nodiscard]] const std::string& name() const noexcept { return name_; }
    /// What was read otherwise than it stands in the file.
    [[nodiscard]] PlacedWarnings& warnings() const noexcept { return warnings_; }
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

    /// Bytes behind a URI: data, or a file of the scene's folder. From any thread, each with its own
    /// warnings.
    [[nodiscard]] std::vector<std::byte> read_uri(const std::string& uri, const std::string& where,
                                                  PlacedWarnings& warnings) const;
    /// Throws Error for a URI that may not be read at all: one that leaves the scene's folder.
    void check_uri(const std::string& uri, const std::string& where) const;

    /// Calls read(), which throws Error for what is broken; then, with a warning, the scene goes on without
    /// it. What is about the machine's memory is thrown on. `repair`: "drawn without it".
    template <class Read>
    void try_to_read(const JsonView& view, const char* repair, const Read& read) const {
        try {
            read();
        } catch (const Error& error) {
            if (error.fault() != Fault::input || out_of_memory_) throw;
            // An error about another file says which; the place is where the scene names it.
            const bool here = error.where().starts_with(name_);
            const std::string file = here || error.where().empty() ? "" : error.where() + ": ";
            warnings_.warn_at(here ? error.where() : view.where(), file + error.what() + ": " + repair);
        }
    }

  private:
    void check_version() const;
    /// Loads the buffer when it is first asked for: what no view uses is not read.
    [[nodiscard]] std::span<const std::byte> buffer(std::uint32_t index) const;
    [[nodiscard]] std::vector<std::byte> decompress(std::uint32_t view) const;
    [[nodiscard]] std::span<const std::byte> slice(const JsonView& view) const;

    std::string name_;
    std::optional<std::filesystem::path> folder_;
    json json_;
    mutable PlacedWarnings warnings_;
    std::span<const std::byte> binary_chunk_;
    mutable std::vector<std::optional<std::span<const std::byte>>> buffers_;
    mutable std::deque<std::vector<std::byte>> owned_;  ///< of those that are not a part of the file
    mutable std::vector<std::optional<std::vector<std::byte>>> decompressed_;
    mutable std::uint64_t file_bytes_ = 0;
    mutable bool out_of_memory_ = false;
    mutable std::uint64_t charged_bytes_ = 0;
    scene::MemoryBudget memory_;
    mutable std::uint64_t reserved_bytes_ = 0;
};

}  // namespace candela::io
