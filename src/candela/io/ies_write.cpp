#include "candela/io/ies_write.hpp"

#include <algorithm>
#include <cctype>
#include <cstdio>

namespace candela::io {
namespace {

/// LM-63-2002 allows 256 characters a line; numbers break earlier, for older readers.
constexpr std::size_t kMostKeywordChars = 240;
constexpr std::size_t kMostNumberChars = 78;

/// As many digits as reading them back needs.
std::string number(double x) {
    char text[32];
    for (int digits = 6; digits <= 17; ++digits) {
        std::snprintf(text, sizeof(text), "%.*g", digits, x);
        if (std::stod(text) == x) break;
    }
    return text;
}

std::string number(float x) {
    char text[32];
    for (int digits = 6; digits <= 9; ++digits) {
        std::snprintf(text, sizeof(text), "%.*g", digits, static_cast<double>(x));
        if (std::stof(text) == x) break;
    }
    return text;
}

template <class Numbers>
void append_numbers(const Numbers& numbers, std::string& out) {
    std::size_t line = 0;
    for (const auto x : numbers) {
        const std::string text = number(x);
        if (line > 0 && line + 1 + text.size() > kMostNumberChars) {
            out += "\r\n";
            line = 0;
        }
        out += (line > 0 ? " " : "") + text;
        line += text.size() + 1;
    }
    out += "\r\n";
}

std::string printable(const std::string& text) {
    std::string out = text.substr(0, kMostKeywordChars);
    for (char& c : out) {
        if (std::iscntrl(static_cast<unsigned char>(c))) c = ' ';
    }
    return out;
}

void append_keywords(const scene::PhotometricProfile& profile, std::string& out) {
    for (const auto& [key, value] : profile.keywords) {
        std::string name = printable(key.empty() ? "OTHER" : key);
        std::replace(name.begin(), name.end(), ']', ' ');
        std::size_t begin = 0;
        while (begin <= value.size()) {
            const std::size_t end = std::min(value.find('\n', begin), value.size());
            out += "[" + name + "] " + printable(value.substr(begin, end - begin)) + "\r\n";
            name = "MORE";
            begin = end + 1;
        }
    }
}

/// The rows of the web that the file has. Where light ends abruptly, the web has the angle twice and is dark
/// beyond; a file ends there, and is dark beyond by that.
struct Rows {
    std::size_t first = 0;
    std::size_t end = 0;
};

Rows rows_of(const std::vector<double>& vertical_deg) {
    const std::size_t n = vertical_deg.size();
    Rows rows{0, n};
    if (n >= 3 && vertical_deg[1] == vertical_deg[2]) rows.first = 2;
    if (n >= rows.first + 3 && vertical_deg[n - 2] == vertical_deg[n - 3]) rows.end = n - 2;
    return rows;
}

template <class T>
std::vector<T> slice(const std::vector<T>& from, std::size_t first, std::size_t end) {
    return {from.begin() + static_cast<std::ptrdiff_t>(first),
            from.begin() + static_cast<std::ptrdiff_t>(end)};
}

}  // namespace

std::string ies_text(const scene::PhotometricProfile& profile) {
    std::string out = "IESNA:LM-63-2002\r\n";
    append_keywords(profile, out);
    out += "TILT=NONE\r\n";
    const bool axial = profile.symmetry == scene::PhotometricSymmetry::axial;
    const std::size_t planes = axial ? 1 : profile.horizontal_deg.size();
    const double side = profile.round ? -1.0 : 1.0;
    const double watts =
        profile.lamp_sets.empty() ? 0.0 : profile.lamp_sets[profile.lamp_set].power_w.value_or(0.0);
    // One lamp, absolute (-1 lm), multiplier 1, type C, metres; ballast factor and the reserved number are 1.
    const Rows rows = rows_of(profile.vertical_deg);
    out += "1 -1 1 " + std::to_string(rows.end - rows.first) + " " + std::to_string(planes) + " 1 2 " +
           number(side * profile.opening_m.y) + " " + number(side * profile.opening_m.x) + " " +
           number(profile.opening_m.z) + "\r\n1 1 " + number(watts) + "\r\n";
    append_numbers(slice(profile.vertical_deg, rows.first, rows.end), out);
    append_numbers(slice(profile.horizontal_deg, 0, planes), out);
    const std::size_t height = profile.vertical_deg.size();
    for (std::size_t plane = 0; plane < planes; ++plane)
        append_numbers(slice(profile.candela, plane * height + rows.first, plane * height + rows.end), out);
    return out;
}

}  // namespace candela::io
