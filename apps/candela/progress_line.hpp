#pragma once

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <span>
#include <string>
#include <thread>

#include "candela/scene/progress.hpp"

/// What a command says of its work on standard error.
namespace candela::app {

/// While it lives, shows on a terminal what is being done, how far it is and how long it takes:
/// "candela: rendering: 34 %, 12 s, 20 s left". Says nothing where standard error is a file or a pipe, and
/// nothing of work that is over in a moment. The line is gone when it ends, so that other messages stand
/// alone. One at a time.
class ProgressLine {
  public:
    explicit ProgressLine(std::string what);
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    /// From any thread. The time left is that of the pace so far.
    void report(double fraction);
    /// Of a step; each step has its own pace.
    void report(const char* step, double fraction);
    /// For work that knows its own time left; `detail` goes to the end of the line.
    void report(double fraction, std::optional<double> seconds_left, const std::string& detail);

    /// report() as a function; must not outlive the line. Empty where nothing is shown.
    [[nodiscard]] ProgressFunction function();
    [[nodiscard]] StepFunction steps();
    [[nodiscard]] bool shown() const { return terminal_; }

  private:
    using Clock = std::chrono::steady_clock;
    [[nodiscard]] std::string text(double now_s) const;
    [[nodiscard]] double elapsed_s() const;
    void draw();

    std::string what_;
    std::string step_;
    std::string detail_;
    bool terminal_ = false;
    PaceEstimate pace_;
    double step_start_s_ = 0.0;
    std::optional<double> fraction_;
    std::optional<double> own_seconds_left_;
    double reported_s_ = 0.0;
    std::string drawn_;
    Clock::time_point start_ = Clock::now();
    mutable std::mutex mutex_;
    std::condition_variable_any wake_;
    std::jthread ticker_;  ///< last, so that it ends before what it reads
};

/// "candela: wrote FILE", a line a file, on standard error: what a command left behind.
void print_written(std::span<const std::filesystem::path> files);
void print_written(const std::filesystem::path& file);

}  // namespace candela::app
