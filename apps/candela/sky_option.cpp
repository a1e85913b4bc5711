#include "sky_option.hpp"

#include <charconv>
#include <set>
#include <sstream>
#include <vector>

#include "candela/io/json_reader.hpp"
#include "candela/scene/error.hpp"

namespace candela::app {
namespace {

constexpr const char* kWhere = "--env sky";

Error usage(const std::string& what, const std::string& hint) {
    return {Fault::usage, what, kWhere, hint};
}

const scene::SkySetting& setting_named(const std::string& name) {
    std::vector<std::string> known;
    std::string all;
    for (const scene::SkySetting& s : scene::kSkySettings) {
        if (name == s.option) return s;
        known.emplace_back(s.option);
        all += (all.empty() ? "" : ", ") + known.back();
    }
    const std::string near = io::nearest_name(name, known);
    throw usage("unknown key: " + name, near.empty() ? "it has " + all : "did you mean " + near + "?");
}

float value_of(const scene::SkySetting& setting, const std::string& text) {
    double value = 0.0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc{} || stop != end)
        throw usage("not a number: " + std::string(setting.option) + "=" + text, setting.range);
    if (!(value >= setting.low && value <= setting.high))
        throw usage("out of range: " + std::string(setting.option) + "=" + text, setting.range);
    return static_cast<float>(value);
}

}  // namespace

std::optional<scene::SkySettings> sky_of_option(const std::string& text) {
    if (text == "sky") return scene::SkySettings{};
    if (!text.starts_with("sky:")) return std::nullopt;
    if (text == "sky:") throw usage("names no key", "sky, or sky:elevation=35,turbidity=3");
    scene::SkySettings settings;
    std::istringstream parts(text.substr(4));
    std::set<std::string> seen;
    std::string part;
    while (std::getline(parts, part, ',')) {
        const std::size_t equals = part.find('=');
        if (equals == std::string::npos)
            throw usage("not key=value: " + part, "sky:elevation=35,turbidity=3");
        const scene::SkySetting& setting = setting_named(part.substr(0, equals));
        if (!seen.insert(setting.option).second)
            throw usage("the key is given twice: " + std::string(setting.option), "each key once");
        settings.*setting.value = value_of(setting, part.substr(equals + 1));
    }
    return settings;
}

}  // namespace candela::app
