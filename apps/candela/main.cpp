#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <vector>

#include "candela/scene/error.hpp"
#include "candela/version.hpp"
#include "command.hpp"
#include "help.hpp"
#include "option_rules.hpp"

namespace {

int fail(const std::string& line, candela::Fault fault) {
    std::fprintf(stderr, "candela: error: %s\n", line.c_str());
    return static_cast<int>(fault);
}

/// What was printed has to arrive: a full disk is no success.
int finish(int code) {
    std::cout.flush();
    const bool arrived = std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good();
    if (arrived || code != 0) return code;
    return fail(std::string("standard output: cannot be written: ") + std::strerror(errno),
                candela::Fault::machine);
}

int run(int argc, char** argv) {
    CLI::App app("Candela: light in physical units, on Vulkan, with its own proof");
    app.set_version_flag("--version", std::string("candela ") + candela::version());
    app.require_subcommand(1);
    candela::app::Action action;
    candela::app::add_render(app, action);
    candela::app::add_info(app, action);
    candela::app::add_bench(app, action);
    candela::app::add_compare(app, action);
    candela::app::add_meter(app, action);
    candela::app::add_bake(app, action);
    candela::app::add_convert(app, action);
    candela::app::add_validate(app, action);
    candela::app::add_light(app, action);
    candela::app::add_env(app, action);
    candela::app::limit_value_counts(app);
    candela::app::arrange_help(app);
    app.add_subcommand("help", "Help on a command: candela help COMMAND");
    // Before any command looks at its options.
    app.parse_complete_callback([&app] { candela::app::refuse_empty_values(app); });
    const std::vector<std::string> arguments =
        candela::app::without_help_command(app, {argv + 1, argv + argc});
    try {
        // CLI11 takes them from the back.
        app.name("candela");
        app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
    } catch (const CLI::ParseError& error) {
        const bool asked = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success);
        if (asked) return finish(app.exit(error));
        const std::string line = candela::app::parse_error_line(app, error, arguments);
        return fail(candela::Error(candela::Fault::usage, line).line(), candela::Fault::usage);
    }
    return finish(action());
}

}  // namespace

int main(int argc, char** argv) {
    // A limit of file sizes is an error of writing like a full disk.
    std::signal(SIGXFSZ, SIG_IGN);
    try {
        return run(argc, argv);
    } catch (const candela::Error& error) {
        return fail(error.line(), error.fault());
    } catch (const std::bad_alloc&) {
        return fail("out of memory", candela::Fault::machine);
    } catch (const std::exception& error) {
        return fail(error.what(), candela::Fault::machine);
    }
}
