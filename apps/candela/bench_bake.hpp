#pragma once

#include <CLI/CLI.hpp>

#include "command.hpp"

namespace candela::app {

/// `candela bench bake`: what filtering an environment costs and how far off it is, by technique.
void add_bench_bake(CLI::App& bench, Action& action);

}  // namespace candela::app
