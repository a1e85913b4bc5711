#pragma once

#include <cstdint>
#include <string>

namespace candela::scene {

/// How much memory a scene may take.
struct MemoryBudget {
    std::uint64_t bytes = 0;
    bool stated = false;  ///< by the user; otherwise what the machine has left

    /// Throws Error (Fault::machine) that says what is needed and what there is.
    void require(std::uint64_t needed_bytes, const std::string& what, const std::string& where) const;
};

/// 7/8 of what the machine can still give this process: the least of MemAvailable (/proc/meminfo), what the
/// limits of its control groups (v2 and v1) leave, and what its address space limit leaves. 8 GiB where
/// nothing says.
[[nodiscard]] MemoryBudget available_memory();

/// "6.2 GiB"
[[nodiscard]] std::string memory_text(std::uint64_t bytes);

/// "512M", "6G", "1.5GiB", "8000000000": powers of 1024. Throws Error (Fault::usage), which names `where`.
[[nodiscard]] MemoryBudget memory_from_text(const std::string& text, const std::string& where);

}  // namespace candela::scene
