#include "candela/scene/error.hpp"

#include <algorithm>

#include "candela/scene/printable.hpp"

namespace candela {
namespace {

/// Bytes of the UTF-8 character at the beginning, 0 when it is none.
std::size_t utf8_length(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char first = byte(0);
    if (first < 0x80) return 1;
    const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    if (first < 0xc2 || first > 0xf4 || text.size() < length) return 0;
    for (std::size_t i = 1; i < length; ++i)
        if ((byte(i) & 0xc0) != 0x80) return 0;
    // The control characters of Latin-1, which terminals obey too.
    return first == 0xc2 && byte(1) < 0xa0 ? 0 : length;
}

}  // namespace

std::string printable(std::string_view text) {
    constexpr std::size_t longest = 400;
    std::string out;
    while (!text.empty()) {
        const auto first = static_cast<unsigned char>(text.front());
        const std::size_t length = utf8_length(text);
        const bool control = first < 0x20 || first == 0x7f;
        out += control || length == 0 ? "?" : text.substr(0, length);
        text.remove_prefix(std::max<std::size_t>(length, 1));
        if (out.size() >= longest && !text.empty()) return out + "...";
    }
    return out;
}

Error::Error(Fault fault, std::string what, std::string where, std::string hint)
    : std::runtime_error(std::move(what)), fault_(fault), where_(std::move(where)), hint_(std::move(hint)) {}

std::string Error::line() const {
    std::string text;
    if (!where_.empty()) text += printable(where_) + ": ";
    text += printable(what());
    if (!hint_.empty()) text += " (" + printable(hint_) + ")";
    return text;
}

}  // namespace candela
