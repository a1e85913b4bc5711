#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "common/files.hpp"
#include "gltf_samples.hpp"

/// Slips that other viewers draw are drawn, each with one warning that names the place and the repair.
namespace candela::test {

struct Slip {
    const char* name;
    const char* warning;  ///< a fragment; empty: nothing is said
    std::function<void(const std::filesystem::path& folder)> write_files;
    std::function<void(const scene::Scene&)> check = [](const scene::Scene&) {};
};
inline void PrintTo(const Slip& s, std::ostream* out) {
    *out << s.name;
}

inline constexpr const char* kScene = "slip.gltf";

inline void put(const std::filesystem::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
}

inline std::string text_of(const std::vector<std::byte>& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// One textured triangle with normals and two sets of UV.
inline GltfBuilder textured() {
    GltfBuilder b = with_material({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    add_texture(b, png_of_four_texels());
    return b;
}

using Damage = std::function<void(GltfBuilder&)>;
using Check = std::function<void(const scene::Scene&)>;

inline Slip damaged(
    const char* name, const char* warning, const Damage& damage,
    const Check& check = [](const scene::Scene&) {}) {
    return {name, warning,
            [=](const std::filesystem::path& folder) {
                GltfBuilder b = textured();
                damage(b);
                put(folder / kScene, b.glb());
            },
            check};
}
inline Slip patched(
    const char* name, const char* pointer, const json& value, const char* warning,
    const Check& check = [](const scene::Scene&) {}) {
    return damaged(
        name, warning, [=](GltfBuilder& b) { b.doc[json::json_pointer(pointer)] = value; }, check);
}

/// Loads the slip's file, which has one triangle whatever is wrong with it.
inline void expect_drawn_with_a_warning(const Slip& slip) {
    const TemporaryFolder folder;
    slip.write_files(folder.path());
    Diagnostics diagnostics;
    io::GltfOptions options;
    options.time_s = 0.5f;
    const scene::Scene s = io::load_gltf(folder / kScene, options, diagnostics);
    EXPECT_EQ(scene::triangle_count(s), 1u);
    const std::string no_animation = "the time has no effect: the scene has no animation";
    slip.check(s);
    std::string said;
    for (const Diagnostics::Warning& w : diagnostics.warnings())
        if (w.text != no_animation) said += w.text + "\n";
    const std::string expected = slip.warning;
    if (expected.empty()) {
        EXPECT_EQ(said, "");
    } else {
        EXPECT_NE(said.find(expected), std::string::npos) << said;
        EXPECT_NE(said.find(kScene), std::string::npos) << said;
    }
}

inline std::string name_of_slip(const testing::TestParamInfo<Slip>& info) {
    return info.param.name;
}

}  // namespace candela::test
