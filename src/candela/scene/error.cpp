#include "candela/scene/error.hpp"

namespace candela {
namespace {

std::string printable(const std::string& text) {
    constexpr std::size_t longest = 400;
    std::string out;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        out += (byte < 0x20 || byte == 0x7f) ? '?' : c;
        if (out.size() == longest) return out + "...";
    }
    return out;
}

}  // namespace

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
