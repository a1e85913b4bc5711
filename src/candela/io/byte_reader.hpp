#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>

#include "candela/scene/error.hpp"

namespace candela::io::detail {

/// Little-endian numbers anywhere in the bytes of a file, never past their end.
class ByteReader {
  public:
    /// `kind` and `where` are for messages: "broken KTX 2 texture" of this file.
    ByteReader(std::span<const std::byte> bytes, std::string kind, std::string where)
        : bytes_(bytes), kind_(std::move(kind)), where_(std::move(where)) {}

    [[nodiscard]] std::uint32_t u32(std::uint64_t at) const { return static_cast<std::uint32_t>(get(at, 4)); }
    [[nodiscard]] std::uint64_t u64(std::uint64_t at) const { return get(at, 8); }
    [[nodiscard]] std::span<const std::byte> part(std::uint64_t at, std::uint64_t count) const {
        if (count > bytes_.size() || at > bytes_.size() - count) throw broken("the data ends too early");
        return bytes_.subspan(at, count);
    }
    [[nodiscard]] std::uint64_t size() const noexcept { return bytes_.size(); }
    [[nodiscard]] const std::string& where() const noexcept { return where_; }
    [[nodiscard]] Error broken(const std::string& why) const {
        return input_error("broken " + kind_ + ": " + why, where_);
    }

  private:
    [[nodiscard]] std::uint64_t get(std::uint64_t at, std::uint64_t count) const {
        std::uint64_t value = 0;
        const std::span<const std::byte> from = part(at, count);
        for (std::size_t i = 0; i < count; ++i) value |= std::to_integer<std::uint64_t>(from[i]) << 8 * i;
        return value;
    }

    std::span<const std::byte> bytes_;
    std::string kind_;
    std::string where_;
};

}  // namespace candela::io::detail
