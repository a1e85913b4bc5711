#pragma once

#include <gtest/gtest.h>
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

/// An error is one line on standard error that starts with the program's name, and nothing else anywhere.
inline void expect_one_line(const Outcome& outcome, int exit_code, const std::string& mentions) {
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(lines(outcome.err), 1u) << outcome.err;
    EXPECT_EQ(outcome.err.rfind("candela: error: ", 0), 0u) << outcome.err;
    EXPECT_NE(outcome.err.find(mentions), std::string::npos) << outcome.err;
}

}  // namespace candela::test
