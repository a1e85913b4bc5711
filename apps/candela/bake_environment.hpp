#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "environment_option.hpp"

namespace candela::app {

struct BakeEnvironmentOptions {
    std::string environment;
    EnvironmentFileOptions how;
    std::string folder;
    std::string preset = "candela";
    std::string format = "ktx2";
    std::string technique = "harmonic";
    std::optional<std::string> mapping;  ///< none: what the preset asks for, else linear
    std::uint32_t size = 256;
    bool size_given = false;  ///< on the command line
    std::uint32_t levels = 0;
    std::uint32_t samples = 0;
    std::uint32_t irradiance_size = 32;
    float scale = 1.0f;
    float rotate_deg = 0.0f;
    bool json = false;
};

/// Refuses what contradicts or could have no effect. Throws Error (Fault::usage).
void check_bake_environment_options(const CLI::App& command, const BakeEnvironmentOptions& options);

/// Filters an environment and writes it, with all that tells what it means.
int bake_environment(const BakeEnvironmentOptions& options);

}  // namespace candela::app
