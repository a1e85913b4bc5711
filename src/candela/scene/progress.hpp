#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace candela {

/// What long work calls with the fraction of it that is done, in [0,1]; from any thread, one at a time.
using ProgressFunction = std::function<void(double fraction)>;

/// The same for work of several steps: the step's name, and the fraction of this step.
using StepFunction = std::function<void(const char* step, double fraction)>;

/// Estimates the time left from the fractions that were reported so far, by the pace of the later half of the
/// time: what is slow once, such as compiling shaders before the first sample, is forgotten.
class PaceEstimate {
  public:
    /// Both non-decreasing.
    void add(double elapsed_s, double fraction);
    /// Nothing before the first progress. Counts down to the next report, and grows when that is overdue.
    [[nodiscard]] std::optional<double> seconds_left(double elapsed_s) const;
    [[nodiscard]] double fraction() const { return reports_.empty() ? 0.0 : reports_.back().fraction; }

  private:
    struct Report {
        double elapsed_s = 0.0;
        double fraction = 0.0;
    };
    std::vector<Report> reports_;
};

/// "8 s", "3 min 05 s", "2 h 10 min": as people say how long something takes. Negative numbers count as 0.
[[nodiscard]] std::string duration_text(double seconds);

}  // namespace candela
