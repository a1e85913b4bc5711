#include "candela/io/inside_folder.hpp"

#include <algorithm>
#include <cctype>
#include <system_error>

#include "candela/io/environment_faces.hpp"
#include "candela/io/percent_encoding.hpp"
#include "candela/scene/error.hpp"

namespace candela::io {
namespace fs = std::filesystem;
namespace {

bool has_scheme(const std::string& uri) {
    const std::size_t colon = uri.find(':');
    return colon != std::string::npos && colon > 0 && std::isalpha(static_cast<unsigned char>(uri[0])) &&
           std::all_of(uri.begin(), uri.begin() + static_cast<std::ptrdiff_t>(colon),
                       [](unsigned char c) { return std::isalnum(c) || c == '+' || c == '-' || c == '.'; });
}

bool is_below(const fs::path& folder, const fs::path& file) {
    const auto [end, at] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
    (void)at;
    return end == folder.end() || end->empty();
}

/// A file, a folder of faces, or what NAME_{face} stands for.
bool is_there(const fs::path& file) {
    std::error_code none;
    if (fs::exists(file, none)) return true;
    if (!detail::is_face_pattern(file)) return false;
    try {
        (void)detail::faces_of_pattern(file);
        return true;
    } catch (const Error&) {
        return false;
    }
}

fs::path absolute_inside(const SearchFolders& folders, const fs::path& file, const std::string& where) {
    std::error_code error;
    const fs::path real_file = fs::weakly_canonical(file, error);
    std::vector<fs::path> all{folders.own};
    all.insert(all.end(), folders.more.begin(), folders.more.end());
    for (const fs::path& folder : all) {
        std::error_code missing;
        const fs::path real_folder = fs::canonical(folder, missing);
        if (!error && !missing && is_below(real_folder, real_file)) return file;
    }
    throw input_error("absolute path outside of the stage's folder: " + file.string(), where,
                      "--search " + file.parent_path().string() + " allows it");
}

}  // namespace

fs::path inside_folders(const SearchFolders& folders, const std::string& uri, const std::string& where) {
    if (fs::path(uri).is_absolute()) return absolute_inside(folders, fs::path(uri).lexically_normal(), where);
    for (const fs::path& folder : folders.more) {
        std::error_code none;
        if (!fs::is_directory(folder, none))
            throw input_error("no such folder", folder.string(), "--search DIR");
    }
    const fs::path own = inside_folder(folders.own, uri, where);
    if (is_there(own)) return own;
    for (const fs::path& folder : folders.more) {
        fs::path file = inside_folder(folder, uri, where);
        if (is_there(file)) return file;
    }
    return own;
}

fs::path inside_folder(const fs::path& folder, const std::string& uri, const std::string& where) {
    constexpr const char* hint = "only files in the same folder or below are read";
    if (has_scheme(uri)) throw input_error("URI with a scheme: " + uri, where, hint);
    const std::string decoded = percent_decoded(uri);
    if (decoded.empty() || decoded.find('\0') != std::string::npos)
        throw input_error("empty or broken URI", where);
    const fs::path relative(decoded);
    if (relative.is_absolute() || decoded[0] == '\\')
        throw input_error("absolute path: " + decoded, where, hint);
    const fs::path normal = relative.lexically_normal();
    if (!normal.empty() && *normal.begin() == "..")
        throw input_error("path leaves the folder: " + decoded, where, hint);
    const fs::path file = folder / normal;
    // Symbolic links are followed before judging; a file that does not exist is reported by whoever opens it.
    std::error_code error;
    const fs::path real_folder = fs::canonical(folder, error);
    if (error) throw input_error("no such folder", folder.string());
    const fs::path real_file = fs::weakly_canonical(file, error);
    if (error || !is_below(real_folder, real_file))
        throw input_error("path leaves the folder: " + decoded, where, hint);
    return file;
}

}  // namespace candela::io
