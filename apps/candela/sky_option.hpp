#pragma once

#include <optional>
#include <string>

#include "candela/scene/sky.hpp"

namespace candela::app {

/// Of "sky" and "sky:elevation=35,turbidity=3"; none for other text. Throws Error (Fault::usage).
[[nodiscard]] std::optional<scene::SkySettings> sky_of_option(const std::string& text);

}  // namespace candela::app
