#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>

#include "candela/io/photometric_read.hpp"
#include "candela/io/scene_uri.hpp"
#include "candela/scene/error.hpp"

/// IES LM-63, revisions 1986 to 2019. Sources: ANSI/IESNA LM-63-02; I. Ashdown, "Parsing the IESNA LM-63
/// photometric data file", 1998, for the older ones.
namespace candela::io::detail {
namespace {

using scene::PhotometricProfile;
using scene::PhotometricType;

constexpr double kFoot_m = 0.3048;

struct Standard {
    int year;
    const char* name;
};
constexpr Standard kStandards[] = {{1986, "LM-63-1986"},
                                   {1991, "LM-63-1991"},
                                   {1995, "LM-63-1995"},
                                   {2002, "LM-63-2002"},
                                   {2019, "LM-63-2019"}};

/// The year of "IESNA91" and "IESNA:LM-63-1995", in two or four digits, or 0.
int year_of(std::string_view first_line) {
    constexpr std::string_view keyword = "LM-63-";
    const std::size_t at = first_line.find(keyword);
    if (at == std::string_view::npos && !first_line.starts_with("IESNA")) return 0;
    std::string_view rest = first_line.substr(at == std::string_view::npos ? 5 : at + keyword.size());
    int year = 0;
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), year);
    const auto digits = end - rest.data();
    if (error != std::errc{} || (digits != 2 && digits != 4)) return 0;
    if (digits == 4) return year;
    return year + (year < 86 ? 2000 : 1900);
}

/// The first line of a file of 1986 is any label.
std::string standard_of(std::string_view first_line, const std::string& where, Diagnostics& diagnostics) {
    if (!first_line.starts_with("IES")) return "LM-63-1986";
    const int year = year_of(first_line);
    const char* name = year == 0 ? "LM-63-2002" : kStandards[0].name;
    bool known = false;
    for (const Standard& s : kStandards) {
        if (year >= s.year) name = s.name;
        known = known || year == s.year;
    }
    if (!known) {
        diagnostics.warn(where + ": unknown revision " + std::string(first_line.substr(0, 40)) +
                         "; read as " + name);
    }
    return name;
}

std::string upper(std::string_view text) {
    std::string out(text);
    std::transform(out.begin(), out.end(), out.begin(), [](unsigned char c) { return std::toupper(c); });
    return out;
}

/// "[KEYWORD] value"; [MORE] goes on with the one before.
void add_keyword(std::string_view line, PhotometricProfile& profile) {
    const std::size_t end = line.find(']');
    if (!line.starts_with('[') || end == std::string_view::npos) {
        if (!line.empty() && profile.keywords.size() < 1000) profile.keywords.emplace_back("", line);
        return;
    }
    const std::string key = upper(line.substr(1, end - 1));
    const std::string value(trimmed(line.substr(end + 1)));
    if (key == "MORE" && !profile.keywords.empty()) {
        profile.keywords.back().second += "\n" + value;
    } else {
        profile.keywords.emplace_back(key, value);
    }
}

const std::string* keyword(const PhotometricProfile& profile, const char* key) {
    for (const auto& [name, value] : profile.keywords) {
        if (name == key) return &value;
    }
    return nullptr;
}

/// LM-63 separates numbers by blanks or commas. They are decimal commas where every comma stands between two
/// digits, at most one to a word, no number has a point, and only then as many numbers are there as the
/// header counts.
bool has_decimal_commas(const std::string& numbers, bool tilt_included) {
    std::vector<std::string> words;
    std::istringstream stream(numbers);
    for (std::string word; stream >> word;) words.push_back(word);
    const auto digit = [](const std::string& w, std::size_t i) {
        return i < w.size() && std::isdigit(static_cast<unsigned char>(w[i]));
    };
    bool commas = false;
    for (std::string& word : words) {
        const std::size_t comma = word.find(',');
        if (word.find('.') != std::string::npos) return false;
        if (comma == std::string::npos) continue;
        if (comma == 0 || !digit(word, comma - 1) || !digit(word, comma + 1)) return false;
        if (word.find(',', comma + 1) != std::string::npos) return false;
        word[comma] = '.';
        commas = true;
    }
    const auto count = [&](std::size_t at) -> std::size_t {
        const auto value = at < words.size() ? parsed_number(words[at]) : std::nullopt;
        return value && *value >= 1.0 && *value < 1e6 && *value == std::floor(*value) ? std::size_t(*value)
                                                                                      : 0;
    };
    std::size_t at = 0;
    if (tilt_included) at = 2 + 2 * count(1);
    const std::size_t vertical = count(at + 3), horizontal = count(at + 4);
    constexpr std::size_t header = 13;
    return commas && vertical > 0 && horizontal > 0 &&
           words.size() >= at + header + vertical + horizontal + vertical * horizontal;
}

