#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "candela/scene/diagnostics.hpp"
#include "candela/scene/photometric.hpp"

namespace candela::io::detail {

/// More angles than any goniometer has steps (0.05 degrees all around).
constexpr std::size_t kMostAngles = 7201;
/// Nodes of a file's web; the whole sphere may take four times as many.
constexpr std::size_t kMostNodes = std::size_t{1} << 21;

/// A web as a file has it: its own angles, its own symmetry.
struct FileWeb {
    std::string where;                   ///< "file:line" of its angles, for messages
    std::vector<double> vertical_deg;    ///< ascending
    std::vector<double> horizontal_deg;  ///< ascending; one: the same in all half-planes
    std::vector<double> candela;         ///< [horizontal * vertical_deg.size() + vertical]
};

/// Puts the web into the profile, whole: mirrored as its symmetry asks, dark where it says nothing, and, for
/// types A and B, as seen from type C's angles. Sets the symmetry. Throws Error.
void expand_type_c(const FileWeb& web, Diagnostics& diagnostics, scene::PhotometricProfile& profile);
void convert_type_a_or_b(const FileWeb& web, Diagnostics& diagnostics, scene::PhotometricProfile& profile);

}  // namespace candela::io::detail
