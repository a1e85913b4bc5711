#include "candela/scene/diagnostics.hpp"

#include <algorithm>

namespace candela {

void Diagnostics::warn(const std::string& text) {
    const auto same = [&](const Warning& w) { return w.text == text; };
    if (const auto found = std::find_if(warnings_.begin(), warnings_.end(), same); found != warnings_.end()) {
        ++found->count;
    } else {
        warnings_.push_back({text, 1});
    }
}

}  // namespace candela
