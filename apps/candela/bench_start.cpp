#include "bench_start.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "candela/scene/error.hpp"

namespace candela::app {
namespace {

class TemporaryFolder {
  public:
    TemporaryFolder() : path_((std::filesystem::temp_directory_path() / "candela-bench-XXXXXX").string()) {
        if (mkdtemp(path_.data()) == nullptr) throw machine_error("cannot make a temporary folder", path_);
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    [[nodiscard]] const std::string& path() const { return path_; }

  private:
    std::string path_;
};

std::vector<std::string> own_arguments() {
    std::ifstream file("/proc/self/cmdline", std::ios::binary);
    std::vector<std::string> arguments;
    for (std::string argument; std::getline(file, argument, '\0');) arguments.push_back(argument);
    return arguments;
}

/// This process's environment with the user's cache folder elsewhere, for Candela and for Mesa.
std::vector<std::string> environment_with_cache(const std::string& folder) {
    std::vector<std::string> out;
    for (char** entry = environ; *entry != nullptr; ++entry) {
        const std::string variable(*entry);
        if (!variable.starts_with("XDG_CACHE_HOME=") && !variable.starts_with("MESA_SHADER_CACHE_DIR="))
            out.push_back(variable);
    }
    out.push_back("XDG_CACHE_HOME=" + folder);
    return out;
}

std::vector<char*> null_terminated(std::vector<std::string>& strings) {
    std::vector<char*> out;
    out.reserve(strings.size() + 1);
    for (std::string& s : strings) out.push_back(s.data());
    out.push_back(nullptr);
    return out;
}

double start_ms(const std::string& cache_folder) {
    std::vector<std::string> arguments = own_arguments();
    arguments.emplace_back(kFirstFrameOnly);
    std::vector<std::string> environment = environment_with_cache(cache_folder);
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) throw machine_error("cannot make a pipe");
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    const auto start = std::chrono::steady_clock::now();
    pid_t child = 0;
    const int failed = posix_spawn(&child, "/proc/self/exe", &actions, nullptr,
                                   null_terminated(arguments).data(), null_terminated(environment).data());
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    char byte = 0;
    const bool reported = failed == 0 && read(ends[0], &byte, 1) == 1;
    const double ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    close(ends[0]);
    int status = 1;
    if (failed == 0) waitpid(child, &status, 0);  // it also writes its caches before it ends
    if (!reported || status != 0)
        throw machine_error("a second start of this command failed", "candela bench");
    return ms;
}

}  // namespace

StartTimes measure_starts() {
    const TemporaryFolder cache;
    StartTimes times;
    times.cold_ms = start_ms(cache.path());
    times.warm_ms = start_ms(cache.path());
    return times;
}

void report_first_frame() {
    std::printf("first frame\n");
    std::fflush(stdout);
}

}  // namespace candela::app
