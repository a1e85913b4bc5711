#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "candela/scene/diagnostics.hpp"
#include "candela/scene/photometric.hpp"

namespace candela::io {

struct PhotometricOptions {
    std::size_t lamp_set = 0;  ///< which of EULUMDAT's alternatives
};

/// Reads IES LM-63 (1986, 1991, 1995, 2002, 2019; types A, B, C) or EULUMDAT, told apart by content, and by
/// extension where that says nothing. A file that TILT= names is read from the same folder or below. Throws
/// Error (Fault::input) with "file:line" for whatever is malformed; what can be repaired with certainty is a
/// warning.
[[nodiscard]] scene::PhotometricProfile load_photometric(const std::filesystem::path& file,
                                                         Diagnostics& diagnostics,
                                                         const PhotometricOptions& options = {});

/// The same from memory. `where` names the source in messages; `folder` is where TILT= files are, empty:
/// nowhere.
[[nodiscard]] scene::PhotometricProfile load_photometric_from_memory(std::span<const std::byte> bytes,
                                                                     const std::string& where,
                                                                     const std::filesystem::path& folder,
                                                                     Diagnostics& diagnostics,
                                                                     const PhotometricOptions& options = {});

}  // namespace candela::io
