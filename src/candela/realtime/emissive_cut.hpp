#pragma once

#include <vector>

#include "candela/realtime/emissive_groups.hpp"

namespace candela::realtime {

/// What cut emitters may give together at any surface, as a fraction of the environment's illuminance: half a
/// step of an 8-bit picture.
inline constexpr float kCutFraction = 1.0f / 128.0f;

/// Which groups light no surface of the scene to speak of (false), as the emissive parts of a convex body or
/// indicators of a device in daylight: the sum of their largest illuminances stays below kCutFraction of the
/// mean illuminance of the environment. Illuminances are without occlusion, at the point of each triangle
/// that is nearest to the group; scenes of more than 16,384 triangles are sampled. Nothing is cut without an
/// environment, or where irradiance volumes keep it out of rooms. Highlights of what is cut are lost too.
[[nodiscard]] std::vector<bool> emitters_that_matter(const scene::Scene& scene,
                                                     const std::vector<EmissiveGroup>& groups);

}  // namespace candela::realtime
