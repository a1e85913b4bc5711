#pragma once

#include <string>

#include "candela/io/environment_read.hpp"
#include "common/files.hpp"
#include "sky_of_directions.hpp"
#include "texture_files.hpp"

namespace candela::test {

inline constexpr std::uint32_t kSize = 64;

inline scene::Environment read(const std::string& file, const io::EnvironmentOptions& options = {}) {
    Diagnostics diagnostics;
    return io::read_environment(file, diagnostics, options);
}

inline scene::Environment read_bytes(const Text& bytes, const io::EnvironmentOptions& options = {}) {
    const TemporaryFolder folder;
    spit(folder / "a.bin", bytes);
    return read(folder / "a.bin", options);
}

/// A picture seen from inside, in the APIs' space where +X is to the right of +Z: +Z is ahead, which is -Z
/// here.
inline glm::vec3 colorful_ahead(const glm::vec3& api) {
    return colorful({api.x, api.y, -api.z});
}

inline Ktx2 ktx_cube(const Sky& sky, std::uint32_t format = 97) {
    Ktx2 out;
    out.format = format;
    out.width = out.height = kSize;
    out.data = pixels(faces_of(sky, kSize), format);
    return out;
}

}  // namespace candela::test
