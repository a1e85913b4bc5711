#include "candela/io/placed_warnings.hpp"

#include <algorithm>

namespace candela::io {
namespace {

/// Beyond this many different ones nobody reads them, and a hostile file could raise millions.
constexpr std::size_t kMostKinds = 100;
constexpr std::size_t kMostCounted = 100000;
constexpr const char* kMore = "further warnings, which are not shown";

}  // namespace

void PlacedWarnings::add(const Kind& kind) {
    const auto same = [&](const Kind& k) { return k.text == kind.text; };
    const auto found = std::find_if(kinds_.begin(), kinds_.end(), same);
    if (found != kinds_.end()) {
        found->count = std::min(found->count + kind.count, kMostCounted);
    } else if (kinds_.size() < kMostKinds) {
        kinds_.push_back(kind);
    } else if (kind.text != kMore) {
        add({kMore, kind.place, kind.count});
    } else {
        kinds_.push_back(kind);
    }
}

void PlacedWarnings::warn_at(const std::string& place, const std::string& text) {
    add({text, place, 1});
}

void PlacedWarnings::add(const PlacedWarnings& other) {
    for (const Kind& kind : other.kinds_) add(kind);
}

void PlacedWarnings::raise(Diagnostics& diagnostics) const {
    for (const Kind& kind : kinds_) {
        for (std::size_t i = 0; i < kind.count; ++i) diagnostics.warn(kind.place + ": " + kind.text);
    }
}

}  // namespace candela::io
