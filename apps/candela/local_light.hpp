#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "job.hpp"

namespace candela::app {

/// What fills the probes of a stage.
struct LocalLightOptions {
    std::uint32_t samples = 2048;  ///< paths of each probe of a volume
    std::uint32_t passes = 3;      ///< of reflection probes
    bool refresh = false;          ///< do not look into the cache
};

/// Where and whence.
struct LocalLightReport {
    std::filesystem::path file;  ///< of the cache; empty: kept nowhere
    bool cached = false;         ///< it was there
    double seconds = 0.0;
};

/// Fills the job's irradiance volumes by path tracing, or from the user's cache if the same scene was baked
/// with the same settings. Does nothing for a job without volumes, or with filled ones.
LocalLightReport fill_irradiance_volumes(Job& job, const LocalLightOptions& options);

/// Has the job's reflection probes take their pictures on the device, or finds them in the cache.
LocalLightReport fill_reflection_probes(const gpu::Device& device, Job& job,
                                        const realtime::ShadowOptions& shadows,
                                        const LocalLightOptions& options);

/// Writes what each reflection probe sees into a folder, which is made if missing, and returns the files:
/// PROBE.png, equirectangular, its colour above, exposed for the picture's own mean, and below where it sees
/// anything but sky.
std::vector<std::filesystem::path> write_probe_pictures(const Job& job, const std::filesystem::path& folder);

/// Both, in this order: the probes see the volumes' light.
void fill_local_light(const gpu::Device& device, Job& job, const realtime::ShadowOptions& shadows);

}  // namespace candela::app
