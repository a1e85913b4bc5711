#include "candela/io/photometric.hpp"

#include <algorithm>
#include <cctype>

#include "candela/io/file_kind.hpp"
#include "candela/io/image_read.hpp"
#include "candela/io/photometric_read.hpp"

namespace candela::io {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostBytes = std::size_t{1} << 24;

std::string_view as_text(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string lower_extension(const fs::path& file) {
    std::string out = file.extension().string();
    std::transform(out.begin(), out.end(), out.begin(), [](unsigned char c) { return std::tolower(c); });
    return out;
}

/// IES files since 1991 say so; those of 1986 have a TILT line, which no line of EULUMDAT looks like.
bool is_ies(std::string_view text, const std::string& name) {
    if (text.starts_with("IES")) return true;
    std::size_t at = 0;
    while (at < text.size()) {
        const std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
        if (detail::behind_tilt(detail::trimmed(text.substr(at, end - at)))) return true;
        at = end + 1;
    }
    return lower_extension(name) == ".ies";
}

}  // namespace

namespace detail {

std::string read_photometric_text(const fs::path& file) {
    const std::vector<std::byte> bytes = read_file(file, kMostBytes);
    return photometric_utf8(as_text(bytes));
}

double checked_intensity(const PhotometricText& text, double candela, bool& negative) {
    constexpr double brightest_cd = 1e15;
    if (candela > brightest_cd) throw text.error("an intensity is beyond all measure");
    negative = negative || candela < 0.0;
    return std::max(candela, 0.0);
}

std::optional<double> colour_temperature(std::string_view text, bool codes) {
    const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (!is_digit(text[i]) || (i > 0 && (is_digit(text[i - 1]) || text[i - 1] == '.'))) continue;
        std::size_t end = i;
        while (end < text.size() && is_digit(text[end])) ++end;
        const std::string digits(text.substr(i, end - i));
        const std::string_view behind = trimmed(text.substr(end));
        const bool kelvin = behind.starts_with('K') || behind.starts_with('k');
        const bool alone = codes || digits.size() == text.size();
        if ((digits.size() == 4 || digits.size() == 5) && (kelvin || alone)) {
            const double value = std::stod(digits);
            if (value >= 1000.0 && value <= 25000.0) return value;
        }
        if (codes && digits.size() == 3 && digits[0] >= '5') {
            const double value = 100.0 * std::stod(digits.substr(1));
            if (value >= 1800.0 && value <= 8000.0) return value;
        }
    }
    return std::nullopt;
}

}  // namespace detail

scene::PhotometricProfile load_photometric_from_memory(std::span<const std::byte> bytes,
                                                       const std::string& where, const fs::path& folder,
                                                       Diagnostics& diagnostics,
                                                       const PhotometricOptions& options) {
    if (bytes.empty())
        throw input_error("the file is empty", where, "a photometric file (IES or EULUMDAT) is expected");
    if (bytes.size() > kMostBytes) throw input_error("too large for a photometric file", where);
    if (const FileKind kind = kind_of_file(bytes, where);
        kind.by_content && kind.name.find("photometric") == std::string::npos)
        throw input_error(not_a("a photometric file (IES or EULUMDAT)", kind), where);
    std::string utf8 = detail::photometric_utf8(as_text(bytes));
    const bool ies = is_ies(utf8, where);
    detail::PhotometricText text(std::move(utf8), where);
    if (ies && options.lamp_set > 0)
        throw input_error("no lamp set " + std::to_string(options.lamp_set + 1), where, "IES files have one");
    scene::PhotometricProfile profile =
        ies ? detail::read_ies(text, folder, diagnostics) : detail::read_eulumdat(text, options, diagnostics);
    if (profile.name.empty()) profile.name = fs::path(where).stem().string();
    return profile;
}

scene::PhotometricProfile load_photometric(const fs::path& file, Diagnostics& diagnostics,
                                           const PhotometricOptions& options) {
    const std::vector<std::byte> bytes = read_file(file, kMostBytes);
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    return load_photometric_from_memory(bytes, file.string(), folder, diagnostics, options);
}

}  // namespace candela::io
