#include "environment_option.hpp"

#include <algorithm>
#include <filesystem>

#include "candela/bake/environment.hpp"
#include "candela/bake/sky.hpp"
#include "candela/io/json_reader.hpp"
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
        .add_option("--env-layout", o.layout,
                    "How a picture shows all directions: auto is by the ratio of its sides")
        ->check(CLI::IsMember({"auto", "equirect", "cross", "octahedral"}))
        ->capture_default_str();
    command
        .add_option("--env-cube", o.cube_space,
                    "Faces of cubes: picture (seen from inside, +Z ahead) or direct (looked up as they are)")
        ->check(CLI::IsMember({"picture", "direct"}));
}

io::EnvironmentOptions environment_options(const EnvironmentFileOptions& o) {
    io::EnvironmentOptions out;
    out.layout = io::layout_by_name(o.layout).value_or(io::EnvironmentLayout::automatic);
    out.cube_space = io::cube_space_by_name(o.cube_space);
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

scene::Environment environment_picture(const std::string& name, const EnvironmentFileOptions& options,
                                       Diagnostics& diagnostics) {
    const ProgressLine line("reading the environment");
    if (name == "studio") return bake::studio_environment();
    const std::optional<scene::SkySettings> settings = sky_of_option(name);
    if (!settings) check_environment_name(name);
    if (!settings) return io::read_environment(name, diagnostics, environment_options(options));
    bake::Sky sky = bake::sky_of(*settings);
    if (sky.sun) put_into(sky.environment, *sky.sun);
    return std::move(sky.environment);
}

}  // namespace candela::app
