#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "candela/io/environment_read.hpp"

namespace candela::app {

/// How an environment's file is to be understood, as the command line says it.
struct EnvironmentFileOptions {
    std::string layout = "auto";
    std::string cube_space;  ///< empty: what the file says
    std::string layer;       ///< of an EXR file; empty: what io::EnvironmentOptions takes
    std::string negative = "clamp";
};

void add_environment_file_options(CLI::App& command, EnvironmentFileOptions& options);

[[nodiscard]] io::EnvironmentOptions environment_options(const EnvironmentFileOptions& options);

/// Throws Error (Fault::input) for what is neither built in nor there, with what is built in.
void check_environment_name(const std::string& name);

/// What an environment's name on a command line stands for, as one picture: a file, "studio", or "sky" with
/// its settings, whose sun is then a texel of the picture.
[[nodiscard]] io::ReadEnvironment environment_picture(const std::string& name,
                                                      const EnvironmentFileOptions& options,
                                                      Diagnostics& diagnostics);

/// One warning for a file's light, with its scale, whose up-facing illuminance no lit place has: such files
/// are relative.
void warn_of_level(const scene::Environment& environment, Diagnostics& diagnostics);

}  // namespace candela::app
