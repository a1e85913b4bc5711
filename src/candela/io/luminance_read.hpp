#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "candela/io/image_write.hpp"
#include "candela/scene/diagnostics.hpp"
#include "candela/scene/scene.hpp"

namespace candela::io {

/// A picture of light as it was stored: linear Rec.709 in cd/m^2, row 0 on top. Nothing is cleaned: NaN,
/// infinite and negative values are what the file says.
struct LuminanceImage {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<glm::vec3> luminance_nit;
    std::map<std::string, ExrAttribute> attributes;  ///< the header's strings and floats; none in .hdr
};

/// True for what read_luminance reads, by content. Throws Error (Fault::input) when missing or unreadable.
[[nodiscard]] bool is_luminance_file(const std::filesystem::path& file);

/// Reads .exr (R, G, B or Y of the first part, the display window, times whiteLuminance) or .hdr, by content.
/// Throws Error (Fault::input).
[[nodiscard]] LuminanceImage read_luminance(const std::filesystem::path& file, Diagnostics& diagnostics);

}  // namespace candela::io