/// Reads up to TILT= and returns what follows it.
std::string_view read_labels(PhotometricText& text, PhotometricProfile& profile, Diagnostics& diagnostics) {
    bool first = true;
    while (true) {
        const std::string_view line = text.line("the line TILT=");
        if (const auto tilt = behind_tilt(line)) {
            if (!line.starts_with("TILT="))
                diagnostics.warn(text.place() + ": a TILT line that is not written TILT=: read as one");
            return *tilt;
        }
        if (first) profile.standard = standard_of(line, text.where(), diagnostics);
        if (!first || profile.standard == "LM-63-1986") add_keyword(line, profile);
        first = false;
    }
}

scene::PhotometricTilt read_tilt_table(PhotometricText& text) {
    constexpr std::size_t most = 1000;
    scene::PhotometricTilt out;
    out.lamp_to_luminaire_geometry = int(text.count("the lamp-to-luminaire geometry", 1, 3));
    const std::size_t count = text.count("the number of tilt angles", 1, most);
    out.angles_deg = read_angles(text, count, "tilt angle", [&] { return text.number("a tilt angle"); });
    for (std::size_t i = 0; i < count; ++i) {
        out.factors.push_back(text.number("a tilt factor"));
        if (!(out.factors.back() >= 0.0)) throw text.error("a tilt factor is negative");
    }
    return out;
}

void read_tilt(PhotometricText& text, std::string_view name, const std::filesystem::path& folder,
               Diagnostics& diagnostics, PhotometricProfile& profile) {
    const std::string word = upper(name);
    if (word == "NONE") return;
    if (word == "INCLUDE") {
        profile.tilt = read_tilt_table(text);
        return;
    }
    if (name.empty()) throw text.error("nothing after TILT=", "NONE, INCLUDE or a file name");
    if (folder.empty()) {
        diagnostics.warn(text.where() +
                         ": TILT names a file, which an embedded profile has none of; not read");
        return;
    }
    PlacedWarnings warnings;
    const std::filesystem::path file = file_of_scene_uri(folder, std::string(name), text.place(), warnings);
    warnings.raise(diagnostics);
    try {
        PhotometricText tilt(read_photometric_text(file), file.string());
        profile.tilt = read_tilt_table(tilt);
    } catch (const Error& error) {
        // The table is about other positions than the one that was measured: the intensities stay.
        if (error.fault() != Fault::input) throw;
        diagnostics.warn(error.where() + ": " + error.what() + ": drawn without the TILT file");
    }
}

double read_positive(PhotometricText& text, const char* what) {
    const double value = text.number(what);
    if (!(value > 0.0) || value > 1e9) throw text.error(std::string(what) + " must be positive");
    return value;
}

struct Counts {
    std::size_t vertical;
    std::size_t horizontal;
};

/// LM-63: width is across C0-C180, length along it. Negative sizes are round; the older revisions give a
/// diameter as a negative width alone.
void set_opening(double width, double length, double height, double unit_m, PhotometricProfile& profile) {
    profile.round = width < 0.0 || length < 0.0;
    const bool one_diameter = profile.round && (width == 0.0 || length == 0.0);
    const double across = std::abs(one_diameter ? std::min(width, length) : width);
    const double along = std::abs(one_diameter ? std::min(width, length) : length);
    profile.opening_m = glm::dvec3(along, across, std::abs(height)) * unit_m;
}

Counts read_header(PhotometricText& text, Diagnostics& diagnostics, PhotometricProfile& profile) {
    scene::PhotometricLamps lamps;
    lamps.count = int(text.count("the number of lamps", 0, 100000));
    const double lumens = text.number("the lumens per lamp");
    profile.absolute = lumens < 0.0;
    if (!profile.absolute) lamps.flux_lm = lumens * std::max(lamps.count, 1);
    profile.multiplier = read_positive(text, "the candela multiplier");
    Counts out{};
    out.vertical = text.count("the number of vertical angles", 1, kMostAngles);
    out.horizontal = text.count("the number of horizontal angles", 1, kMostAngles);
    constexpr PhotometricType types[] = {PhotometricType::c, PhotometricType::b, PhotometricType::a};
    profile.type = types[text.count("the photometric type", 1, 3) - 1];
    const double unit_m = text.count("the unit of length", 1, 2) == 1 ? kFoot_m : 1.0;
    const double width = text.number("the width"), length = text.number("the length");
    set_opening(width, length, text.number("the height"), unit_m, profile);
    profile.ballast_factor = read_positive(text, "the ballast factor");
    // A factor until 1995, reserved in 2002, since 2019 a code for how the file came to be.
    const double factor = text.number("the ballast-lamp photometric factor");
    const bool is_factor = profile.standard < std::string("LM-63-2002");
    if (is_factor && !(factor > 0.0))
        throw text.error("the ballast-lamp photometric factor must be positive");
    if (is_factor) profile.ballast_lamp_factor = factor;
    if (profile.standard == "LM-63-2002" && factor != 1.0)
        diagnostics.warn(text.where() + ": a reserved number of LM-63-2002 is not 1; not used");
    const double watts = text.number("the input watts");
    if (watts > 0.0) lamps.power_w = watts;
    profile.lamp_sets = {lamps};
    return out;
}

