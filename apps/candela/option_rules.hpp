#pragma once

#include <CLI/CLI.hpp>
#include <initializer_list>
#include <string>
#include <vector>

/// What options of one command mean beside each other. An option that could have no effect, or that another
/// one contradicts, is refused: whoever wrote it meant something by it. Everything here throws Error
/// (Fault::usage).
namespace candela::app {

/// Whether the option stands on the command line, whatever its value; false for one that the command lacks.
[[nodiscard]] bool given(const CLI::App& command, const std::string& option);

/// At most one of these.
void refuse_together(const CLI::App& command, std::initializer_list<const char*> options);

/// None of these; `why` goes on after "has no effect".
void refuse_without_effect(const CLI::App& command, const std::vector<std::string>& options,
                           const std::string& why, const std::string& hint = {});

/// None of the command's options but these (and --help), where a subcommand follows that has its own.
void refuse_before_subcommand(const CLI::App& command, const std::vector<std::string>& but = {});

/// Each output once, by whatever names: the last one would take the place of the others.
void refuse_same_output(const std::vector<std::string>& files);

/// No option or argument with nothing as its value, as a script's variable that is not set leaves it; of the
/// subcommands that were called, too.
void refuse_empty_values(const CLI::App& command);

/// Lets every option of every command take its values and nothing behind them, so that a scene may follow it:
/// as many as it has a fixed count of (`--at 0,0,1` or `--at 0 0 1`), else those of one word (`--aov a,b`),
/// again each time that it is given.
void limit_value_counts(CLI::App& app);

/// A number within these bounds. CLI::Range lets NaN through, because it is not outside of them.
[[nodiscard]] CLI::Validator number_in(double low, double high);

/// 4, 8, 16...
[[nodiscard]] CLI::Validator power_of_two(std::uint32_t low, std::uint32_t high);

/// "--plto: no such option (did you mean --plot?)" for what a command does not know; what CLI11 says of it
/// else. `arguments`: the command line without the program's name.
[[nodiscard]] std::string parse_error_line(const CLI::App& app, const CLI::ParseError& error,
                                           const std::vector<std::string>& arguments);

}  // namespace candela::app
