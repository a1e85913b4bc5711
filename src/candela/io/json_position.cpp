#include "candela/io/json_position.hpp"

#include <algorithm>
#include <vector>

namespace candela::io {
namespace {

/// Walks through JSON that has been parsed before, without recursion, and stops at a pointer.
class Finder {
  public:
    Finder(std::string_view text, std::string_view pointer) : text_(text), pointer_(pointer) {}

    std::optional<std::size_t> run() {
        while (skip_blanks()) {
            const char c = text_[at_];
            if (c == '{' || c == '[') {
                if (found_here(at_)) return found_;
                levels_.push_back({c == '{', path_.size(), 0});
                expects_key_ = c == '{';
                ++at_;
                if (c == '[') begin_element();
            } else if (c == '}' || c == ']') {
                if (levels_.empty()) return std::nullopt;
                path_.resize(levels_.back().path_size);
                levels_.pop_back();
                expects_key_ = false;
                ++at_;
            } else if (c == ',') {
                ++at_;
                next_member();
            } else if (c == ':') {
                ++at_;
            } else if (c == '"' && expects_key_) {
                read_key();
                if (path_ == pointer_) return key_at_;
            } else {
                if (found_here(at_)) return found_;
                skip_value();
            }
        }
        return std::nullopt;
    }

  private:
    struct Level {
        bool object;
        std::size_t path_size;
        std::size_t index;
    };

    bool found_here(std::size_t at) {
        found_ = at;
        return path_ == pointer_;
    }
    void begin_element() { path_ += "/" + std::to_string(levels_.back().index); }
    void next_member() {
        if (levels_.empty()) return;
        Level& level = levels_.back();
        path_.resize(level.path_size);
        expects_key_ = level.object;
        if (level.object) return;
        ++level.index;
        begin_element();
    }
    void read_key() {
        key_at_ = at_;
        const std::size_t from = at_ + 1;
        skip_string();
        path_ += "/" + std::string(text_.substr(from, at_ - from - 1));
        expects_key_ = false;
    }
    void skip_string() {
        for (++at_; at_ < text_.size() && text_[at_] != '"'; ++at_)
            if (text_[at_] == '\\') ++at_;
        at_ = std::min(at_ + 1, text_.size());
    }
    void skip_value() {
        if (text_[at_] == '"') return skip_string();
        do {
            ++at_;
        } while (at_ < text_.size() &&
                 std::string_view(",]}/ \t\r\n").find(text_[at_]) == std::string_view::npos);
    }
    /// False at the end.
    bool skip_blanks() {
        while (at_ < text_.size()) {
            if (text_.substr(at_).starts_with("//")) {
                at_ = std::min(text_.find('\n', at_), text_.size());
            } else if (text_.substr(at_).starts_with("/*")) {
                const std::size_t end = text_.find("*/", at_ + 2);
                at_ = end == std::string_view::npos ? text_.size() : end + 2;
            } else if (std::string_view(" \t\r\n\xef\xbb\xbf").find(text_[at_]) != std::string_view::npos) {
                ++at_;
            } else {
                return true;
            }
        }
        return false;
    }

    std::string_view text_;
    std::string_view pointer_;
    std::size_t at_ = 0;
    std::size_t key_at_ = 0;
    std::size_t found_ = 0;
    std::string path_;
    std::vector<Level> levels_;
    bool expects_key_ = false;
};

/// The longest beginning of a pointer that stands in the text: of a missing key, the object that lacks it.
std::optional<TextPosition> nearest_position(std::string_view text, std::string_view pointer) {
    while (!pointer.empty()) {
        if (const auto position = position_in_json(text, pointer)) return position;
        pointer = pointer.substr(0, pointer.rfind('/'));
    }
    return std::nullopt;
}

}  // namespace

TextPosition position_of_byte(std::string_view text, std::size_t byte) {
    const std::string_view before = text.substr(0, std::min(byte, text.size()));
    const std::size_t line_start = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
    const std::string_view line = before.substr(line_start);
    const auto characters =
        std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xc0) != 0x80; });
    return {static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n')) + 1,
            static_cast<std::size_t>(characters) + 1};
}

std::optional<TextPosition> position_in_json(std::string_view text, std::string_view pointer) {
    const std::optional<std::size_t> byte = Finder(text, pointer).run();
    if (!byte) return std::nullopt;
    return position_of_byte(text, *byte);
}

Error with_position(const Error& error, const std::string& file, std::string_view text) {
    const std::string start = file + ": /";
    if (!error.where().starts_with(start)) return error;
    const std::string rest = error.where().substr(file.size() + 2);
    const std::string pointer = rest.substr(0, rest.find(": "));
    const auto position = nearest_position(text, pointer);
    if (!position) return error;
    return {
        error.fault(), error.what(),
        file + ":" + std::to_string(position->line) + ":" + std::to_string(position->column) + ": " + rest,
        error.hint()};
}

}  // namespace candela::io
