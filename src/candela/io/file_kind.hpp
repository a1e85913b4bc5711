#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace candela::io {

/// What a file is that turned out not to be what was expected: by its first bytes, else by the ending of its
/// name.
struct FileKind {
    std::string name;         ///< "a PNG picture", "an OBJ mesh"; empty: unknown
    std::string hint;         ///< what to do with one where a scene is expected; may be empty
    bool by_content = false;  ///< not by its name alone
};

[[nodiscard]] FileKind kind_of_file(std::span<const std::byte> bytes, const std::filesystem::path& file);
/// Of a file's first bytes. Unknown for one that cannot be read.
[[nodiscard]] FileKind kind_of_file(const std::filesystem::path& file);

/// "not glTF" or, where the kind is known, "not glTF: an OBJ mesh".
[[nodiscard]] std::string not_a(const std::string& expected, const FileKind& kind);

}  // namespace candela::io
