#pragma once

#include <cstdint>
#include <string>

#include "job.hpp"

namespace candela::app {

/// A number for all of a job that its luminance depends on, and for `settings`: equal for the same scene,
/// camera, profile and size, and for nothing else that is likely to happen.
[[nodiscard]] std::uint64_t fingerprint(const Job& job, const std::string& settings);

/// The same of a scene alone, with the places of its probes but not what they hold.
[[nodiscard]] std::uint64_t scene_fingerprint(const scene::Scene& scene, const std::string& settings);

}  // namespace candela::app
