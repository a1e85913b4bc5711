#include "progress_line.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "candela/scene/error.hpp"
#include "candela/scene/printable.hpp"

namespace candela::app {
namespace {

/// Work that ends before is over in a moment.
constexpr double kFirstShown_s = 0.5;
constexpr std::chrono::milliseconds kRedraw{200};

std::size_t terminal_columns() {
    winsize size{};
    const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
    return known ? size.ws_col : 80u;
}

/// A line that is broken in two cannot be taken back: cut before the last column, between characters of
/// UTF-8.
std::string cut(const std::string& text, std::size_t columns) {
    std::size_t characters = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if ((text[i] & 0xc0) == 0x80) continue;
        if (++characters >= columns) return text.substr(0, i);
    }
    return text;
}

}  // namespace

ProgressLine::ProgressLine(std::string what) : what_(std::move(what)), terminal_(isatty(STDERR_FILENO) != 0) {
    if (!terminal_) return;
    ticker_ = std::jthread([this](const std::stop_token& stop) {
        std::unique_lock lock(mutex_);
        while (!wake_.wait_for(lock, stop, kRedraw, [&] { return stop.stop_requested(); })) draw();
    });
}

ProgressLine::~ProgressLine() {
    if (!terminal_) return;
    ticker_.request_stop();
    ticker_.join();
    if (!drawn_.empty()) std::fprintf(stderr, "\r\033[K");
}

double ProgressLine::elapsed_s() const {
    return std::chrono::duration<double>(Clock::now() - start_).count();
}

void ProgressLine::report(double fraction) {
    if (!terminal_) return;
    const std::lock_guard lock(mutex_);
    pace_.add(elapsed_s() - step_start_s_, fraction);
    fraction_ = pace_.fraction();
}

void ProgressLine::report(const char* step, double fraction) {
    if (!terminal_) return;
    {
        const std::lock_guard lock(mutex_);
        if (step_ != step) {
            step_ = step;
            pace_ = {};
            step_start_s_ = elapsed_s();
        }
    }
    report(fraction);
}

void ProgressLine::report(double fraction, std::optional<double> seconds_left, const std::string& detail) {
    if (!terminal_) return;
    const std::lock_guard lock(mutex_);
    fraction_ = fraction;
    own_seconds_left_ = seconds_left;
    detail_ = detail;
    reported_s_ = elapsed_s();
}

ProgressFunction ProgressLine::function() {
    if (!terminal_) return {};
    return [this](double fraction) { report(fraction); };
}

StepFunction ProgressLine::steps() {
    if (!terminal_) return {};
    return [this](const char* step, double fraction) { report(step, fraction); };
}

std::string ProgressLine::text(double now_s) const {
    std::string out = "candela: " + what_ + (step_.empty() ? "" : ", " + step_) + ": ";
    if (fraction_) {
        char percent[16];
        std::snprintf(percent, sizeof(percent), "%.0f %%, ", 100.0 * std::clamp(*fraction_, 0.0, 1.0));
        out += percent;
    }
    out += duration_text(now_s);
    std::optional<double> left_s = pace_.seconds_left(now_s - step_start_s_);
    if (own_seconds_left_) left_s = std::max(*own_seconds_left_ - (now_s - reported_s_), 0.0);
    if (left_s) out += ", " + duration_text(*left_s) + " left";
    if (!detail_.empty()) out += ", " + detail_;
    return out;
}

void ProgressLine::draw() {
    const double now_s = elapsed_s();
    if (now_s < kFirstShown_s) return;
    const std::string line = cut(text(now_s), terminal_columns());
    if (line == drawn_) return;
    drawn_ = line;
    std::fprintf(stderr, "\r\033[K%s", line.c_str());
    std::fflush(stderr);
}

void print_written(std::span<const std::filesystem::path> files) {
    for (const std::filesystem::path& file : files)
        std::fprintf(stderr, "candela: wrote %s\n", printable(file.string()).c_str());
}

void print_written(const std::filesystem::path& file) {
    print_written(std::span(&file, 1));
}

}  // namespace candela::app
