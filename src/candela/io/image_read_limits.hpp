#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "candela/scene/memory_budget.hpp"

/// What a picture may claim before memory is taken for it.
namespace candela::io::detail {

inline constexpr std::uint32_t max_side_texels = 16384;
inline constexpr std::uint64_t max_texels = std::uint64_t{1} << 28;

/// Memory that an environment of this many texels takes while it is read and searched for a sun; converting a
/// cube or another layout takes no more than that again.
[[nodiscard]] constexpr std::uint64_t environment_bytes(std::uint64_t texels) {
    return 20 * texels;
}

/// Throws Error (Fault::machine) when a picture of light would take more than the budget; none: no limit.
void check_memory(std::uint64_t width, std::uint64_t height, const std::optional<scene::MemoryBudget>& memory,
                  const std::string& where);

/// The size of a regular file in bytes. Throws Error (Fault::input) for a missing one, a folder, a device.
std::uint64_t check_readable(const std::filesystem::path& file);

/// Throws Error (Fault::input) for an empty picture and for one beyond max_side_texels or max_texels.
void check_size(std::uint64_t width, std::uint64_t height, const std::string& where);

/// Throws Error (Fault::input) when a picture claims more than file_bytes can hold: `most_per_byte` is the
/// best ratio of the coding, in the unit of `claimed`.
void check_claim(std::uint64_t claimed, std::uint64_t file_bytes, std::uint64_t most_per_byte,
                 const std::string& where);

}  // namespace candela::io::detail
