#pragma once

#include <filesystem>

#include "candela/truth/film.hpp"

namespace candela::truth {

/// Keeps a film so that the same command can go on with it: written whole or not at all.
void save_checkpoint(const std::filesystem::path& file, const Film& film, std::uint64_t fingerprint);

enum class CheckpointState : std::uint8_t {
    absent,
    loaded,
    other  ///< of another job, or damaged
};

/// Fills `film` from a checkpoint of the same size, layout and fingerprint, and else leaves it as it is.
/// Throws Error (Fault::input) for a file that is no checkpoint at all: it is somebody's, and would be
/// replaced.
[[nodiscard]] CheckpointState load_checkpoint(const std::filesystem::path& file, std::uint64_t fingerprint,
                                              Film& film);

}  // namespace candela::truth
