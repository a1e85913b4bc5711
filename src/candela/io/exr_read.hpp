#pragma once

#include <filesystem>

#include "candela/scene/diagnostics.hpp"
#include "candela/scene/scene.hpp"

namespace candela::io::detail {

/// The first part's R, G and B, else its Y, in cd/m^2 (times whiteLuminance where the header has it); scan
/// lines or tiles, any compression, half, float or uint. The result is the display window; what the data
/// window lacks of it is black, with a warning. Chromaticities other than Rec.709 are a warning.
[[nodiscard]] scene::Environment read_exr_environment(const std::filesystem::path& file,
                                                      Diagnostics& diagnostics);

}  // namespace candela::io::detail
