#pragma once

#include <optional>

#include "candela/bake/sky_model.hpp"
#include "candela/scene/scene.hpp"

namespace candela::bake {

/// What a clear sky gives to a scene. The sun's disc is a light of its own, so that it casts shadows; it is
/// not in the picture of the sky.
struct Sky {
    scene::Environment environment;
    std::optional<scene::Light> sun;  ///< none below the horizon
};

/// The sky as an environment 2 * height texels wide, row 0 at the zenith, ground below the horizon.
[[nodiscard]] Sky sky_of(const scene::SkySettings& settings, std::uint32_t height = 512);

/// The picture of a model's sky by itself, with the sun at this azimuth from north.
[[nodiscard]] scene::Environment sky_picture(const SkyModel& model, float sun_azimuth_rad,
                                             std::uint32_t height);

/// Towards the sun's centre: north is -Z, east +X.
[[nodiscard]] glm::vec3 sun_direction(const scene::SkySettings& settings);

/// Turns and scales the sun as its environment was: by rotation_rad and scale; it is seen where the
/// environment is.
void follow_environment(scene::Light& sun, const scene::Environment& environment);

}  // namespace candela::bake
