#include "compare_maps.hpp"

#include <cmath>
#include <limits>

#include "candela/io/image_write.hpp"
#include "candela/measure/color_map.hpp"
#include "candela/version.hpp"

namespace candela::app {

void write_map_png(const std::string& file, const measure::ErrorMap& map) {
    std::vector<std::uint8_t> rgb;
    rgb.reserve(3 * map.values.size());
    for (const float error : map.values)
        for (const std::uint8_t c : measure::magma(error)) rgb.push_back(c);
    io::write_png(file, map.width, map.height, std::span<const std::uint8_t>(rgb),
                  {{"Software", std::string("candela ") + version()}});
}

void write_map_exr(const std::string& file, const measure::Picture& x, const measure::Picture& r,
                   const measure::Comparison& comparison) {
    const float none = std::numeric_limits<float>::quiet_NaN();
    std::vector<std::vector<float>> planes(3, std::vector<float>(r.pixels.size()));
    for (std::size_t i = 0; i < r.pixels.size(); ++i) {
        const bool counts = comparison.mask.empty() || comparison.mask[i] != 0;
        for (std::size_t c = 0; c < 3; ++c)
            planes[c][i] = counts ? std::abs(x.pixels[i][int(c)] - r.pixels[i][int(c)]) : none;
    }
    std::vector<io::ExrChannel> channels;
    const char* names[] = {"R", "G", "B"};
    for (std::size_t c = 0; c < 3; ++c)
        channels.push_back({names[c], io::PixelType::float32, std::span<const float>(planes[c])});
    channels.push_back({"flip.Y", io::PixelType::half, std::span<const float>(comparison.flip.values)});
    if (!comparison.hdr_flip.values.empty())
        channels.push_back(
            {"hdr_flip.Y", io::PixelType::half, std::span<const float>(comparison.hdr_flip.values)});
    io::write_exr(file, r.width, r.height, channels, {{"candela/version", std::string(version())}});
}

}  // namespace candela::app
