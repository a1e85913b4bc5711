#include "shadow_option.hpp"

#include <vector>

#include "candela/scene/error.hpp"

namespace candela::app {
namespace {

/// What a mode can do, its own choice first.
std::vector<Shadows> ways_of(const std::string& mode) {
    if (mode == "path") return {Shadows::ray, Shadows::none};
    if (mode == "integrate") return {Shadows::ray, Shadows::none};
    return {Shadows::map, Shadows::none};
}

}  // namespace

const char* name_of(Shadows way) {
    switch (way) {
        case Shadows::map:
            return "map";
        case Shadows::ray:
            return "ray";
        default:
            return "none";
    }
}

void add_shadow_options(CLI::App& command, ShadowRequestOptions& o) {
    command
        .add_option("--shadows", o.way,
                    "none; map (real time's own way); ray (the own way of integrate and path: the truth)")
        ->check(CLI::IsMember({"none", "map", "ray"}));
    command
        .add_option("--shadow-atlas", o.atlas_texels,
                    "Real time: largest side of the shadow maps' atlas in texels, 4 bytes each")
        ->check(CLI::Range(256u, 16384u))
        ->capture_default_str();
}

Shadows shadows_of(const ShadowRequestOptions& options, const std::string& mode) {
    const std::vector<Shadows> ways = ways_of(mode);
    if (options.way.empty()) return ways.front();
    std::string names;
    for (const Shadows way : ways) {
        if (options.way == name_of(way)) return way;
        names += (names.empty() ? "" : " or ") + std::string(name_of(way));
    }
    const std::string hint = "--shadows " + names + (options.way == "ray" ? ", or --mode path for rays" : "");
    throw Error(Fault::usage, "no such shadows in the mode " + mode + ": " + options.way, "--shadows", hint);
}

void warn_of_unshadowed(std::uint32_t lights, Diagnostics& diagnostics) {
    if (lights == 0) return;
    diagnostics.warn(std::to_string(lights) + (lights == 1 ? " light has" : " lights have") +
                     " no shadow: the atlas is full (--shadow-atlas, or casts_shadow false)");
}

}  // namespace candela::app
