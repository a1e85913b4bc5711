#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "candela/io/photometric.hpp"
#include "candela/io/photometric_text.hpp"
#include "candela/io/photometric_web.hpp"

/// The readers behind load_photometric. Each throws Error with "file:line".
namespace candela::io::detail {

/// The whole file as text; files of photometry are a few kilobytes.
[[nodiscard]] std::string read_photometric_text(const std::filesystem::path& file);

/// `folder` is where a TILT= file is, empty: nowhere.
[[nodiscard]] scene::PhotometricProfile read_ies(PhotometricText& text, const std::filesystem::path& folder,
                                                 Diagnostics& diagnostics);

[[nodiscard]] scene::PhotometricProfile read_eulumdat(PhotometricText& text,
                                                      const PhotometricOptions& options,
                                                      Diagnostics& diagnostics);

/// What stands behind "TILT=" of an IES file, also in small letters and with blanks about the equals sign.
[[nodiscard]] std::optional<std::string_view> behind_tilt(std::string_view line);

/// What is common to both webs: `count` ascending angles, each from `next()`.
template <typename Next>
std::vector<double> read_angles(const PhotometricText& text, std::size_t count, const char* what,
                                const Next& next) {
    std::vector<double> out;
    out.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        out.push_back(next());
        if (i > 0 && out[i] <= out[i - 1]) throw text.error(std::string(what) + "s must ascend");
    }
    return out;
}

/// Negative intensities, noise of the photometer, become 0 with a warning; what no lamp gives is an error.
[[nodiscard]] double checked_intensity(const PhotometricText& text, double candela, bool& negative);

/// A colour temperature in what is written about a lamp: "3000", "4000 K", "LED 2700K", and, where `codes`,
/// the three digits of lamp makers (840: rendering 8., 4000 K).
[[nodiscard]] std::optional<double> colour_temperature(std::string_view text, bool codes);

}  // namespace candela::io::detail
