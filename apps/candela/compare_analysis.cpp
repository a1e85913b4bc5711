#include "compare_analysis.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "candela/measure/verdict.hpp"
#include "progress_line.hpp"
#include "shading/language.glsl"

namespace candela::app {
namespace {

std::optional<double> brightness_ratio(const measure::Picture& x, const measure::Picture& r,
                                       const measure::Mask& mask) {
    double sum_x = 0.0;
    double sum_r = 0.0;
    for (std::size_t i = 0; i < x.pixels.size(); ++i) {
        if (!mask.empty() && mask[i] == 0) continue;
        sum_x += double(shading::luminance(x.pixels[i]));
        sum_r += double(shading::luminance(r.pixels[i]));
    }
    if (!(sum_r > 0.0)) return std::nullopt;
    return sum_x / sum_r;
}

}  // namespace

Analysis analyse(const std::vector<NamedPicture>& pictures, std::size_t reference_index,
                 const measure::ComparisonOptions& options,
                 const std::vector<measure::Comparison>& comparisons) {
    const NamedPicture& reference = pictures[reference_index];
    const bool luminance = options.meaning == measure::PixelMeaning::luminance;
    Analysis out;
    if (reference.noise_sample) {
        ProgressLine line("measuring the noise of " + reference.name);
        measure::ComparisonOptions how = options;
        how.progress = line.function();
        out.noise = measure::compare(*reference.noise_sample, reference.picture, how).metrics;
    }
    out.paths.resize(pictures.size());
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const NamedPicture& p = pictures[i];
        out.verdicts.emplace_back();
        if (i == reference_index) continue;
        if (p.paths && reference.paths) out.paths[i] = measure::split_error(*p.paths, *reference.paths);
        out.verdicts[i] = measure::verdict(
            {p.name, reference.name, comparisons[i].metrics, out.noise,
             luminance ? brightness_ratio(p.picture, reference.picture, comparisons[i].mask) : std::nullopt,
             out.paths[i]});
    }
    return out;
}

nlohmann::json paths_json(const std::vector<measure::PathError>& paths) {
    auto out = nlohmann::json::array();
    for (const measure::PathError& row : paths)
        out.push_back({{"path", row.path},
                       {"reference_mean_nit", row.reference_mean_nit},
                       {"mean_nit", row.picture_mean_nit},
                       {"mean_absolute_difference_nit", row.mean_absolute_nit},
                       {"share", row.share}});
    return out;
}

std::string command_line() {
    std::ifstream stream("/proc/self/cmdline", std::ios::binary);
    std::string out;
    for (std::string word; std::getline(stream, word, '\0');) {
        if (out.empty()) word = "candela";
        const bool plain =
            !word.empty() && word.find_first_of(" \t\n\"'\\$`*?;&|<>(){}#!~") == std::string::npos;
        std::string quoted;
        for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
        out += (out.empty() ? "" : " ") + (plain ? word : "'" + quoted + "'");
    }
    return out;
}

}  // namespace candela::app
