#include "candela/scene/diagnostics.hpp"

#include <algorithm>

namespace candela {
namespace {

/// Beyond this many different ones nobody reads them, and a hostile file could raise millions.
constexpr std::size_t kMostKinds = 200;
constexpr const char* kMore = "further warnings, not shown";

}  // namespace

void Diagnostics::raise(const std::string& kind, const std::string& text, std::size_t count) {
    const auto same = [&](const Warning& w) { return w.kind == kind; };
    const auto found = std::find_if(warnings_.begin(), warnings_.end(), same);
    if (found != warnings_.end()) {
        found->count += count;
    } else if (warnings_.size() < kMostKinds) {
        warnings_.push_back({text, count, kind});
    } else if (warnings_.back().kind == kMore) {
        warnings_.back().count += count;
    } else {
        warnings_.push_back({kMore, count, kMore});
    }
}

void Diagnostics::warn(const std::string& text) {
    raise(text, text, 1);
}

void Diagnostics::warn_at(const std::string& place, const std::string& text) {
    raise(text, place + ": " + text, 1);
}

void Diagnostics::add(const Diagnostics& other) {
    for (const Warning& w : other.warnings_) raise(w.kind, w.text, w.count);
}

}  // namespace candela
