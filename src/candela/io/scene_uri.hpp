#pragma once

#include <filesystem>
#include <string>

#include "candela/io/placed_warnings.hpp"

namespace candela::io {

/// The file of `folder` that a scene's relative URI means. Where no file is called as the URI says, the
/// spellings that exporters leave behind are tried, each with a warning: backslashes for slashes, a query
/// ("?v=3") or fragment behind the name, a percent sign that is part of the name, a name in Latin-1, upper
/// and lower case mixed up. Throws Error (Fault::input) at `where`, as inside_folder, when the URI, or what a
/// repair makes of it, leaves the folder.
[[nodiscard]] std::filesystem::path file_of_scene_uri(const std::filesystem::path& folder,
                                                      const std::string& uri, const std::string& where,
                                                      PlacedWarnings& warnings);

/// Whether the URI is to be fetched from the web, which is never done.
[[nodiscard]] bool is_web_uri(const std::string& uri);

}  // namespace candela::io
