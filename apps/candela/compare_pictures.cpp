#include "compare_pictures.hpp"

#include <cmath>
#include <cstdio>
#include <set>
#include <sstream>

#include "candela/io/file_kind.hpp"
#include "candela/io/image_read.hpp"
#include "candela/io/luminance_read.hpp"
#include "candela/scene/error.hpp"

namespace candela::app {
namespace {

constexpr std::size_t max_picture_bytes = std::size_t{1} << 30;

/// Settings without the prefix that tells our attributes from others'.
Settings settings_of(const std::string& file, const std::map<std::string, io::ExrAttribute>& attributes) {
    Settings out{{"file", file}};
    const std::string prefix = "candela/";
    static const std::set<std::string> of_the_format{"pixelAspectRatio", "screenWindowWidth", "type",
                                                     "whiteLuminance"};
    for (const auto& [name, value] : attributes) {
        if (of_the_format.contains(name)) continue;
        const std::string key = name.starts_with(prefix) ? name.substr(prefix.size()) : name;
        const float* number = std::get_if<float>(&value);
        add_setting(out, key, number != nullptr ? text_of(*number) : std::get<std::string>(value));
    }
    return out;
}

NamedPicture load_luminance(const std::string& file, Diagnostics& diagnostics) {
    io::LuminanceImage image = io::read_luminance(file, diagnostics);
    NamedPicture out;
    out.name = std::filesystem::path(file).stem().string();
    out.picture = {image.width, image.height, std::move(image.luminance_nit)};
    out.settings = settings_of(file, image.attributes);
    if (const auto found = image.attributes.find("candela/exposure"); found != image.attributes.end()) {
        const float* exposure = std::get_if<float>(&found->second);
        if (exposure != nullptr && *exposure > 0.0f && std::isfinite(*exposure)) out.exposure = *exposure;
    }
    if (const auto found = image.attributes.find("candela/ev100"); found != image.attributes.end()) {
        const float* ev100 = std::get_if<float>(&found->second);
        if (ev100 != nullptr && std::isfinite(*ev100)) out.ev100 = *ev100;
    }
    return out;
}

NamedPicture load_display(const std::string& file, Diagnostics& diagnostics) {
    const std::vector<std::byte> bytes = io::read_file(file, max_picture_bytes);
    if (!bytes.empty() && !io::is_display_picture(bytes))
        throw input_error(
            io::not_a("an OpenEXR, Radiance .hdr, PNG, JPEG or WebP picture", io::kind_of_file(bytes, file)),
            file);
    const scene::Image image = io::decode_image(bytes, file);
    NamedPicture out;
    out.name = std::filesystem::path(file).stem().string();
    out.meaning = measure::PixelMeaning::display;
    out.settings = settings_of(file, {});
    out.picture = {image.width, image.height,
                   std::vector<glm::vec3>(std::size_t{image.width} * image.height)};
    bool transparent = false;
    for (std::size_t i = 0; i < out.picture.pixels.size(); ++i) {
        for (std::size_t c = 0; c < 3; ++c)
            out.picture.pixels[i][int(c)] = static_cast<float>(image.rgba[4 * i + c]) / 255.0f;
        transparent = transparent || image.rgba[4 * i + 3] != 255;
    }
    if (transparent) diagnostics.warn(file + ": its alpha is left out; colours are compared as stored");
    return out;
}

}  // namespace

std::string text_of(float value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", static_cast<double>(value));
    return text;
}

void add_setting(Settings& settings, const std::string& key, const std::string& value) {
    if (key != "techniques") {
        settings.emplace_back(key, value);
        return;
    }
    std::istringstream words(value);
    for (std::string word; words >> word;) {
        const std::size_t equals = word.find('=');
        if (equals != std::string::npos)
            settings.emplace_back(word.substr(0, equals), word.substr(equals + 1));
    }
}

NamedPicture load_picture(const std::string& file, Diagnostics& diagnostics) {
    return io::is_luminance_file(file) ? load_luminance(file, diagnostics) : load_display(file, diagnostics);
}

}  // namespace candela::app
