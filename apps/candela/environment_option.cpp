#include "environment_option.hpp"

#include <algorithm>
#include <filesystem>

#include "candela/bake/environment.hpp"
#include "candela/bake/sky.hpp"
#include "candela/io/json_reader.hpp"
#include "candela/measure/numerics.hpp"
#include "candela/scene/environment_sources.hpp"
#include "candela/scene/error.hpp"
#include "progress_line.hpp"
#include "shading/environment.glsl"
#include "sky_option.hpp"

namespace candela::app {
namespace {

/// The light of a sun goes into the texel that holds its middle.
void put_into(scene::Environment& e, const scene::Light& sun) {
    const glm::vec2 uv = shading::equirect_uv(-sun.direction);
    const auto x = std::min(static_cast<std::uint32_t>(uv.x * static_cast<float>(e.width)), e.width - 1);
    const auto y = std::min(static_cast<std::uint32_t>(uv.y * static_cast<float>(e.height)), e.height - 1);
    e.luminance_nit[std::size_t{y} * e.width + x] +=
        sun.color * sun.intensity / shading::equirect_texel_solid_angle(y, e.width, e.height);
}

}  // namespace

void add_environment_file_options(CLI::App& command, EnvironmentFileOptions& o) {
    command
        .add_option("--env-layout,--env-projection", o.layout,
                    "How a picture shows all directions: auto is by the ratio of its sides; angular maps "
                    "(light probes, ahead in the middle) and mirror balls (ahead on the rim) are square")
        ->check(CLI::IsMember({"auto", "equirect", "cross", "octahedral", "angular", "mirror-ball"}))
        ->capture_default_str();
    command
        .add_option("--env-cube", o.cube_space,
                    "Faces of cubes: picture (seen from inside, +Z ahead) or direct (looked up as they are)")
        ->check(CLI::IsMember({"picture", "direct"}));
    command.add_option("--env-layer", o.layer,
                       "Layer or part of an OpenEXR file, such as ViewLayer.Combined, where it has several");
    command
        .add_option("--env-negative", o.negative,
                    "Negative values: clamp (to 0) or spread (taken from their neighbours, which keeps the "
                    "mean)")
        ->check(CLI::IsMember({"clamp", "spread"}))
        ->capture_default_str();
}

io::EnvironmentOptions environment_options(const EnvironmentFileOptions& o) {
    io::EnvironmentOptions out;
    out.layout = io::layout_by_name(o.layout).value_or(io::EnvironmentLayout::automatic);
    out.cube_space = io::cube_space_by_name(o.cube_space);
    out.layer = o.layer;
    out.negative = o.negative == "spread" ? io::NegativeTexels::spread : io::NegativeTexels::clamp;
    return out;
}

void check_environment_name(const std::string& name) {
    std::error_code none;
    if (std::filesystem::exists(name, none) || name.find("{face}") != std::string::npos) return;
    static const std::vector<std::string> built_in{"studio", "sky", "none"};
    const std::string near = io::nearest_name(name, built_in);
    throw input_error("no such file", name,
                      (near.empty() ? "" : "did you mean " + near + "? ") +
                          "built in are studio, sky, sky:KEY=VALUE,... and none");
}

io::ReadEnvironment environment_picture(const std::string& name, const EnvironmentFileOptions& options,
                                        Diagnostics& diagnostics) {
    ProgressLine line("reading the environment");
    if (name == "studio") return {bake::studio_environment(), true};
    const std::optional<scene::SkySettings> settings = sky_of_option(name);
    if (!settings) check_environment_name(name);
    if (!settings) {
        io::EnvironmentOptions how = environment_options(options);
        how.progress = line.function();
        return io::read_environment(name, diagnostics, how);
    }
    bake::Sky sky = bake::sky_of(*settings);
    if (sky.sun) put_into(sky.environment, *sky.sun);
    return {std::move(sky.environment), true};
}

void warn_of_level(const scene::Environment& e, Diagnostics& diagnostics) {
    const double lx = scene::upward_illuminance_lx(e);
    // The dimmest room that is lit to be seen, and more than the sun at the zenith gives.
    constexpr double min_lx = 100.0, max_lx = 200000.0;
    if (!(lx > 0.0) || (lx >= min_lx && lx <= max_lx)) return;
    const char* other = lx < min_lx ? "a sunset has about 400" : "a clear noon has about 100,000";
    diagnostics.warn(e.name + ": relative: " + measure::readable(lx) + " lx up-facing; " + other +
                     ": --env-lux LX (or --env-scale 1, if it holds cd/m2)");
}

}  // namespace candela::app
