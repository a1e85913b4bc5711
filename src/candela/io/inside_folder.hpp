#pragma once

#include <filesystem>
#include <string>

namespace candela::io {

/// The file that a relative URI of a scene or stage names. Throws Error (Fault::input) at `where` for
/// absolute paths, other schemes, and whatever leaves `folder`, by ".." or by a symbolic link. The URI is
/// percent-decoded.
[[nodiscard]] std::filesystem::path inside_folder(const std::filesystem::path& folder, const std::string& uri,
                                                  const std::string& where);

}  // namespace candela::io
