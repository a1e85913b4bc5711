#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace candela::io::detail {

/// Little-endian bytes, whatever the machine.
class ByteWriter {
  public:
    void u16(std::uint16_t value) { put(value, 2); }
    void u32(std::uint32_t value) { put(value, 4); }
    void u64(std::uint64_t value) { put(value, 8); }
    void f32(float value) {
        std::uint32_t bits = 0;
        std::memcpy(&bits, &value, sizeof(bits));
        u32(bits);
    }
    void text(const std::string& value) {
        std::transform(value.begin(), value.end(), std::back_inserter(bytes_),
                       [](char c) { return static_cast<std::byte>(c); });
    }
    void align(std::size_t to) {
        while (bytes_.size() % to != 0) bytes_.push_back(std::byte{0});
    }
    /// Overwrites what was written at `at`.
    void u32_at(std::size_t at, std::uint32_t value) { put_at(at, value, 4); }
    void u64_at(std::size_t at, std::uint64_t value) { put_at(at, value, 8); }

    [[nodiscard]] std::size_t size() const noexcept { return bytes_.size(); }
    [[nodiscard]] std::vector<std::byte> take() { return std::move(bytes_); }

  private:
    void put(std::uint64_t value, int count) {
        for (int i = 0; i < count; ++i) bytes_.push_back(static_cast<std::byte>(value >> 8 * i & 0xffu));
    }
    void put_at(std::size_t at, std::uint64_t value, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i)
            bytes_[at + i] = static_cast<std::byte>(value >> 8 * i & 0xffu);
    }

    std::vector<std::byte> bytes_;
};

}  // namespace candela::io::detail
