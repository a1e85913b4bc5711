#pragma once

#include <gtest/gtest.h>

#include "candela/io/photometric.hpp"
#include "photometric_files.hpp"

namespace candela::test {

inline scene::PhotometricProfile read(const std::string& bytes, Diagnostics& diagnostics,
                                      const io::PhotometricOptions& options = {}) {
    return io::load_photometric_from_memory(std::as_bytes(std::span(bytes)), "test", {}, diagnostics,
                                            options);
}

/// A file without anything to warn of.
inline scene::PhotometricProfile read(const std::string& bytes) {
    Diagnostics diagnostics;
    scene::PhotometricProfile out = read(bytes, diagnostics);
    for (const auto& warning : diagnostics.warnings()) ADD_FAILURE() << warning.text;
    return out;
}

}  // namespace candela::test
