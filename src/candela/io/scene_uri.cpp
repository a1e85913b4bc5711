#include "candela/io/scene_uri.hpp"

#include <algorithm>
#include <cctype>
#include <optional>
#include <system_error>
#include <vector>

#include "candela/io/inside_folder.hpp"
#include "candela/io/percent_encoding.hpp"
#include "candela/io/text_encoding.hpp"

namespace candela::io {
namespace {

namespace fs = std::filesystem;

/// A folder with more entries is not searched for another spelling.
constexpr std::size_t kMostEntries = 100000;

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
    return text;
}

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
}

/// A path as a URI that decodes to it.
std::string literal(const std::string& path) {
    return replaced(path, "%", "%25");
}

bool is_there(const fs::path& file) {
    std::error_code none;
    return fs::exists(file, none);
}

struct Spelling {
    std::string uri;
    const char* repair;
};

/// Each with all repairs before it.
std::vector<Spelling> spellings(const std::string& uri) {
    std::vector<Spelling> out;
    std::string now = uri;
    const auto add = [&](const std::string& next, const char* repair) {
        if (next.empty() || next == now) return;
        now = next;
        out.push_back({next, repair});
    };
    add(replaced(replaced(replaced(now, "\\", "/"), "%5C", "/"), "%5c", "/"),
        "backslashes in a URI: read as slashes");
    const std::size_t suffix = now.find_first_of("?#");
    if (suffix != std::string::npos && suffix > 0)
        add(now.substr(0, suffix), "a query or fragment behind a file's name: not read");
    add(literal(now), "a percent sign in a URI that is part of the file's name: read so");
    return out;
}

/// The file whose path is the same but for upper and lower case; the first in the alphabet of several.
std::optional<fs::path> in_any_case(const fs::path& folder, const fs::path& relative) {
    fs::path at = folder;
    for (const fs::path& part : relative) {
        if (is_there(at / part)) {
            at /= part;
            continue;
        }
        std::error_code error;
        std::vector<std::string> found;
        std::size_t entries = 0;
        for (fs::directory_iterator entry(at, error), end; !error && entry != end; entry.increment(error)) {
            if (++entries > kMostEntries) return std::nullopt;
            const std::string name = entry->path().filename().string();
            if (lower(name) == lower(part.string())) found.push_back(name);
        }
        if (found.empty()) return std::nullopt;
        at /= *std::min_element(found.begin(), found.end());
    }
    return at;
}

}  // namespace

bool is_web_uri(const std::string& uri) {
    const std::string start = lower(uri.substr(0, 8));
    return start.starts_with("http://") || start.starts_with("https://");
}

fs::path file_of_scene_uri(const fs::path& folder, const std::string& uri, const std::string& where,
                           PlacedWarnings& warnings) {
    const fs::path first = inside_folder(folder, uri, where);
    if (is_there(first)) return first;
    std::vector<fs::path> tried{first};
    for (const Spelling& s : spellings(uri)) {
        const fs::path file = inside_folder(folder, s.uri, where);
        if (is_there(file)) {
            warnings.warn_at(where, s.repair);
            return file;
        }
        tried.push_back(file);
    }
    for (const fs::path& file : tried) {
        const fs::path relative = file.lexically_relative(folder);
        if (relative.empty() || *relative.begin() == "..") continue;
        const std::string latin1 = to_latin1(relative.string());
        if (!latin1.empty() && latin1 != relative.string() && is_there(folder / latin1)) {
            warnings.warn_at(where, "a file whose name is in Latin-1: found so");
            return inside_folder(folder, "./" + literal(latin1), where);
        }
        if (const auto found = in_any_case(folder, relative)) {
            warnings.warn_at(where,
                             "a file's name in upper and lower case other than the file's: found as \"" +
                                 found->filename().string() + "\"");
            return inside_folder(folder, "./" + literal(found->lexically_relative(folder).string()), where);
        }
    }
    return first;
}

}  // namespace candela::io
