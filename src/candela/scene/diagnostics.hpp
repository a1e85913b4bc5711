#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace candela {

/// Collects warnings: each text once, with the number of times it was raised. Not thread-safe; one per job.
class Diagnostics {
  public:
    struct Warning {
        std::string text;
        std::size_t count = 0;
    };

    /// Raises a warning; `text` is its identity, so keep indices out of it where a file may raise it a
    /// thousand times.
    void warn(const std::string& text);

    [[nodiscard]] const std::vector<Warning>& warnings() const noexcept { return warnings_; }

  private:
    std::vector<Warning> warnings_;
};

}  // namespace candela
