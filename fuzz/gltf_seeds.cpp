#include <filesystem>
#include <fstream>

#include "gltf/gltf_lights.hpp"
#include "gltf/gltf_samples.hpp"

using namespace candela::test;

namespace {

void write(const std::filesystem::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
}

}  // namespace

/// Writes one small scene a feature into the folder: where the fuzzer starts.
int main(int argc, char** argv) {
    if (argc != 2) return 2;
    const std::filesystem::path folder = argv[1];
    std::filesystem::create_directories(folder);
    GltfBuilder moving = morphed();
    animate(moving, "rotation", "LINEAR", {0, 1}, {0, 0, 0, 1, 0, 1, 0, 0}, "VEC4", 4);
    animate(moving, "translation", "CUBICSPLINE", {0, 1}, std::vector<float>(18, 0.5f), "VEC3", 3);
    animate(moving, "weights", "STEP", {0, 1}, {0, 1, 1, 0}, "SCALAR", 1);
    GltfBuilder lit = triangle();
    lit.doc["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"}, {"intensity", 5}, {"spot", {{"outerConeAngle", 0.5}}}}};
    lit.doc["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    lit.push("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}});
    lit.doc["nodes"][0]["camera"] = 0;
    GltfBuilder webp = with_material({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    add_texture(webp, webp_of_four_texels());
    const std::pair<const char*, GltfBuilder> seeds[] = {
        {"triangle", triangle()},
        {"material", everything_in_a_material()},
        {"skin", skinned()},
        {"moving", moving},
        {"lit", lit},
        {"draco", draco_strip(2)},
        {"meshopt", meshopt_triangle()},
        {"webp", webp},
        {"area", lit_by("EXT_lights_area", {{"type", "rect"}})},
        {"profile", lit_by_profile(small_ies())}};
    for (const auto& [name, builder] : seeds) write(folder / (std::string(name) + ".glb"), builder.glb());
    write(
        folder / "text.gltf",
        R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,)"
        R"(AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],"bufferViews":[{"buffer":0,"byteLength":36}],)"
        R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],)"
        R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}]})");
    return 0;
}
