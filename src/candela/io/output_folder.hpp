#pragma once

#include <filesystem>
#include <system_error>

#include "candela/scene/error.hpp"

/// The folder that files are asked for, by one rule for every command: it is made when it is missing, its
/// parent is not. A name with a mistake in its middle would otherwise become a tree.
namespace candela::io {

/// Refuses what make_output_folder would, without making anything: for before long work. Throws Error
/// (Fault::input).
void check_output_folder(const std::filesystem::path& folder);

/// The same of a file that is asked for: its folder is there and may be written to, and it is not one itself.
void check_output_file(const std::filesystem::path& file);

/// What is said of a folder that cannot be made: the machine's fault when the disk is, else the request's.
[[nodiscard]] Error folder_error(const std::error_code& failure, const std::filesystem::path& folder);

/// True when it was made now. Throws Error: Fault::input, or Fault::machine when the disk fails.
bool make_output_folder(const std::filesystem::path& folder);

}  // namespace candela::io
