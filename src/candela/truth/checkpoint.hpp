#pragma once

#include <filesystem>

#include "candela/truth/film.hpp"

namespace candela::truth {

/// Keeps a film so that the same command can go on with it: written whole or not at all.
void save_checkpoint(const std::filesystem::path& file, const Film& film, std::uint64_t fingerprint);

/// Fills `film` from a checkpoint of the same size, layout and fingerprint; false, and `film` untouched, when
/// there is none or it is of something else or damaged.
[[nodiscard]] bool load_checkpoint(const std::filesystem::path& file, std::uint64_t fingerprint, Film& film);

}  // namespace candela::truth
