#include "candela/io/output_folder.hpp"

#include <unistd.h>

namespace candela::io {
namespace {

namespace fs = std::filesystem;

/// Without a slash at its end, which would make it its own parent.
fs::path trimmed(const fs::path& folder) {
    if (folder.empty()) return ".";
    return folder.has_filename() || !folder.has_relative_path() ? folder : folder.parent_path();
}

void check_writable(const fs::path& folder) {
    if (access(folder.c_str(), W_OK) != 0)
        throw input_error("nothing can be written into this folder", folder.string());
}

}  // namespace

void check_output_folder(const fs::path& asked) {
    const fs::path folder = trimmed(asked);
    std::error_code ignored;
    if (fs::is_directory(folder, ignored)) return check_writable(folder);
    if (fs::exists(fs::symlink_status(folder, ignored)))
        throw input_error("is not a folder", folder.string(), "-o FOLDER");
    const fs::path parent = folder.has_parent_path() ? folder.parent_path() : fs::path(".");
    if (!fs::is_directory(parent, ignored))
        throw input_error("the folder does not exist", parent.string(),
                          "make it first: only the last one of " + folder.string() + " would be made");
    check_writable(parent);
}

void check_output_file(const fs::path& file) {
    std::error_code ignored;
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    if (!fs::is_directory(folder, ignored))
        throw input_error("the folder does not exist", folder.string(), "make it first");
    check_writable(folder);
    if (fs::is_directory(file, ignored)) throw input_error("is a folder", file.string());
}

Error folder_error(const std::error_code& failure, const fs::path& folder) {
    const bool disk = failure == std::errc::no_space_on_device || failure == std::errc::io_error;
    return {disk ? Fault::machine : Fault::input, "cannot be made: " + failure.message(), folder.string()};
}

bool make_output_folder(const fs::path& asked) {
    check_output_folder(asked);
    std::error_code failure;
    const bool made = fs::create_directory(trimmed(asked), failure);
    if (!failure) return made;
    throw folder_error(failure, asked);
}

}  // namespace candela::io
