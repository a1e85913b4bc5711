#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "common/files.hpp"

namespace candela::test {

struct Outcome {
    int exit_code = -1;
    std::string out;
    std::string err;
};

/// Runs the command line under a shell; `arguments` are the test's own words, quoted by the caller.
inline Outcome run_candela(const std::string& arguments) {
    const TemporaryFolder streams;
    const std::string command =
        std::string(CANDELA_BINARY) + " " + arguments + " >" + (streams / "out") + " 2>" + (streams / "err");
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), slurp(streams / "out"),
            slurp(streams / "err")};
}

inline std::size_t lines(const std::string& text) {
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace candela::test
