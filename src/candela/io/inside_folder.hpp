#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace candela::io {

/// Where a stage may find its files: its own folder, then those that the user named, in order. Nothing
/// outside of them and what is below them is read, whatever the stage says.
struct SearchFolders {
    std::filesystem::path own;
    std::vector<std::filesystem::path> more;
};

/// The file that a stage names, by a path relative to one of the folders (the first in which it exists, else
/// in the own one) or by an absolute path. Throws Error (Fault::input) at `where` for another scheme and for
/// whatever lies outside of all folders, by an absolute path, by ".." or by a symbolic link.
[[nodiscard]] std::filesystem::path inside_folders(const SearchFolders& folders, const std::string& uri,
                                                   const std::string& where);

/// The file that a relative URI of a scene or stage names. Throws Error (Fault::input) at `where` for
/// absolute paths, other schemes, and whatever leaves `folder`, by ".." or by a symbolic link. The URI is
/// percent-decoded.
[[nodiscard]] std::filesystem::path inside_folder(const std::filesystem::path& folder, const std::string& uri,
                                                  const std::string& where);

}  // namespace candela::io
