#pragma once

#include <string>

#include "candela/scene/photometric.hpp"

namespace candela::io {

/// A profile as IES LM-63-2002, type C, absolute: the whole web in cd as emitted, with the keywords that it
/// has. Reading it gives the same web.
[[nodiscard]] std::string ies_text(const scene::PhotometricProfile& profile);

}  // namespace candela::io
