#pragma once

#include "command.hpp"

namespace candela::app {

/// `candela bake probes SCENE`.
void add_bake_probes(CLI::App& bake, Action& action);

}  // namespace candela::app
