#include "candela/io/photometric_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "candela/io/text_encoding.hpp"

namespace candela::io::detail {
namespace {

bool is_blank(char c) {
    return c == ' ' || c == '\t';
}
bool is_separator(char c, bool decimal_commas) {
    return is_blank(c) || (c == ',' && !decimal_commas);
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
        while (!rest_.empty() && is_separator(rest_.front(), decimal_commas_)) rest_.remove_prefix(1);
        if (!rest_.empty()) return true;
        if (at_end()) return false;
        rest_ = lines_[next_++];
    }
}

std::string_view PhotometricText::word(const char* what) {
    if (!skip_to_word()) throw error(std::string("the file ends before ") + what);
    std::size_t length = 0;
    while (length < rest_.size() && !is_separator(rest_[length], decimal_commas_)) ++length;
    const std::string_view out = rest_.substr(0, length);
    rest_.remove_prefix(length);
    return out;
}

double PhotometricText::number(const char* what) {
    std::string text(word(what));
    if (decimal_commas_) std::replace(text.begin(), text.end(), ',', '.');
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

std::string PhotometricText::rest() const {
    std::string out(rest_);
    for (std::size_t i = next_; i < lines_.size(); ++i) out += '\n' + std::string(lines_[i]);
    return out;
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
