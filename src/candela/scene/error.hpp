#pragma once

#include <stdexcept>
#include <string>

namespace candela {

/// Whose fault an error is; the values are the process exit codes of the command line.
enum class Fault { input = 1, usage = 2, machine = 3 };

/// The one exception type of Candela: what went wrong, where (file, file plus JSON pointer, or file:line),
/// and what to do about it. Caught once, in main.
class Error : public std::runtime_error {
  public:
    Error(Fault fault, std::string what, std::string where = {}, std::string hint = {});

    [[nodiscard]] Fault fault() const noexcept { return fault_; }
    [[nodiscard]] const std::string& where() const noexcept { return where_; }
    [[nodiscard]] const std::string& hint() const noexcept { return hint_; }

    /// One line: "where: what (hint)", with control characters of hostile names made visible.
    [[nodiscard]] std::string line() const;

  private:
    Fault fault_;
    std::string where_;
    std::string hint_;
};

[[nodiscard]] inline Error input_error(std::string what, std::string where, std::string hint = {}) {
    return {Fault::input, std::move(what), std::move(where), std::move(hint)};
}
[[nodiscard]] inline Error machine_error(std::string what, std::string where = {}, std::string hint = {}) {
    return {Fault::machine, std::move(what), std::move(where), std::move(hint)};
}

}  // namespace candela
