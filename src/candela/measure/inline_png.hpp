#pragma once

#include <string>

#include "candela/measure/experiment.hpp"

namespace candela::measure {

/// "data:image/png;base64,..." of a picture, for a page without external files. Throws Error
/// (Fault::machine).
[[nodiscard]] std::string png_data_uri(const Panel& picture);

}  // namespace candela::measure
