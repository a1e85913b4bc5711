#include <algorithm>
#include <cmath>

#include "candela/io/photometric_read.hpp"

/// EULUMDAT. Source: A. Stockmar, "EULUMDAT - ein Leuchtendatenformat fuer den europaeischen
/// Beleuchtungsplaner", Licht 1990, one value a line; and "EULUMDAT/2", CIBSE National Lighting Conference
/// 1998.
namespace candela::io::detail {
namespace {

using scene::PhotometricProfile;

/// The number of one line; some writers put a decimal comma.
double line_number(PhotometricText& text, const char* what) {
    std::string line(text.line(what));
    std::replace(line.begin(), line.end(), ',', '.');
    const std::optional<double> value = parsed_number(line);
    if (!value) throw text.error(std::string("no number for ") + what + ": \"" + line.substr(0, 40) + '"');
    return *value;
}

/// Empty lines count as 0, as writers leave what they do not know.
double optional_number(PhotometricText& text, const char* what) {
    if (text.at_end() || !text.peek().empty()) return line_number(text, what);
    (void)text.line(what);
    return 0.0;
}

std::size_t line_count(PhotometricText& text, const char* what, std::size_t least, std::size_t most) {
    const double value = line_number(text, what);
    if (value != std::floor(value) || value < double(least) || value > double(most))
        throw text.error(std::string(what) + " must be a whole number from " + std::to_string(least) +
                         " to " + std::to_string(most));
    return std::size_t(value);
}

struct Header {
    std::size_t symmetry = 0;
    std::size_t planes = 0;
    double plane_step_deg = 0.0;
    std::size_t gammas = 0;
    double gamma_step_deg = 0.0;
};

void read_text_line(PhotometricText& text, const char* key, const char* what, PhotometricProfile& profile) {
    const std::string_view line = text.line(what);
    if (!line.empty()) profile.keywords.emplace_back(key, line);
}

Header read_header(PhotometricText& text, PhotometricProfile& profile) {
    Header out;
    read_text_line(text, "COMPANY", "the company", profile);
    (void)optional_number(text, "the type indicator");
    out.symmetry = line_count(text, "the symmetry indicator", 0, 4);
    out.planes = line_count(text, "the number of C-planes", 1, kMostAngles);
    out.plane_step_deg = optional_number(text, "the distance of C-planes");
    out.gammas = line_count(text, "the number of intensities in a C-plane", 2, kMostAngles);
    out.gamma_step_deg = optional_number(text, "the distance of intensities");
    read_text_line(text, "REPORT", "the measurement report", profile);
    profile.name = text.line("the luminaire's name");
    read_text_line(text, "NUMBER", "the luminaire's number", profile);
    read_text_line(text, "FILE", "the file name", profile);
    read_text_line(text, "DATE", "the date", profile);
    return out;
}

/// Lines 13 to 21, in mm. Lengths lie along C90-C270 where widths lie along C0-C180; no width: round.
void read_sizes(PhotometricText& text, PhotometricProfile& profile) {
    constexpr double mm = 1e-3;
    const double length = optional_number(text, "the length"), width = optional_number(text, "the width");
    const double height = optional_number(text, "the height");
    profile.housing_m = glm::dvec3(width > 0.0 ? width : length, length, height) * mm;
    const double opening_length = optional_number(text, "the luminous length");
    const double opening_width = optional_number(text, "the luminous width");
    double tallest = 0.0;
    for (const char* what : {"the luminous height at C0", "the luminous height at C90",
                             "the luminous height at C180", "the luminous height at C270"})
        tallest = std::max(tallest, optional_number(text, what));
    profile.round = opening_length > 0.0 && opening_width == 0.0;
    profile.opening_m =
        glm::dvec3(profile.round ? opening_length : opening_width, opening_length, tallest) * mm;
}

scene::PhotometricLamps read_lamps(PhotometricText& text, PhotometricProfile& profile) {
    scene::PhotometricLamps out;
    const double count = optional_number(text, "the number of lamps");
    if (count != std::floor(count) || std::abs(count) > 1e5)
        throw text.error("the number of lamps must be a whole number");
    // A negative number is the convention for photometry of the whole luminaire.
    profile.absolute = profile.absolute || count < 0.0;
    out.count = int(std::abs(count));
    out.type = text.line("the type of lamps");
    const double flux_lm = line_number(text, "the flux of the lamps");
    if (!(flux_lm >= 0.0) || flux_lm > 1e9) throw text.error("the flux of the lamps must be positive");
    out.flux_lm = flux_lm;
    out.color = text.line("the colour of the lamps");
    out.temperature_kelvin = colour_temperature(out.color, true);
    out.color_rendering = text.line("the colour rendering of the lamps");
    const double power_w = optional_number(text, "the power of the lamps");
    if (power_w > 0.0) out.power_w = power_w;
    return out;
}

void read_light(PhotometricText& text, const PhotometricOptions& options, PhotometricProfile& profile) {
    constexpr std::size_t most_sets = 20;  // the format's own bound
    profile.downward_fraction = optional_number(text, "the downward flux fraction") / 100.0;
    const double ratio = optional_number(text, "the light output ratio") / 100.0;
    if (ratio > 0.0) profile.light_output_ratio = ratio;
    const double factor = optional_number(text, "the conversion factor");
    if (factor < 0.0) throw text.error("the conversion factor must be positive");
    profile.multiplier = factor > 0.0 ? factor : 1.0;
    profile.measurement_tilt_deg = optional_number(text, "the tilt of the luminaire");
    const std::size_t sets = line_count(text, "the number of lamp sets", 1, most_sets);
    for (std::size_t i = 0; i < sets; ++i) profile.lamp_sets.push_back(read_lamps(text, profile));
    if (options.lamp_set >= sets)
        throw input_error("no lamp set " + std::to_string(options.lamp_set + 1), text.where(),
                          "the file has " + std::to_string(sets));
    profile.lamp_set = options.lamp_set;
    for (int i = 0; i < 10; ++i) (void)optional_number(text, "a direct ratio");
}

/// The C-planes that the file has, counted from 0: all, one, half of them or a quarter.
struct Planes {
    std::size_t first;
    std::size_t count;
};

Planes planes_of(const Header& header, const PhotometricText& text) {
    const std::size_t all = header.planes;
    const auto divisible = [&](std::size_t by) {
        if (all % by != 0)
            throw text.error(
                std::to_string(all) + " C-planes have no symmetry " + std::to_string(header.symmetry),
                "a multiple of " + std::to_string(by));
    };
    switch (header.symmetry) {
        case 1:
            return {0, 1};
        case 2:
            divisible(2);
            return {0, all / 2 + 1};
        case 3:
            divisible(4);
            return {3 * all / 4, all / 2 + 1};
        case 4:
            divisible(4);
            return {0, all / 4 + 1};
        default:
            return {0, all};
    }
}

void check_step(const std::vector<double>& angles, double step, const char* what, const std::string& where,
                Diagnostics& diagnostics) {
    if (step <= 0.0 || angles.size() < 2) return;
    for (std::size_t i = 0; i + 1 < angles.size(); ++i) {
        if (std::abs(angles[i + 1] - angles[i] - step) < 0.05 + 0.01 * step) continue;
        diagnostics.warn(where + ": the " + what +
                         " are not as far apart as the file says; the angles count");
        return;
    }
}

/// The angle of a plane that may be one round on: symmetry 3 runs from C270 through C0 to C90.
std::vector<double> plane_angles(const std::vector<double>& all, const Planes& planes,
                                 const PhotometricText& text) {
    if (planes.count == 1) return {0.0};
    std::vector<double> out;
    for (std::size_t i = 0; i < planes.count; ++i) {
        const std::size_t index = planes.first + i;
        const std::size_t wrapped = index % all.size();
        out.push_back(all[wrapped] + (index >= all.size() ? 360.0 : 0.0));
        if (i > 0 && out[i] <= out[i - 1]) throw text.error("C-planes must ascend");
    }
    return out;
}

FileWeb read_web(PhotometricText& text, const Header& header, Diagnostics& diagnostics,
                 const PhotometricProfile& profile) {
    const Planes planes = planes_of(header, text);
    const std::size_t nodes = planes.count * header.gammas;
    if (nodes > kMostNodes || header.planes + header.gammas + nodes > text.bytes_left() / 2 + 1)
        throw text.error("the file is too short for " + std::to_string(planes.count) + " x " +
                         std::to_string(header.gammas) + " intensities");
    const std::vector<double> all_planes =
        read_angles(text, header.planes, "C-plane", [&] { return line_number(text, "a C-plane"); });
    check_step(all_planes, header.plane_step_deg, "C-planes", text.where(), diagnostics);
    FileWeb web;
    web.horizontal_deg = plane_angles(all_planes, planes, text);
    web.vertical_deg =
        read_angles(text, header.gammas, "gamma angle", [&] { return line_number(text, "a gamma angle"); });
    web.where = text.place();
    check_step(web.vertical_deg, header.gamma_step_deg, "gamma angles", text.where(), diagnostics);
    const double flux_lm = *profile.lamp_sets[profile.lamp_set].flux_lm;
    const double scale = profile.multiplier * flux_lm / 1000.0;
    bool negative = false;
    web.candela.reserve(nodes);
    for (std::size_t i = 0; i < nodes; ++i)
        web.candela.push_back(checked_intensity(text, scale * line_number(text, "an intensity"), negative));
    if (negative) diagnostics.warn(text.where() + ": negative intensities became 0");
    return web;
}

}  // namespace

PhotometricProfile read_eulumdat(PhotometricText& text, const PhotometricOptions& options,
                                 Diagnostics& diagnostics) {
    PhotometricProfile profile;
    profile.format = scene::PhotometricFormat::eulumdat;
    profile.standard = "EULUMDAT";
    const Header header = read_header(text, profile);
    read_sizes(text, profile);
    read_light(text, options, profile);
    const FileWeb web = read_web(text, header, diagnostics, profile);
    expand_type_c(web, diagnostics, profile);
    return profile;
}

}  // namespace candela::io::detail
