#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "candela/scene/diagnostics.hpp"
#include "candela/scene/environment_resample.hpp"
#include "candela/scene/scene.hpp"

namespace candela::io {

/// How one picture shows all directions. Cubes of KTX 2 and DDS files say so themselves.
enum class EnvironmentLayout : std::uint8_t {
    automatic,  ///< by the ratio of the sides: 4:3 and 3:4 are crosses, 1:1 octahedral, all else
                ///< equirectangular
    equirect,   ///< shading/environment.glsl
    cross,  ///< the faces of a cube unfolded, 4 x 3 or 3 x 4 of them (the last upside down), +Z in the middle
    octahedral,  ///< scene::equirect_from_octahedral
};

struct EnvironmentOptions {
    EnvironmentLayout layout = EnvironmentLayout::automatic;
    /// Of cubes; none: what the file says, else pictures seen from inside.
    std::optional<scene::CubeSpace> cube_space;
};

/// "auto", "equirect", "cross", "octahedral"; none for another name.
[[nodiscard]] std::optional<EnvironmentLayout> layout_by_name(const std::string& name);
/// "picture", "direct"; none for another name.
[[nodiscard]] std::optional<scene::CubeSpace> cube_space_by_name(const std::string& name);

/// Reads distant light as luminance in cd/m^2 into an equirectangular picture: .hdr, .exr, .ktx2 and .dds by
/// content; a folder that holds the six faces of a cube; or the name of one face with {face} where px, nx,
/// py, ny, pz, nz (or posx..., or right, left, top, bottom, front, back) stand. NaN and negative texels
/// become 0 with a warning, infinite ones are the largest finite value of the picture; nothing else is
/// clamped. Throws Error (Fault::input).
[[nodiscard]] scene::Environment read_environment(const std::filesystem::path& file, Diagnostics& diagnostics,
                                                  const EnvironmentOptions& options = {});

}  // namespace candela::io
