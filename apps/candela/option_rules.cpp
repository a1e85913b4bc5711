#include "option_rules.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <regex>

#include "candela/io/json_reader.hpp"
#include "candela/scene/error.hpp"
#include "help.hpp"

namespace candela::app {
namespace {

/// "candela env info" and the command it names, as far as the command line got.
struct Reached {
    const CLI::App* command;
    std::string name;
};

Reached reached(const CLI::App& app) {
    Reached out{&app, "candela"};
    while (!out.command->get_subcommands().empty()) {
        out.command = out.command->get_subcommands().front();
        out.name += " " + out.command->get_name();
    }
    return out;
}

std::vector<std::string> subcommands_of(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::App* sub : command.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(sub->get_name());
    return names;
}

std::vector<std::string> options_of(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options()) {
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
    return names;
}

/// `suggestion`: what to do instead; empty: look into the help.
std::string refused(const std::string& what, const std::string& name, const std::string& suggestion,
                    const std::string& help) {
    return name + ": " + what + " (" + (suggestion.empty() ? help : suggestion) + ")";
}

std::string did_you_mean(const std::string& near) {
    return near.empty() ? "" : "did you mean " + near + "?";
}

/// Of a command line without a command.
std::string missing_command(const Reached& at, const std::vector<std::string>& arguments) {
    const std::vector<std::string> known = subcommands_of(*at.command);
    const std::string help = at.name + " --help";
    const auto depth = std::count(at.name.begin(), at.name.end(), ' ');
    const auto word = std::find_if(arguments.begin() + depth, arguments.end(),
                                   [](const std::string& a) { return a.empty() || a.front() != '-'; });
    if (word != arguments.end()) {
        const std::string command = depth == 0 ? command_for_file(*word) : "";
        if (!command.empty())
            return refused("no command, but a file", *word, "did you mean " + command + "?", help);
        return refused("no such command", *word, did_you_mean(io::nearest_name(*word, known)), help);
    }
    std::string list;
    for (const std::string& name : known) list += (list.empty() ? "" : ", ") + name;
    return at.name + ": needs a command: " + list + " (" + help + ")";
}

std::string unexpected(const Reached& at, const std::vector<std::string>& left) {
    const std::string help = at.name + " --help";
    const auto option = std::find_if(left.begin(), left.end(),
                                     [](const std::string& a) { return a.size() > 1 && a.front() == '-'; });
    if (option != left.end()) {
        const std::string name = option->substr(0, option->find('='));
        if (at.command->get_option_no_throw(name) != nullptr)
            return refused("stands before the command", name, "", at.name + " ... " + name);
        return refused("no such option of " + at.name, name, option_suggestion(name, options_of(*at.command)),
                       help);
    }
    return refused("not expected", left.front(),
                   did_you_mean(io::nearest_name(left.front(), subcommands_of(*at.command))), help);
}

std::string out_of_range(const std::string& text, const std::string& low, const std::string& high) {
    double value = 0.0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (fault == std::errc::invalid_argument || end != text.data() + text.size())
        return "not a number: " + text + ": " + low + " to " + high;
    const bool inside = value >= std::stod(low) && value <= std::stod(high);
    return text + (inside ? " is not a whole number in the range " : " is not in range ") + low + " to " +
           high;
}

/// CLI11's words where they are a parser's and not a user's.
std::string plain(const std::string& what) {
    std::smatch match;
    if (std::regex_match(what, match, std::regex(R"(Could not convert: (\S+) = (.*))")))
        return match[1].str() + ": not what it takes: " + match[2].str();
    if (std::regex_match(what, match, std::regex(R"((\S+): 1 required \S+ missing)")))
        return match[1].str() + ": needs a value";
    if (std::regex_match(what, match, std::regex(R"((\S+): At least (\d+) required but received (\d+))")))
        return match[1].str() + ": needs " + match[2].str() + " values and has " + match[3].str();
    if (std::regex_match(what, match, std::regex(R"((\S+): At Most (\d+) required but received (\d+))")))
        return match[1].str() + ": takes " + match[2].str() +
               (match[2] == "1" ? " value and has " : " values and has ") + match[3].str();
    if (std::regex_match(what, match, std::regex(R"((\S+): Value (.*) not in range (\S+) to (\S+))")))
        return match[1].str() + ": " + out_of_range(match[2], match[3], match[4]);
    if (std::regex_match(what, match, std::regex(R"((\S+):  not in \{.*)")))
        return match[1].str() + ": has no value";
    if (std::regex_match(what, match, std::regex(R"((\S+): Value (.*) is not (a power of two .*))")))
        return match[1].str() + ": " + match[2].str() + " is not " + match[3].str();
    return what;
}

}  // namespace

bool given(const CLI::App& command, const std::string& option) {
    const CLI::Option* found = command.get_option_no_throw(option);
    return found != nullptr && found->count() > 0;
}

void refuse_together(const CLI::App& command, std::initializer_list<const char*> options) {
    const char* first = nullptr;
    for (const char* option : options) {
        if (!given(command, option)) continue;
        if (first != nullptr)
            throw Error(Fault::usage, std::string("contradicts ") + first, option, "leave one of them out");
        first = option;
    }
}

void refuse_without_effect(const CLI::App& command, const std::vector<std::string>& options,
                           const std::string& why, const std::string& hint) {
    for (const std::string& option : options) {
        if (given(command, option)) throw Error(Fault::usage, "has no effect " + why, option, hint);
    }
}

void refuse_before_subcommand(const CLI::App& command, const std::vector<std::string>& but) {
    if (command.get_subcommands().empty()) return;
    const std::string sub = command.get_subcommands().front()->get_name();
    for (const CLI::Option* option : command.get_options()) {
        const std::string name = option->get_name();
        if (option->count() == 0 || option == command.get_help_ptr()) continue;
        if (std::find(but.begin(), but.end(), name) != but.end()) continue;
        throw Error(Fault::usage, "has no effect before " + sub, name,
                    command.get_name() + " " + sub + " takes its own, after its name");
    }
}

void refuse_same_output(const std::vector<std::string>& files) {
    std::vector<std::filesystem::path> met;
    for (const std::string& file : files) {
        std::error_code ignored;
        const std::filesystem::path place = std::filesystem::weakly_canonical(file, ignored);
        if (std::find(met.begin(), met.end(), place) != met.end())
            throw Error(Fault::usage, "is given twice", file, "each output once");
        met.push_back(place);
    }
}

void refuse_empty_values(const CLI::App& command) {
    for (const CLI::Option* option : command.get_options()) {
        const std::vector<std::string>& values = option->results();
        if (std::find(values.begin(), values.end(), "") != values.end())
            throw Error(Fault::usage, "has no value", option->get_name(), "what it is given is empty");
    }
    for (const CLI::App* sub : command.get_subcommands()) refuse_empty_values(*sub);
}

void limit_value_counts(CLI::App& app) {
    for (CLI::Option* option : app.get_options([](const CLI::Option* o) { return o->nonpositional(); })) {
        if (!option->get_allow_extra_args()) continue;
        option->allow_extra_args(false);
        // Without a count of its own.
        if (option->get_items_expected_max() >= CLI::detail::expected_max_vector_size)
            option->expected(1)->take_all();
    }
    for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        limit_value_counts(*command);
}

CLI::Validator number_in(double low, double high) {
    char range[64];
    std::snprintf(range, sizeof(range), "%g to %g", low, high);
    const std::string text = range;
    return {[=](std::string& value) -> std::string {
                double number = 0.0;
                if (CLI::detail::lexical_cast(value, number) && number >= low && number <= high) return {};
                return "Value " + value + " not in range " + text;
            },
            "in [" + text + "]"};
}

CLI::Validator power_of_two(std::uint32_t low, std::uint32_t high) {
    const std::string text = "a power of two from " + std::to_string(low) + " to " + std::to_string(high);
    return {[=](std::string& value) -> std::string {
                std::uint32_t number = 0;
                if (CLI::detail::lexical_cast(value, number) && number >= low && number <= high &&
                    (number & (number - 1)) == 0)
                    return {};
                return "Value " + value + " is not " + text;
            },
            text};
}

std::string parse_error_line(const CLI::App& app, const CLI::ParseError& error,
                             const std::vector<std::string>& arguments) {
    const Reached at = reached(app);
    const std::string what = error.what();
    if (what.starts_with("A subcommand")) return missing_command(at, arguments);
    const std::vector<std::string> left = app.remaining(true);
    const bool extra = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError);
    if (extra && !left.empty()) return unexpected(at, left);
    if (const auto end = what.find(" is required"); end != std::string::npos)
        return at.name + ": needs " + what.substr(0, end) + " (" + at.name + " --help)";
    return plain(what) + " (" + at.name + " --help)";
}

}  // namespace candela::app
