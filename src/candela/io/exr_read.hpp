#pragma once

#include <filesystem>
#include <optional>

#include "candela/io/environment_read.hpp"
#include "candela/scene/diagnostics.hpp"
#include "candela/scene/memory_budget.hpp"

namespace candela::io::detail {

/// The picture of the part and layer that choose_exr_picture takes: R, G and B, luminance and chroma, or grey
/// alone, in cd/m^2 (times whiteLuminance where the header has it); scan lines or tiles, any compression,
/// half, float or uint. The result is the display window; what the data window lacks of it is black, with a
/// warning. Chromaticities other than Rec.709 are a warning.
[[nodiscard]] ReadEnvironment read_exr_environment(const std::filesystem::path& file,
                                                   Diagnostics& diagnostics, const std::string& layer = {},
                                                   const std::optional<scene::MemoryBudget>& memory = {},
                                                   const ProgressFunction& progress = {});

}  // namespace candela::io::detail
