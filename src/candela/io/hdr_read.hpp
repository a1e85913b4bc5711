#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "candela/scene/diagnostics.hpp"
#include "candela/scene/memory_budget.hpp"
#include "candela/scene/progress.hpp"
#include "candela/scene/scene.hpp"

namespace candela::io::detail {

/// Radiance picture (RGBE), flat, old or new run-length coding, all eight orientations. Values are
/// mantissa * 2^(exponent - 136) as every program but Radiance itself reads them (Radiance adds half a step),
/// divided by the header's EXPOSURE and COLORCORR. XYZE is refused; primaries other than Rec.709 are a
/// warning. Source: Ward, "The RADIANCE Picture File Format".
[[nodiscard]] scene::Environment decode_hdr(std::span<const std::byte> bytes, const std::string& where,
                                            Diagnostics& diagnostics,
                                            const std::optional<scene::MemoryBudget>& memory = {},
                                            const ProgressFunction& progress = {});

}  // namespace candela::io::detail
