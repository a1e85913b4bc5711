#include "bake_lobes.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "candela/bake/layer_fit.hpp"
#include "candela/bake/lobe_fit.hpp"
#include "candela/io/image_write_safe.hpp"
#include "candela/version.hpp"
#include "progress_line.hpp"

namespace candela::app {
namespace {

/// As many digits as shading/stretched_reflection.glsl has.
double rounded(double value) {
    return std::round(1.0e4 * value) / 1.0e4;
}

std::string name_of(std::size_t row, std::size_t reads) {
    const std::string letter(1, char('a' + int(row < 2 * reads ? row / 2 : row - 2 * reads)));
    if (row >= 2 * reads) return "weight_" + letter;
    return (row % 2 == 0 ? "tilt_" : "width_") + letter;
}

nlohmann::json fit_of(int reads) {
    const bake::LobeFit fit = bake::fit_lobe_reads(reads);
    nlohmann::json polynomials = nlohmann::json::object();
    for (std::size_t row = 0; row < fit.coefficients.size(); ++row) {
        nlohmann::json& numbers = polynomials[name_of(row, std::size_t(reads))];
        for (const double c : fit.coefficients[row]) numbers.push_back(rounded(c));
    }
    return {{"reads", reads},
            {"mean_error", rounded(fit.errors.mean)},
            {"largest_error", rounded(fit.errors.largest)},
            {"committed_mean_error", rounded(bake::committed_lobe_errors(reads).mean)},
            {"polynomials", polynomials}};
}

void print(const nlohmann::json& fit) {
    std::printf("reads %d: error %.4f on average, %.4f at most; %.4f with the constants in shading/\n",
                fit["reads"].get<int>(), fit["mean_error"].get<double>(), fit["largest_error"].get<double>(),
                fit["committed_mean_error"].get<double>());
    for (const auto& [name, c] : fit["polynomials"].items()) {
        std::printf("  %s:", name.c_str());
        for (std::size_t i = 0; i < c.size(); i += 4)
            std::printf(" vec4(%.4ff, %.4ff, %.4ff, %.4ff)", c[i].get<double>(), c[i + 1].get<double>(),
                        c[i + 2].get<double>(), c[i + 3].get<double>());
        std::printf("\n");
    }
}

nlohmann::json layer_of(const bake::LayerFit& fit) {
    nlohmann::json constants = nlohmann::json::array();
    for (const bake::FittedConstant& c : fit.constants)
        constants.push_back(
            {{"name", c.name}, {"committed", rounded(c.committed)}, {"found", rounded(c.found)}});
    return {{"layer", fit.name},
            {"views", fit.views},
            {"mean_error", rounded(fit.found.mean)},
            {"largest_error", rounded(fit.found.largest)},
            {"committed_mean_error", rounded(fit.committed.mean)},
            {"committed_largest_error", rounded(fit.committed.largest)},
            {"usual_mean_error", rounded(fit.instead.mean)},
            {"constants", constants}};
}

void print_layer(const nlohmann::json& fit) {
    std::printf(
        "%s: error %.4f on average, %.4f at most; %.4f and %.4f with the constants in shading/; %.4f by "
        "the usual read\n",
        fit["layer"].get<std::string>().c_str(), fit["mean_error"].get<double>(),
        fit["largest_error"].get<double>(), fit["committed_mean_error"].get<double>(),
        fit["committed_largest_error"].get<double>(), fit["usual_mean_error"].get<double>());
    std::printf("  %-26s %10s %10s\n", "constant", "shading/", "found");
    for (const nlohmann::json& c : fit["constants"])
        std::printf("  %-26s %10.4f %10.4f\n", c["name"].get<std::string>().c_str(),
                    c["committed"].get<double>(), c["found"].get<double>());
}

}  // namespace

int bake_lobes(const std::string& output, bool json) {
    std::unique_ptr<io::detail::SafeFile> file;
    if (!output.empty()) file = std::make_unique<io::detail::SafeFile>(output);
    nlohmann::json all{
        {"table", "reads of prefiltered environments along the lobe"},
        {"written_by", std::string("candela ") + version()},
        {"lobe",
         "D V F cos of GGX with height-correlated Smith and Schlick's Fresnel, f0 1 and 0.04, over its "
         "albedo"},
        {"read", "the lobe of n = v = r, weighted by n.l (Frostbite equation 53)"},
        {"views", "perceptual roughness 0.1 to 1 in tenths, 16 angles from 2.8 to 87.2 degrees"},
        {"error", "see bake/lobe_fit.hpp"},
        {"terms", {"1", "z", "c", "r", "z z", "c z", "r z", "r c", "s", "s z", "s c", "s r"}},
        {"fits", nlohmann::json::array()},
        {"layers", nlohmann::json::array()}};
    for (int reads = 1; reads <= 3; ++reads) {
        {
            const ProgressLine line("fitting reads along the lobe, " + std::to_string(reads) + " of 3");
            all["fits"].push_back(fit_of(reads));
        }
        if (!json) print(all["fits"].back());
    }
    const auto layers = [] {
        const ProgressLine line("fitting reads of layers");
        return std::array{bake::fit_anisotropic_reads(), bake::fit_sheen_read()};
    }();
    for (const bake::LayerFit& fit : layers) {
        all["layers"].push_back(layer_of(fit));
        if (!json) print_layer(all["layers"].back());
    }
    const std::string text = all.dump(2) + "\n";
    if (json) std::printf("%s", text.c_str());
    if (file) {
        (void)file->write(text.data(), text.size());
        file->commit();
        if (!json) print_written(output);
    }
    return 0;
}

}  // namespace candela::app
