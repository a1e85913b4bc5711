#include "candela/io/photometric_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace candela::io::detail {
namespace {

bool is_blank(char c) {
    return c == ' ' || c == '\t';
}
bool is_separator(char c) {
    return is_blank(c) || c == ',';
}

/// How many bytes follow the first one of a UTF-8 sequence; none for a byte that starts no sequence.
std::optional<std::size_t> continuation_bytes(unsigned char first) {
    if (first < 0x80) return 0;
    if (first >= 0xc2 && first < 0xe0) return 1;
    if (first >= 0xe0 && first < 0xf0) return 2;
    if (first >= 0xf0 && first < 0xf5) return 3;
    return std::nullopt;
}

bool is_utf8(std::string_view text) {
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto more = continuation_bytes(static_cast<unsigned char>(text[i]));
        if (!more || *more > text.size() - i - 1) return false;
        for (std::size_t k = 0; k < *more; ++k) {
            if ((static_cast<unsigned char>(text[++i]) & 0xc0) != 0x80) return false;
        }
    }
    return true;
}

std::string from_latin1(std::string_view text) {
    std::string out;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x80) {
            out += c;
        } else {
            out += static_cast<char>(0xc0 | (byte >> 6));
            out += static_cast<char>(0x80 | (byte & 0x3f));
        }
    }
    return out;
}

std::string shown(std::string_view text) {
    constexpr std::size_t longest = 40;
    return '"' + std::string(text.substr(0, longest)) + (text.size() > longest ? "...\"" : "\"");
}

}  // namespace

std::string photometric_utf8(std::string_view bytes) {
    constexpr std::string_view mark = "\xef\xbb\xbf";
    constexpr char dos_end_of_file = 0x1a;
    if (bytes.starts_with(mark)) bytes.remove_prefix(mark.size());
    bytes = bytes.substr(0, bytes.find(dos_end_of_file));
    std::string out = is_utf8(bytes) ? std::string(bytes) : from_latin1(bytes);
    // Names go into SVG, which has no control characters.
    const auto is_control = [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return (byte < 0x20 && c != '\t' && c != '\n' && c != '\r') || byte == 0x7f;
    };
    std::replace_if(out.begin(), out.end(), is_control, ' ');
    return out;
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
}

std::optional<double> parsed_number(std::string_view text) {
    text = trimmed(text);
    if (text.starts_with('+')) text.remove_prefix(1);
    double value = 0.0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (fault != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
        return std::nullopt;
    return value;
}

PhotometricText::PhotometricText(std::string text, std::string where)
    : text_(std::move(text)), where_(std::move(where)) {
    std::string_view left = text_;
    while (!left.empty()) {
        // Lines end with LF, CR LF, or, in files from old Macintoshes, CR.
        const std::size_t end = left.find_first_of("\r\n");
        lines_.push_back(left.substr(0, end));
        if (end == std::string_view::npos) break;
        const bool two = left[end] == '\r' && end + 1 < left.size() && left[end + 1] == '\n';
        left.remove_prefix(end + (two ? 2 : 1));
    }
}

std::string_view PhotometricText::line(const char* what) {
    if (at_end()) throw error(std::string("the file ends before ") + what);
    rest_ = {};
    return trimmed(lines_[next_++]);
}

std::string_view PhotometricText::peek() const {
    return at_end() ? std::string_view() : trimmed(lines_[next_]);
}

bool PhotometricText::skip_to_word() {
    while (true) {
        while (!rest_.empty() && is_separator(rest_.front())) rest_.remove_prefix(1);
        if (!rest_.empty()) return true;
        if (at_end()) return false;
        rest_ = lines_[next_++];
    }
}

std::string_view PhotometricText::word(const char* what) {
    if (!skip_to_word()) throw error(std::string("the file ends before ") + what);
    std::size_t length = 0;
    while (length < rest_.size() && !is_separator(rest_[length])) ++length;
    const std::string_view out = rest_.substr(0, length);
    rest_.remove_prefix(length);
    return out;
}

double PhotometricText::number(const char* what) {
    const std::string_view text = word(what);
    const std::optional<double> value = parsed_number(text);
    if (!value) throw error(shown(text) + " is no number for " + what);
    return *value;
}

std::size_t PhotometricText::count(const char* what, std::size_t least, std::size_t most) {
    const double value = number(what);
    if (value != std::floor(value) || value < double(least) || value > double(most))
        throw error(std::string(what) + " must be a whole number from " + std::to_string(least) + " to " +
                    std::to_string(most));
    return static_cast<std::size_t>(value);
}

std::size_t PhotometricText::bytes_left() const noexcept {
    if (at_end()) return rest_.size();
    return rest_.size() + static_cast<std::size_t>(text_.data() + text_.size() - lines_[next_].data());
}

bool PhotometricText::words_left() {
    return skip_to_word();
}

std::string PhotometricText::place() const {
    return where_ + ":" + std::to_string(std::max<std::size_t>(next_, 1));
}

Error PhotometricText::error(const std::string& what, const std::string& hint) const {
    return input_error(what, place(), hint);
}

}  // namespace candela::io::detail
