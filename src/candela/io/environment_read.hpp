#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "candela/scene/diagnostics.hpp"
#include "candela/scene/environment_resample.hpp"
#include "candela/scene/memory_budget.hpp"
#include "candela/scene/progress.hpp"
#include "candela/scene/scene.hpp"

namespace candela::io {

/// How one picture shows all directions. Cubes of KTX 2 and DDS files say so themselves.
enum class EnvironmentLayout : std::uint8_t {
    automatic,  ///< by the ratio of the sides: 4:3 and 3:4 are crosses, 1:1 octahedral, all else
                ///< equirectangular
    equirect,   ///< shading/environment.glsl
    cross,  ///< the faces of a cube unfolded, 4 x 3 or 3 x 4 of them (the last upside down), +Z in the middle
    octahedral,  ///< scene::equirect_from_octahedral
    angular,     ///< scene::CircleProjection
    mirror_ball,
};

/// What becomes of negative values.
enum class NegativeTexels : std::uint8_t {
    clamp,   ///< scene::clamp_negative
    spread,  ///< scene::spread_negative
};

struct EnvironmentOptions {
    EnvironmentLayout layout = EnvironmentLayout::automatic;
    /// Of cubes; none: what the file says, else pictures seen from inside.
    std::optional<scene::CubeSpace> cube_space;
    NegativeTexels negative = NegativeTexels::clamp;
    std::optional<scene::MemoryBudget> memory;  ///< that the picture may take; absent: what the machine has
    std::string layer;          ///< of an EXR file, or its part; empty: detail::choose_exr_picture
    ProgressFunction progress;  ///< of decoding; of .hdr and of EXR in scan lines
};

/// What a file holds, as a picture.
struct ReadEnvironment : scene::Environment {
    bool absolute = false;  ///< the file says that its values are cd/m^2, as whiteLuminance of EXR does
};

/// "auto", "equirect", "cross", "octahedral", "angular", "mirror-ball"; none for another name.
[[nodiscard]] std::optional<EnvironmentLayout> layout_by_name(const std::string& name);
/// "picture", "direct"; none for another name.
[[nodiscard]] std::optional<scene::CubeSpace> cube_space_by_name(const std::string& name);

/// Reads distant light as luminance in cd/m^2 into an equirectangular picture: .hdr, .exr, .ktx2 and .dds by
/// content, and .png, .jpg and .webp (white is 1; a warning); a folder that holds the six faces of a cube; or
/// the name of one face with {face} where px, nx, py, ny, pz, nz (or posx..., or right, left, top, bottom,
/// front, back) stand. NaN becomes 0, infinity the largest finite value of the picture, and negative values
/// what `options` say, with a warning of what that does to the up-facing illuminance; nothing else is
/// clamped. Throws Error (Fault::input; Fault::machine for what takes more memory than `options` allow).
[[nodiscard]] ReadEnvironment read_environment(const std::filesystem::path& file, Diagnostics& diagnostics,
                                               const EnvironmentOptions& options = {});

}  // namespace candela::io
