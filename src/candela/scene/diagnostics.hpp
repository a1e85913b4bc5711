#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace candela {

/// Collects warnings: each text once, with the number of times it was raised. Not thread-safe; one per job.
class Diagnostics {
  public:
    struct Warning {
        std::string text;  ///< with the first place that raised it
        std::size_t count = 0;
        std::string kind;  ///< what makes two warnings the same
    };

    /// Raises a warning; `text` is its identity, so keep indices out of it where a file may raise it a
    /// thousand times.
    void warn(const std::string& text);
    /// The same for something at `place` (file, file plus JSON pointer): however many places raise `text`, it
    /// is one warning that names the first of them.
    void warn_at(const std::string& place, const std::string& text);
    /// Raises the warnings of another one again.
    void add(const Diagnostics& other);

    [[nodiscard]] const std::vector<Warning>& warnings() const noexcept { return warnings_; }

  private:
    void raise(const std::string& kind, const std::string& text, std::size_t count);
    std::vector<Warning> warnings_;
};

}  // namespace candela
