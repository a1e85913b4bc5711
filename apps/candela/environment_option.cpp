#include "environment_option.hpp"

namespace candela::app {

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

}  // namespace candela::app
