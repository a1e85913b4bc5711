#include "local_light.hpp"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <span>
#include <sstream>

#include "candela/io/image_read.hpp"
#include "candela/io/image_write.hpp"
#include "candela/io/probe_file.hpp"
#include "candela/measure/path_model.hpp"
#include "candela/realtime/probe_capture.hpp"
#include "candela/scene/error.hpp"
#include "candela/truth/irradiance_bake.hpp"
#include "candela/truth/volume_survey.hpp"
#include "fingerprint.hpp"
#include "path_mode.hpp"
#include "progress_line.hpp"

namespace candela::app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kLargestFile = std::size_t{1} << 30;

std::filesystem::path cache_file(std::uint64_t key, const char* ending) {
    const std::filesystem::path folder = gpu::user_cache_folder();
    if (folder.empty()) return {};
    char name[40];
    std::snprintf(name, sizeof(name), "%016llx.%s", static_cast<unsigned long long>(key), ending);
    return folder / "probes" / name;
}

/// What the cache has; anything that is wrong with it is the same as nothing.
std::string read_cache(const std::filesystem::path& file) {
    std::error_code none;
    if (file.empty() || !std::filesystem::is_regular_file(file, none)) return {};
    try {
        const std::vector<std::byte> bytes = io::read_file(file, kLargestFile);
        return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    } catch (const Error&) {
        return {};
    }
}

/// A cache that cannot be written only costs time.
void write_cache(std::filesystem::path& file, const std::string& bytes) {
    if (file.empty()) return;
    std::error_code ignored;
    std::filesystem::create_directories(file.parent_path(), ignored);
    try {
        io::write_file(file, std::as_bytes(std::span(bytes)));
    } catch (const Error&) {
        file.clear();
    }
}

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// In a share of a hundred, of what a warning tells.
std::string percent(double share) {
    return std::to_string(std::lround(100.0 * share)) + " %";
}

/// What is wrong with where the volumes stand, a line each; only what is plain to see.
std::string notes_of(const scene::Scene& scene) {
    constexpr double notable_outside = 0.1;
    constexpr double notable_uncovered = 0.2;
    const truth::VolumeSurvey survey = truth::survey_volumes(scene);
    std::string notes;
    for (std::size_t i = 0; i < survey.outside.size(); ++i) {
        if (survey.outside[i] < notable_outside) continue;
        const std::string& name = scene.irradiance_volumes[i].name;
        notes += "irradiance volume " + (name.empty() ? "without a name" : "\"" + name + "\"") + ": " +
                 percent(survey.outside[i]) +
                 " of its probes stand outside of the walls (let its box end at them: center, size_m)\n";
    }
    if (survey.uncovered >= notable_uncovered)
        notes += percent(survey.uncovered) +
                 " of the surfaces of the rooms lie outside of every irradiance " +
                 "volume: the distant light comes to them through the walls (a larger volume, or one more)\n";
    return notes;
}

/// The notes that were made when the volumes were baked, or new ones.
void warn_of_volumes(std::filesystem::path file, bool refresh, Job& job) {
    if (!file.empty()) file.replace_extension("notes");
    // A file of no notes ends with its mark all the same: what is cut off is nothing. The mark numbers the
    // survey's rules.
    constexpr const char* end = "end 2\n";
    std::string notes = refresh ? "" : read_cache(file);
    if (!notes.ends_with(end)) {
        notes = notes_of(job.scene) + end;
        write_cache(file, notes);
    }
    std::istringstream lines(notes);
    for (std::string line; std::getline(lines, line) && line + "\n" != end;) job.diagnostics.warn(line);
}

}  // namespace

LocalLightReport fill_irradiance_volumes(Job& job, const LocalLightOptions& options) {
    LocalLightReport report;
    auto& volumes = job.scene.irradiance_volumes;
    if (volumes.empty() || (!options.refresh && !volumes.front().probes.empty())) return report;
    const auto start = Clock::now();
    const std::uint64_t key = scene_fingerprint(
        job.scene, "irradiance 4 " + realtime::describe(job.profile) + " " + std::to_string(options.samples));
    report.file = cache_file(key, "irradiance");
    report.cached = !options.refresh && io::decode_irradiance(read_cache(report.file), key, volumes);
    if (!report.cached) {
        truth::IrradianceBakeOptions bake;
        measure::set_model(job.profile, bake.path);
        bake.samples = options.samples;
        ProgressLine line("filling irradiance volumes");
        bake.progress = line.function();
        volumes = truth::bake_irradiance(job.scene, bake);
        const std::string bytes = io::encode_irradiance(volumes, key);
        // As the next run finds it: both show the same picture.
        (void)io::decode_irradiance(bytes, key, volumes);
        write_cache(report.file, bytes);
    }
    warn_of_volumes(report.file, options.refresh, job);
    report.seconds = seconds_since(start);
    return report;
}

LocalLightReport fill_reflection_probes(const gpu::Device& device, Job& job,
                                        const realtime::ShadowOptions& shadows,
                                        const LocalLightOptions& options) {
    LocalLightReport report;
    auto& probes = job.scene.reflection_probes;
    if (probes.empty() || (!options.refresh && !probes.front().capture.empty())) return report;
    const auto start = Clock::now();
    // What the volumes hold follows from the scene and the settings, as the probes' pictures do.
    const std::uint64_t key = scene_fingerprint(
        job.scene, "captures 4 " + realtime::describe(job.profile) + " " + device_line(device.info()) + " " +
                       std::to_string(options.samples) + " " + std::to_string(options.passes) + " " +
                       std::to_string(shadows.maps) + " " + std::to_string(shadows.atlas_texels));
    report.file = cache_file(key, "probes");
    report.cached = !options.refresh && io::decode_captures(read_cache(report.file), key, probes);
    if (!report.cached) {
        realtime::ProbeCaptureOptions capture;
        capture.profile = job.profile;
        capture.shadows = shadows;
        capture.passes = options.passes;
        ProgressLine line("taking reflection probes");
        capture.progress = line.function();
        probes = realtime::capture_reflection_probes(device, job.scene, capture);
        const std::string bytes = io::encode_captures(probes, key);
        (void)io::decode_captures(bytes, key, probes);
        write_cache(report.file, bytes);
    }
    report.seconds = seconds_since(start);
    return report;
}

void fill_local_light(const gpu::Device& device, Job& job, const realtime::ShadowOptions& shadows) {
    (void)fill_irradiance_volumes(job, {});
    (void)fill_reflection_probes(device, job, shadows, {});
}

}  // namespace candela::app
