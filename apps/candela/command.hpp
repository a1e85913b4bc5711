#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace candela::app {

/// Each subcommand adds itself to the command line; what it does runs after parsing and returns the exit
/// code.
using Action = std::function<int()>;

void add_render(CLI::App& app, Action& action);
void add_info(CLI::App& app, Action& action);
void add_bench(CLI::App& app, Action& action);
void add_compare(CLI::App& app, Action& action);
void add_meter(CLI::App& app, Action& action);
void add_bake(CLI::App& app, Action& action);
void add_convert(CLI::App& app, Action& action);
void add_validate(CLI::App& app, Action& action);
void add_light(CLI::App& app, Action& action);
void add_env(CLI::App& app, Action& action);

}  // namespace candela::app
