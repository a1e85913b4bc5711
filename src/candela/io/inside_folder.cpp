#include "candela/io/inside_folder.hpp"

#include <algorithm>
#include <cctype>
#include <system_error>

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

}  // namespace

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
