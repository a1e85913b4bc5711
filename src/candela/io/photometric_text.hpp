#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "candela/scene/error.hpp"

/// What the two photometric formats share: numbered lines and the numbers in them.
namespace candela::io::detail {

/// The file as UTF-8 (files that are not are taken for Latin-1, as luminaire makers' umlauts and degree signs
/// are), without byte order mark, cut at the end-of-file character of DOS.
[[nodiscard]] std::string photometric_utf8(std::string_view bytes);

[[nodiscard]] std::string_view trimmed(std::string_view text);

/// A finite number with nothing behind it; a leading + is allowed.
[[nodiscard]] std::optional<double> parsed_number(std::string_view text);

class PhotometricText {
  public:
    PhotometricText(std::string text, std::string where);
    PhotometricText(const PhotometricText&) = delete;
    PhotometricText& operator=(const PhotometricText&) = delete;

    [[nodiscard]] bool at_end() const noexcept { return next_ >= lines_.size(); }
    /// The next line, without blanks around it. Throws at the end of the file; `what` says what is missing.
    [[nodiscard]] std::string_view line(const char* what);
    /// The next line, still to be read; empty at the end.
    [[nodiscard]] std::string_view peek() const;

    /// The next number of a free-form list: separated by blanks, commas or line ends.
    [[nodiscard]] double number(const char* what);
    /// The same as a count from `least` to `most`.
    [[nodiscard]] std::size_t count(const char* what, std::size_t least, std::size_t most);
    /// How many bytes are not read yet: an upper bound for what a hostile count can be true of.
    [[nodiscard]] std::size_t bytes_left() const noexcept;
    /// What is not read yet, line by line.
    [[nodiscard]] std::string rest() const;
    /// From here on a comma in a number is its decimal point, and separates no numbers.
    void read_decimal_commas() noexcept { decimal_commas_ = true; }
    /// Words left over on the current line and after it.
    [[nodiscard]] bool words_left();

    /// An error at the line that was read last.
    [[nodiscard]] Error error(const std::string& what, const std::string& hint = {}) const;
    /// "file:line" of the line that was read last.
    [[nodiscard]] std::string place() const;
    [[nodiscard]] const std::string& where() const noexcept { return where_; }

  private:
    [[nodiscard]] std::string_view word(const char* what);
    [[nodiscard]] bool skip_to_word();

    std::string text_;
    std::string where_;
    std::vector<std::string_view> lines_;
    std::size_t next_ = 0;   ///< line to read next
    std::string_view rest_;  ///< of the line before it, for number()
    bool decimal_commas_ = false;
};

}  // namespace candela::io::detail
