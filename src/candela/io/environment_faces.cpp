#include "candela/io/environment_faces.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "candela/scene/error.hpp"

namespace candela::io::detail {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPlace = "{face}";
constexpr const char* kHint =
    "px, nx, py, ny, pz, nz; or posx, negx...; or right, left, top, bottom, front, back";

constexpr std::array<std::array<const char*, 6>, 3> kNames{
    {{"px", "nx", "py", "ny", "pz", "nz"},
     {"posx", "negx", "posy", "negy", "posz", "negz"},
     {"right", "left", "top", "bottom", "front", "back"}}};

/// "px" or "sky_px", but not "apx".
bool ends_with_face(const std::string& stem, const std::string& face) {
    if (!stem.ends_with(face)) return false;
    if (stem.size() == face.size()) return true;
    const char before = stem[stem.size() - face.size() - 1];
    return before == '_' || before == '-' || before == '.';
}

bool ends_with_one_of(const fs::path& file, std::initializer_list<const char*> extensions) {
    return std::any_of(extensions.begin(), extensions.end(),
                       [&](const char* e) { return file.extension() == e; });
}

/// Pictures for displays where there are none of light.
std::vector<fs::path> light_files(const fs::path& folder) {
    std::error_code failure;
    std::vector<fs::path> out, others;
    for (fs::directory_iterator entry(folder, failure), end; !failure && entry != end;
         entry.increment(failure)) {
        if (ends_with_one_of(entry->path(), {".hdr", ".exr"})) out.push_back(entry->path());
        if (ends_with_one_of(entry->path(), {".png", ".jpg", ".jpeg", ".webp"}))
            others.push_back(entry->path());
    }
    if (failure) throw input_error("cannot be read: " + failure.message(), folder.string());
    if (out.empty()) out = std::move(others);
    std::sort(out.begin(), out.end());
    return out;
}

}  // namespace

bool is_face_pattern(const fs::path& file) {
    return file.filename().string().find(kPlace) != std::string::npos;
}

FaceFiles faces_of_pattern(const fs::path& pattern) {
    const std::string name = pattern.filename().string();
    const std::size_t at = name.find(kPlace);
    for (const auto& names : kNames) {
        FaceFiles out;
        std::transform(names.begin(), names.end(), out.begin(), [&](const char* face) {
            return pattern.parent_path() / std::string(name).replace(at, std::string(kPlace).size(), face);
        });
        if (std::all_of(out.begin(), out.end(), [](const fs::path& f) { return fs::exists(f); })) return out;
    }
    throw input_error("the six faces are not there", pattern.string(),
                      std::string("{face} stands for ") + kHint);
}

FaceFiles faces_of_folder(const fs::path& folder) {
    const std::vector<fs::path> files = light_files(folder);
    for (const auto& names : kNames) {
        FaceFiles out;
        std::size_t found = 0;
        for (std::size_t face = 0; face < 6; ++face) {
            for (const fs::path& file : files) {
                if (!ends_with_face(file.stem().string(), names[face])) continue;
                if (!out[face].empty())
                    throw input_error(std::string("two files for the face ") + names[face], folder.string(),
                                      "name one set: FOLDER/sky_{face}.exr");
                out[face] = file;
                ++found;
            }
        }
        if (found == 6) return out;
    }
    throw input_error("the folder does not hold the six .hdr, .exr, .png or .jpg faces of a cube",
                      folder.string(), std::string("names that end with ") + kHint);
}

}  // namespace candela::io::detail
