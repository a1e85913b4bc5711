#include "candela/io/exr_layers.hpp"

#include <ImfChannelList.h>
#include <ImfHeader.h>
#include <ImfPartType.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>

#include "candela/scene/error.hpp"

namespace candela::io::detail {
namespace {

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

/// Full names of a layer's channels, by what each is in lower case: "r", "g", "b", "y", "ry", "by", ...
using Layer = std::map<std::string, std::string>;

std::string meaning(const std::string& channel) {
    const std::string name = lower(channel);
    if (name == "red") return "r";
    if (name == "green") return "g";
    if (name == "blue") return "b";
    if (name == "l" || name == "luminance" || name == "grey" || name == "gray") return "y";
    return name;
}

bool has(const Layer& layer, std::initializer_list<const char*> names) {
    return std::all_of(names.begin(), names.end(), [&](const char* n) { return layer.contains(n); });
}

/// Nothing for what is no picture: a depth, a normal's X, Y and Z.
bool picture_of(const Layer& layer, ExrPicture& out) {
    const auto take = [&](ExrColors colors, std::initializer_list<const char*> names) {
        out.colors = colors;
        for (const char* name : names) out.channels.push_back(layer.at(name));
        return true;
    };
    if (has(layer, {"r", "g", "b"})) return take(ExrColors::rgb, {"r", "g", "b"});
    if (has(layer, {"y", "ry", "by"})) return take(ExrColors::luminance_chroma, {"y", "ry", "by"});
    const bool vector = layer.contains("x") || layer.contains("z") || layer.contains("u");
    if (layer.contains("y") && !vector) return take(ExrColors::grey, {"y"});
    if (layer.contains("v") && !vector) return take(ExrColors::grey, {"v"});
    return false;
}

std::vector<std::string> components(const std::string& name) {
    std::vector<std::string> out{""};
    for (const char c : lower(name)) {
        if (c == '.' || c == '/')
            out.emplace_back();
        else
            out.back() += c;
    }
    return out;
}

/// The lower, the more likely the finished picture.
int rank_of(const ExrPicture& picture) {
    constexpr std::array finished{"combined", "composite", "beauty", "rgba",   "rgb",  "color",
                                  "colour",   "default",   "final",  "master", "main", "image"};
    if (picture.name.empty()) return 0;
    for (const std::string& part : components(picture.name)) {
        if (std::find(finished.begin(), finished.end(), part) != finished.end()) return 0;
    }
    return picture.colors == ExrColors::grey ? 2 : 1;
}

std::string joined(const std::vector<std::string>& names) {
    constexpr std::size_t most = 12;
    std::string out;
    for (std::size_t i = 0; i < std::min(names.size(), most); ++i) out += (i > 0 ? ", " : "") + names[i];
    return names.size() > most ? out + " and " + std::to_string(names.size() - most) + " more" : out;
}

std::string shown(const ExrPicture& picture) {
    return picture.name.empty() ? "(no layer)" : picture.name;
}

std::vector<std::string> all_channels(const Imf::MultiPartInputFile& input) {
    std::vector<std::string> names;
    for (int part = 0; part < input.parts(); ++part) {
        const Imf::ChannelList& channels = input.header(part).channels();
        for (auto c = channels.begin(); c != channels.end(); ++c) names.emplace_back(c.name());
    }
    return names;
}

bool is_flat(const Imf::Header& header) {
    return !header.hasType() || !Imf::isDeepData(header.type());
}

}  // namespace

std::vector<ExrPicture> exr_pictures(const Imf::MultiPartInputFile& input) {
    std::vector<ExrPicture> out;
    for (int part = 0; part < input.parts(); ++part) {
        const Imf::Header& header = input.header(part);
        if (!is_flat(header)) continue;
        std::map<std::string, Layer> layers;
        const Imf::ChannelList& channels = header.channels();
        for (auto c = channels.begin(); c != channels.end(); ++c) {
            const std::string name = c.name();
            const std::size_t dot = name.rfind('.');
            const std::string layer = dot == std::string::npos ? "" : name.substr(0, dot);
            layers[layer].try_emplace(meaning(dot == std::string::npos ? name : name.substr(dot + 1)), name);
        }
        // The name of a file's only part says nothing that its layers do not.
        const std::string part_name = input.parts() > 1 && header.hasName() ? header.name() : "";
        for (const auto& [layer, names] : layers) {
            ExrPicture picture;
            picture.part = part;
            picture.name = part_name.empty()                     ? layer
                           : layer.empty() || layer == part_name ? part_name
                                                                 : part_name + "." + layer;
            if (picture_of(names, picture)) out.push_back(std::move(picture));
        }
    }
    return out;
}

ExrPicture choose_exr_picture(const Imf::MultiPartInputFile& input, const std::string& asked,
                              const std::string& where, Diagnostics& diagnostics) {
    const std::vector<ExrPicture> pictures = exr_pictures(input);
    std::vector<std::string> names;
    for (const ExrPicture& picture : pictures) names.push_back(shown(picture));
    if (pictures.empty()) {
        bool flat = false;
        for (int part = 0; part < input.parts(); ++part) flat = flat || is_flat(input.header(part));
        if (!flat) throw input_error("deep EXR is not read", where);
        throw input_error("has neither R, G, B nor Y", where,
                          "its channels are " + joined(all_channels(input)));
    }
    if (!asked.empty()) {
        for (const ExrPicture& picture : pictures) {
            if (picture.name == asked) return picture;
        }
        throw input_error("has no layer or part " + asked + " with a picture", where,
                          "it has " + joined(names));
    }
    const auto ranked = [](const ExrPicture& a, const ExrPicture& b) { return rank_of(a) < rank_of(b); };
    const ExrPicture& best = *std::min_element(pictures.begin(), pictures.end(), ranked);
    const auto as_good = std::count_if(pictures.begin(), pictures.end(),
                                       [&](const ExrPicture& p) { return rank_of(p) == rank_of(best); });
    if (as_good > 1)
        diagnostics.warn(where + ": several pictures, " + joined(names) + ": " + shown(best) +
                         " is read (--env-layer NAME)");
    return best;
}

}  // namespace candela::io::detail
