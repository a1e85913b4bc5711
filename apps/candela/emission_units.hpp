#pragma once

#include "job.hpp"

namespace candela::app {

void add_emission_options(CLI::App& command, JobOptions& options);

/// Decides by the command line, else by the stage, what a file's emission is in, and scales the materials of
/// job.scene to cd/m^2. Call once, when the scene's lights and environment are complete. `brings_no_light`:
/// neither files nor command line name a light or an environment. Returns whether emission is relative and
/// anything emits. docs/exposure.md, "Units of emission".
bool set_emission_units(const JobOptions& options, const io::Stage& stage, bool brings_no_light, Job& job);

[[nodiscard]] nlohmann::json emission_units_json(const EmissionUnits& units);

}  // namespace candela::app
