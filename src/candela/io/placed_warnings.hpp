#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "candela/scene/diagnostics.hpp"

namespace candela::io {

/// Warnings about places of a file: however many places raise the same text, it is one warning that names the
/// first of them. Not thread-safe; one for each reader.
class PlacedWarnings {
  public:
    /// `place`: file, or file plus JSON pointer. `text`: what is wrong there and how it is read instead.
    void warn_at(const std::string& place, const std::string& text);
    /// Takes over those of another one.
    void add(const PlacedWarnings& other);
    /// Hands them to the job, with their numbers.
    void raise(Diagnostics& diagnostics) const;

  private:
    struct Kind {
        std::string text;
        std::string place;  ///< the first
        std::size_t count = 0;
    };
    void add(const Kind& kind);
    std::vector<Kind> kinds_;
};

}  // namespace candela::io