FileWeb read_web(PhotometricText& text, const Counts& counts, Diagnostics& diagnostics,
                 const PhotometricProfile& profile) {
    const std::size_t nodes = counts.vertical * counts.horizontal;
    // A number and what separates it from the next are two bytes at least.
    if (nodes > kMostNodes || counts.vertical + counts.horizontal + nodes > text.bytes_left() / 2 + 1)
        throw text.error("the file is too short for " + std::to_string(counts.vertical) + " x " +
                         std::to_string(counts.horizontal) + " intensities");
    FileWeb web;
    web.vertical_deg =
        read_angles(text, counts.vertical, "vertical angle", [&] { return text.number("a vertical angle"); });
    web.horizontal_deg = read_angles(text, counts.horizontal, "horizontal angle",
                                     [&] { return text.number("a horizontal angle"); });
    web.where = text.place();
    const double scale = profile.multiplier * profile.ballast_factor * profile.ballast_lamp_factor;
    bool negative = false;
    web.candela.reserve(nodes);
    for (std::size_t i = 0; i < nodes; ++i)
        web.candela.push_back(checked_intensity(text, scale * text.number("an intensity"), negative));
    if (negative) diagnostics.warn(text.where() + ": negative intensities became 0");
    if (text.words_left()) diagnostics.warn(text.where() + ": more numbers than the header counts; ignored");
    return web;
}

void describe(PhotometricProfile& profile) {
    for (const char* key : {"LUMINAIRE", "LUMCAT", "TEST"}) {
        const std::string* value = keyword(profile, key);
        if (value && !value->empty()) {
            profile.name = value->substr(0, value->find('\n'));
            break;
        }
    }
    scene::PhotometricLamps& lamps = profile.lamp_sets.front();
    if (const std::string* lamp = keyword(profile, "LAMP")) lamps.type = *lamp;
    for (const auto& [key, value] : profile.keywords) {
        const bool about_color =
            key.find("CCT") != std::string::npos || key.find("COLORTEMP") != std::string::npos ||
            key.find("COLOR_TEMP") != std::string::npos || key.find("COLOR TEMP") != std::string::npos;
        if (about_color && !lamps.temperature_kelvin)
            lamps.temperature_kelvin = colour_temperature(value, false);
    }
    for (const char* key : {"LAMP", "LAMPCAT", "LUMINAIRE", "LUMCAT"}) {
        const std::string* value = keyword(profile, key);
        // Only a number that says Kelvin: others in these lines are catalogue numbers and watts.
        if (value && !lamps.temperature_kelvin && value->find_first_of("kK") != std::string::npos) {
            const auto found = colour_temperature(*value, false);
            if (found) lamps.temperature_kelvin = found;
        }
    }
}

}  // namespace

std::optional<std::string_view> behind_tilt(std::string_view line) {
    constexpr std::string_view tilt = "TILT";
    if (upper(line.substr(0, tilt.size())) != tilt) return std::nullopt;
    line = trimmed(line.substr(tilt.size()));
    if (!line.starts_with('=')) return std::nullopt;
    return trimmed(line.substr(1));
}

PhotometricProfile read_ies(PhotometricText& text, const std::filesystem::path& folder,
                            Diagnostics& diagnostics) {
    PhotometricProfile profile;
    profile.format = scene::PhotometricFormat::ies;
    const std::string_view tilt = read_labels(text, profile, diagnostics);
    if (has_decimal_commas(text.rest(), upper(tilt) == "INCLUDE")) {
        text.read_decimal_commas();
        diagnostics.warn(text.where() + ": numbers with a decimal comma: read as a decimal point");
    }
    read_tilt(text, tilt, folder, diagnostics, profile);
    const Counts counts = read_header(text, diagnostics, profile);
    const FileWeb web = read_web(text, counts, diagnostics, profile);
    if (profile.type == PhotometricType::c) {
        expand_type_c(web, diagnostics, profile);
    } else {
        convert_type_a_or_b(web, diagnostics, profile);
    }
    describe(profile);
    return profile;
}

}  // namespace candela::io::detail
