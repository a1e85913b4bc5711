#pragma once

#include <algorithm>
#include <cstdint>
#include <thread>
#include <vector>

namespace candela::measure {

/// Calls body(first_row, end_row) on disjoint bands that cover [0, height), one a hardware thread. Bands
/// never share an output, so results do not depend on how many there are. `body` must not throw.
template <class Body>
void for_row_bands(std::uint32_t height, const Body& body) {
    constexpr std::uint32_t fewest_rows = 16;  // below, starting a thread costs more than the rows
    const std::uint32_t threads =
        std::clamp(height / fewest_rows, 1u, std::max(std::thread::hardware_concurrency(), 1u));
    std::vector<std::jthread> workers;
    for (std::uint32_t i = 1; i < threads; ++i) {
        workers.emplace_back(
            [&body, first = std::uint32_t(std::uint64_t{height} * i / threads),
             end = std::uint32_t(std::uint64_t{height} * (i + 1) / threads)] { body(first, end); });
    }
    body(0, height / threads);
}

}  // namespace candela::measure
