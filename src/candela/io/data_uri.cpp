#include "candela/io/data_uri.hpp"

#include <cctype>
#include <cstdint>

#include "candela/io/percent_encoding.hpp"
#include "candela/scene/error.hpp"

namespace candela::io {
namespace {

constexpr int kBroken = -1, kBlank = -2;

int sextet_of(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+' || c == '-') return 62;
    if (c == '/' || c == '_') return 63;
    return std::isspace(static_cast<unsigned char>(c)) ? kBlank : kBroken;
}

/// Without the '=' at its end.
std::string_view unpadded(std::string_view text, const std::string& where) {
    while (!text.empty() && sextet_of(text.back()) == kBlank) text.remove_suffix(1);
    const std::size_t padding = text.find('=');
    if (padding == std::string_view::npos) return text;
    const std::string_view tail = text.substr(padding);
    if (tail.size() > 2 || tail.find_first_not_of('=') != std::string_view::npos)
        throw input_error("broken base64 data", where);
    return text.substr(0, padding);
}

std::vector<std::byte> decode_base64(std::string_view text, const std::string& where,
                                     PlacedWarnings& warnings) {
    text = unpadded(text, where);
    std::vector<std::byte> out;
    out.reserve(text.size() / 4 * 3);
    std::uint32_t bits = 0;
    int count = 0;
    std::size_t letters = 0;
    bool blanks = false, url_safe = false;
    for (const char c : text) {
        const int value = sextet_of(c);
        if (value == kBroken) throw input_error("broken base64 data", where);
        blanks = blanks || value == kBlank;
        if (value == kBlank) continue;
        url_safe = url_safe || c == '-' || c == '_';
        ++letters;
        bits = bits << 6 | static_cast<std::uint32_t>(value);
        count += 6;
        if (count >= 8) {
            count -= 8;
            out.push_back(static_cast<std::byte>(bits >> count & 0xff));
        }
    }
    if (letters % 4 == 1) throw input_error("truncated base64 data", where);
    if (blanks) warnings.warn_at(where, "base64 data with line breaks or blanks: they are skipped");
    if (url_safe) warnings.warn_at(where, "base64 data in the URL-safe alphabet: read as base64");
    return out;
}

}  // namespace

std::vector<std::byte> decode_data_uri(std::string_view uri, const std::string& where,
                                       PlacedWarnings& warnings) {
    const std::size_t comma = uri.find(',');
    if (comma == std::string_view::npos) throw input_error("data URI without data", where);
    const std::string_view head = uri.substr(0, comma), data = uri.substr(comma + 1);
    if (head.find("base64") != std::string_view::npos) {
        // A browser decodes the percent signs first.
        const bool encoded = data.find('%') != std::string_view::npos;
        return decode_base64(encoded ? percent_decoded(data) : std::string(data), where, warnings);
    }
    const std::string bytes = percent_decoded(data);
    const auto* first = reinterpret_cast<const std::byte*>(bytes.data());
    return {first, first + bytes.size()};
}

}  // namespace candela::io
