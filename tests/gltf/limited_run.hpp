#pragma once

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include "cli/process.hpp"

/// What every test of malformed input needs.
namespace candela::test {

/// Runs `candela SUBCOMMAND FILE` with 2 GiB of address space; a run of more than 5 s is killed.
inline Outcome within_limits(const char* subcommand, const std::string& file) {
    const TemporaryFolder streams;
    const std::string out = streams / "out", err = streams / "err";
    const pid_t child = fork();
    if (child == 0) {
        const rlimit memory{std::size_t{2} << 30, std::size_t{2} << 30};
        setrlimit(RLIMIT_AS, &memory);
        if (!freopen(out.c_str(), "w", stdout) || !freopen(err.c_str(), "w", stderr)) _exit(126);
        alarm(5);  // survives exec; its signal ends the program
        execl(CANDELA_BINARY, CANDELA_BINARY, subcommand, file.c_str(), static_cast<char*>(nullptr));
        _exit(127);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), slurp(out), slurp(err)};
}

inline Outcome info_within_limits(const std::string& file) {
    return within_limits("info", file);
}

inline void write(const std::filesystem::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
}

inline void expect_one_clear_line(const Outcome& outcome, const std::string& mentions) {
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(lines(outcome.err), 1u) << outcome.err;
    EXPECT_EQ(outcome.err.rfind("candela: error: ", 0), 0u) << outcome.err;
    EXPECT_NE(outcome.err.find(mentions), std::string::npos) << outcome.err;
}

}  // namespace candela::test
