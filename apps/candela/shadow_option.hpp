#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "candela/scene/diagnostics.hpp"

namespace candela::app {

/// How light is kept from what it does not reach.
enum class Shadows : std::uint8_t {
    none,
    map,  ///< real time: shadow maps
    ray,  ///< integrate and path: a ray to the light
};

[[nodiscard]] const char* name_of(Shadows way);

struct ShadowRequestOptions {
    std::string way;  ///< none, map, ray, or empty: what the mode does by itself
    std::uint32_t atlas_texels = 4096;
};

void add_shadow_options(CLI::App& command, ShadowRequestOptions& options);

/// The way of one mode: realtime, integrate or path. Throws Error (Fault::usage) when the mode has no such
/// way.
[[nodiscard]] Shadows shadows_of(const ShadowRequestOptions& options, const std::string& mode);

/// Says how many lights the atlas had no room for.
void warn_of_unshadowed(std::uint32_t lights, Diagnostics& diagnostics);

}  // namespace candela::app
