#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace candela::app {

/// Puts the options of every command into groups (what, light, camera, quality, output) and examples under
/// its help. After all commands were added.
void arrange_help(CLI::App& app);

/// "help render" as "render --help", "help" as "--help"; anything else as it is. Without the program's name.
[[nodiscard]] std::vector<std::string> without_help_command(const CLI::App& app,
                                                            std::vector<std::string> arguments);

/// What to say beside an unknown option: where another program's name for it leads ("--fov" to --focal-mm),
/// else the nearest of the known ones, else nothing. `known` are "--" names.
[[nodiscard]] std::string option_suggestion(const std::string& name, const std::vector<std::string>& known);

/// What to do with a file that stands where a command should: "candela render FILE"; empty when it is none.
[[nodiscard]] std::string command_for_file(const std::string& word);

}  // namespace candela::app
