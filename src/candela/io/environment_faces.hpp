#pragma once

#include <array>
#include <filesystem>

namespace candela::io::detail {

using FaceFiles = std::array<std::filesystem::path, 6>;  ///< +X -X +Y -Y +Z -Z

/// Is {face} in the name?
[[nodiscard]] bool is_face_pattern(const std::filesystem::path& file);

/// The six files of a pattern that exist. Throws Error (Fault::input).
[[nodiscard]] FaceFiles faces_of_pattern(const std::filesystem::path& pattern);

/// The six .hdr or .exr files of a folder whose names end with a face's. Throws Error (Fault::input), also
/// for two files of one face.
[[nodiscard]] FaceFiles faces_of_folder(const std::filesystem::path& folder);

}  // namespace candela::io::detail
