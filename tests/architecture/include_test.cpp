#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>

#include "source_folder.hpp"

namespace fs = std::filesystem;

namespace {

const fs::path kSource = CANDELA_SOURCE_DIR;

/// Which rooms a room may include, itself aside: the arrows of docs/architecture.md.
const std::map<std::string, std::set<std::string>> kArrows{
    {"scene", {}},
    {"io", {"scene"}},
    {"gpu", {"scene"}},
    {"bake", {"gpu", "scene"}},
    {"realtime", {"bake", "gpu", "scene"}},
    {"truth", {"bake", "gpu", "io", "scene"}},
    {"measure", {"realtime", "truth", "bake", "gpu", "io", "scene"}}};

std::vector<std::string> includes_of(const fs::path& file) {
    static const std::regex include(R"(^\s*#\s*include\s+["<]([^">]+)[">])");
    std::vector<std::string> out;
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
        std::smatch match;
        if (std::regex_search(line, match, include)) out.push_back(match[1]);
    }
    return out;
}

bool is_source(const fs::path& file) {
    const std::string e = file.extension().string();
    return e == ".cpp" || e == ".hpp" || e == ".glsl";
}

}  // namespace

TEST(Architecture, ArrowsRunOneWay) {
    std::size_t checked = 0;
    for (const auto& entry : fs::recursive_directory_iterator(kSource / "src" / "candela")) {
        if (!entry.is_regular_file() || !is_source(entry.path()) || entry.path().extension() == ".glsl")
            continue;
        const std::string room = fs::relative(entry.path(), kSource / "src" / "candela").begin()->string();
        const auto allowed = kArrows.find(room);
        if (allowed == kArrows.end()) continue;  // the library's own files at the top
        for (const std::string& include : includes_of(entry.path())) {
            if (!include.starts_with("candela/")) continue;
            const std::string target = *std::next(fs::path(include).begin());
            if (target == room) continue;
            ++checked;
            EXPECT_TRUE(allowed->second.contains(target)) << entry.path() << " includes " << include;
        }
    }
    EXPECT_GT(checked, 20u) << "the test found nothing to check";
}

TEST(Architecture, ShadingIncludesNothingButItself) {
    for (const auto& entry : fs::recursive_directory_iterator(kSource / "shading")) {
        if (!entry.is_regular_file()) continue;
        for (const std::string& include : includes_of(entry.path())) {
            const bool language = entry.path().filename() == "language.glsl" &&
                                  (include.starts_with("glm/") || include == "cmath" || include == "cstdint");
            const fs::path target = entry.path().parent_path() / include;
            EXPECT_TRUE(language || fs::exists(target)) << entry.path() << " includes " << include;
        }
    }
}

// A file longer than this cannot be read in one sitting.
TEST(Architecture, FilesStaySmall) {
    for (const char* folder : {"src", "apps", "shading", "scenes"}) {
        for (const auto& entry : fs::recursive_directory_iterator(kSource / folder)) {
            if (!entry.is_regular_file() || !is_source(entry.path())) continue;
            std::ifstream in(entry.path());
            const auto lines = std::count(std::istreambuf_iterator<char>(in), {}, '\n');
            EXPECT_LE(lines, 450) << entry.path();
        }
    }
}
