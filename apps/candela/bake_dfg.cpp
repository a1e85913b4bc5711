#include "bake_dfg.hpp"

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "candela/bake/dfg_bake.hpp"
#include "candela/io/image_write.hpp"
#include "candela/io/output_folder.hpp"
#include "candela/scene/error.hpp"
#include "candela/version.hpp"
#include "progress_line.hpp"

namespace candela::app {
namespace {

/// Points behind a texel: what a table of 128 is off by is then the table's own.
constexpr std::uint32_t kSamples = 1024;

bake::DfgVisibility visibility_of(const std::string& name) {
    if (name == "correlated") return bake::DfgVisibility::smith_correlated;
    if (name == "uncorrelated") return bake::DfgVisibility::smith_uncorrelated;
    if (name == "schlick") return bake::DfgVisibility::schlick_smith;
    throw Error(Fault::usage, "there is no visibility '" + name + "'", "--visibility",
                "correlated, uncorrelated or schlick");
}

nlohmann::json metadata(const std::string& visibility, std::uint32_t size) {
    return {
        {"table", "directional albedos"},
        {"written_by", std::string("candela ") + version()},
        {"visibility", visibility},
        {"size", size},
        {"columns", "NoV = (x / (size - 1))^2"},
        {"rows", "perceptual roughness = y / (size - 1), row 0 on top; alpha is its square, at least 0.002"},
        {"f0_scale", "GGX with Schlick's Fresnel: albedo = f0 f0_scale + f90 f90_bias"},
        {"f90_bias", "see f0_scale; a clear coat's albedo is the same with f0 0.04 and the coat's roughness"},
        {"diffuse", visibility == "schlick" ? "Lambert: 1" : "Disney's diffuse as Frostbite renormalizes it"},
        {"sheen", "white Charlie sheen"},
        {"energy_compensation",
         "multiply the lobe by 1 + f0 (1 / (f0_scale + f90_bias) - 1): shading/energy.glsl"}};
}

}  // namespace

int bake_dfg_table(const std::string& output, const std::string& visibility, std::uint32_t size, bool json) {
    const std::filesystem::path file = output.empty() ? "dfg_table.exr" : output;
    if (file.extension() != ".exr")
        throw Error(Fault::usage, "this table is written as EXR", file.string(), "-o dfg_table.exr");
    io::check_output_file(file);
    const bake::DfgTable table = [&] {
        ProgressLine line("computing directional albedos");
        return bake::bake_dfg(visibility_of(visibility), size, kSamples, line.function());
    }();
    std::vector<std::vector<float>> planes(4, std::vector<float>(table.texels.size()));
    for (std::size_t i = 0; i < table.texels.size(); ++i) {
        for (int c = 0; c < 4; ++c) planes[static_cast<std::size_t>(c)][i] = table.texels[i][c];
    }
    std::vector<io::ExrChannel> channels;
    const char* names[] = {"R", "G", "B", "A"};
    for (std::size_t c = 0; c < 4; ++c)
        channels.push_back({names[c], io::PixelType::half, std::span<const float>(planes[c])});
    nlohmann::json about = metadata(visibility, size);
    io::write_exr(file, size, size, channels, {{"candela/table", about.dump()}});
    about["channels"] = {{"R", "f0_scale"}, {"G", "f90_bias"}, {"B", "diffuse"}, {"A", "sheen"}};
    const std::string text = about.dump(2) + "\n";
    io::write_file(std::filesystem::path(file).replace_extension(".json"), std::as_bytes(std::span(text)));
    about["file"] = file.string();
    if (json)
        std::printf("%s\n", about.dump(2).c_str());
    else
        std::printf("%s: %u x %u, %s\n", file.c_str(), size, size, visibility.c_str());
    if (!json) print_written(file);
    return 0;
}

}  // namespace candela::app
