#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "candela/io/environment_read.hpp"

namespace candela::app {

/// How an environment's file is to be understood, as the command line says it.
struct EnvironmentFileOptions {
    std::string layout = "auto";
    std::string cube_space;  ///< empty: what the file says
};

void add_environment_file_options(CLI::App& command, EnvironmentFileOptions& options);

[[nodiscard]] io::EnvironmentOptions environment_options(const EnvironmentFileOptions& options);

}  // namespace candela::app
