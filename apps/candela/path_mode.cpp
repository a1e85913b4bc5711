#include "path_mode.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <limits>
#include <thread>

#include "candela/measure/path_model.hpp"
#include "candela/realtime/exposure_control.hpp"
#include "candela/realtime/exposure_meter.hpp"
#include "candela/scene/error.hpp"
#include "candela/scene/memory_budget.hpp"
#include "candela/truth/render_path.hpp"
#include "fingerprint.hpp"
#include "option_rules.hpp"
#include "progress_line.hpp"

namespace candela::app {
namespace {

using truth::Film;
using truth::FilmLayout;

constexpr std::uint32_t kDefaultSamples = 256;
/// When a time or an error says when to stop, samples only have to be enough.
constexpr std::uint32_t kPlentySamples = 1u << 18;

/// A signal handler can reach nothing but a global.
std::atomic<bool> g_stop = false;

/// Asks for the picture so far on the first Ctrl-C; the second one kills, as usual.
class InterruptHandler {
  public:
    InterruptHandler() {
        g_stop = false;
        previous_ = std::signal(SIGINT, [](int) {
            g_stop = true;
            std::signal(SIGINT, SIG_DFL);
        });
    }
    ~InterruptHandler() { std::signal(SIGINT, previous_); }
    InterruptHandler(const InterruptHandler&) = delete;
    InterruptHandler& operator=(const InterruptHandler&) = delete;

  private:
    void (*previous_)(int);
};

/// "96 samples, error 0.031 of 0.02": of the tile with fewest, and of the picture.
std::string detail_of(const truth::PathProgress& p, const std::optional<double>& target_error) {
    char text[100];
    std::snprintf(text, sizeof(text), "%u samples", p.samples);
    std::string out = text;
    if (p.error > 0.0 && std::isfinite(p.error)) {
        std::snprintf(text, sizeof(text), ", error %.3g", p.error);
        out += text;
        if (target_error) {
            std::snprintf(text, sizeof(text), " of %.3g", *target_error);
            out += text;
        }
    }
    return out;
}

truth::Lens lens_of(const Job& job, const PathModeOptions& path) {
    if (!path.depth_of_field) return {};
    if (job.camera.projection != scene::Projection::perspective) {
        throw Error(Fault::usage, "an orthographic camera has no lens", "--depth-of-field");
    }
    if (!job.exposure.aperture_f) {
        throw Error(Fault::usage, "needs an aperture", "--depth-of-field",
                    "--aperture N --shutter S --iso I");
    }
    truth::Lens lens;
    const auto unit_m = static_cast<float>(job.scene.frame.unit_m);
    lens.radius_m = truth::lens_radius_m(job.camera.yfov_rad, *job.exposure.aperture_f) / unit_m;
    if (path.focus_m) {
        lens.focus_m = *path.focus_m / unit_m;
        return lens;
    }
    // Without a distance, on what stands in the middle of the picture.
    const truth::Geometry geometry(job.scene);
    const truth::CameraRays rays(job.camera, job.width, job.height);
    truth::Hit hit;
    const truth::Ray ray = rays.through(0.5f * glm::vec2(job.width, job.height), {0.5f, 0.5f});
    if (!geometry.intersect(ray, hit)) {
        throw Error(Fault::usage, "nothing in the middle of the picture to focus on", "--depth-of-field",
                    "--focus-m D");
    }
    lens.focus_m = rays.depth_m(ray, hit.t);
    return lens;
}

std::string exact_text(double value) {
    char text[40];
    std::snprintf(text, sizeof(text), "%.17g", value);
    return text;
}

std::string settings_text(const PathModeOptions& path, const JobOptions& options,
                          const truth::PathRenderOptions& o) {
    return std::to_string(o.samples) + " " + std::to_string(o.path.max_bounces) + " " +
           std::to_string(o.path.direct_only) + std::to_string(o.path.shadows) +
           std::to_string(o.path.furnace) + std::to_string(o.aovs) + " " + std::to_string(options.seed) +
           " " + exact_text(path.target_error.value_or(-1.0)) + " " + std::to_string(o.lens.radius_m) + " " +
           std::to_string(o.lens.focus_m);
}

glm::vec4 mean3(const double* sums, std::uint32_t samples) {
    const double scale = samples > 0 ? 1.0 / samples : 0.0;
    return {static_cast<float>(sums[0] * scale), static_cast<float>(sums[1] * scale),
            static_cast<float>(sums[2] * scale), 1.0f};
}

/// Calls put(index, sums, samples) for every pixel.
template <class Put>
void each_pixel(const Film& film, const Put& put) {
    std::size_t index = 0;
    for (std::uint32_t y = 0; y < film.height(); ++y) {
        for (std::uint32_t x = 0; x < film.width(); ++x, ++index) {
            put(index, film.pixel(x, y), film.tile_of(x, y).samples);
        }
    }
}

realtime::Still to_still(const Film& film, const Job& job) {
    realtime::Still still;
    still.width = film.width();
    still.height = film.height();
    const std::size_t pixels = std::size_t{film.width()} * film.height();
    still.planes.light_nit.resize(pixels);
    still.planes.ids = film.ids;
    const bool any_unlit = std::any_of(job.scene.materials.begin(), job.scene.materials.end(),
                                       [](const scene::Material& m) { return m.unlit; });
    if (any_unlit) still.planes.unlit.resize(pixels);
    each_pixel(film, [&](std::size_t i, const double* p, std::uint32_t n) {
        still.planes.light_nit[i] = mean3(p, n);
        if (!any_unlit) return;
        still.planes.unlit[i] = mean3(p + FilmLayout::unlit, n);
        const double covered = n > 0 ? p[FilmLayout::unlit + 3] / n : 0.0;
        still.planes.light_nit[i].a = static_cast<float>(1.0 - covered);
    });
    if (film.layout().aovs) {
        using realtime::Aov;
        const auto plane = [&](Aov aov) -> std::vector<glm::vec4>& {
            auto& out = still.planes.aovs[static_cast<std::size_t>(aov)];
            out.resize(pixels);
            return out;
        };
        constexpr std::array lobes{Aov::direct_diffuse, Aov::direct_specular, Aov::indirect_diffuse,
                                   Aov::indirect_specular, Aov::emissive};
        for (std::size_t l = 0; l < lobes.size(); ++l) {
            auto& to = plane(lobes[l]);
            each_pixel(film, [&](std::size_t i, const double* p, std::uint32_t n) {
                to[i] = mean3(p + FilmLayout::lobes + 3 * l, n);
            });
        }
        auto& albedo = plane(Aov::albedo);
        auto& normal = plane(Aov::normal);
        auto& distance = plane(Aov::distance);
        each_pixel(film, [&](std::size_t i, const double* p, std::uint32_t n) {
            albedo[i] = mean3(p + FilmLayout::albedo, n);
            normal[i] = mean3(p + FilmLayout::normal, n);
            const double mean_m = n > 0 ? p[FilmLayout::distance] / n : 0.0;
            distance[i] = glm::vec4(static_cast<float>(mean_m));
        });
    }
    const std::optional<float> metered =
        job.exposure.automatic() ? realtime::metered_ev100(std::span<const glm::vec4>(still.planes.light_nit))
                                 : std::nullopt;
    still.metered = metered.has_value();
    still.ev100 = job.exposure.automatic() ? metered.value_or(0.0f) : realtime::manual_ev100(job.exposure);
    still.ev100 -= job.exposure.compensation_ev;
    still.exposure = realtime::exposure_at(still.ev100, job.profile.exposure);
    realtime::add_unlit(still);
    return still;
}

std::vector<ExtraLayer> extra_layers(const Film& film) {
    const std::size_t pixels = std::size_t{film.width()} * film.height();
    ExtraLayer count{"sample_count", "sample_count.N", std::vector<float>(pixels)};
    ExtraLayer variance{"variance", "variance.Y", std::vector<float>(pixels)};
    each_pixel(film, [&](std::size_t i, const double* p, std::uint32_t n) {
        count.plane[i] = static_cast<float>(n);
        if (n < 2) return;
        const glm::vec4 rgb = mean3(p, n);
        const double mean = static_cast<double>(shading::luminance(glm::vec3(rgb)));
        variance.plane[i] = static_cast<float>(std::max(p[FilmLayout::squared] / n - mean * mean, 0.0) /
                                               (static_cast<double>(n) - 1.0));
    });
    return {std::move(count), std::move(variance)};
}

std::uint32_t fewest_samples(const Film& film) {
    std::uint32_t fewest = std::numeric_limits<std::uint32_t>::max();
    for (const Film::Tile& tile : film.tiles) fewest = std::min(fewest, tile.samples);
    return fewest;
}

std::string note_of(const truth::PathRender& render, double error, const std::string& checkpoint) {
    char text[200];
    std::snprintf(text, sizeof(text), "%u samples a pixel or more", fewest_samples(render.film));
    std::string note = text;
    if (std::isfinite(error)) {
        std::snprintf(text, sizeof(text), ", estimated relative error %.4f", error);
        note += text;
    }
    if (render.resumed_samples > 0) note += ", resumed after " + std::to_string(render.resumed_samples);
    if (render.outcome == truth::PathOutcome::stopped)
        note += "; stopped, the same command goes on from " + checkpoint;
    if (render.outcome == truth::PathOutcome::out_of_time)
        note += "; time is up, the same command goes on from " + checkpoint;
    return note;
}

/// An error in one process of a team ends all: it is said here because nothing after the abort is.
truth::PathRender render_with(truth::Team& team, const Job& job, const truth::PathRenderOptions& options) {
    try {
        return truth::render_path(job.scene, job.camera, options, team);
    } catch (const Error& error) {
        if (team.size() > 1) {
            std::fprintf(stderr, "candela: error: %s\n", error.line().c_str());
            team.abort(static_cast<int>(error.fault()));
        }
        throw;
    }
}

}  // namespace

void add_path_options(CLI::App& command, PathModeOptions& o) {
    command
        .add_option("--time-limit", o.time_limit_s, "Path: seconds after which the picture so far will do")
        ->check(number_in(1e-9, 1e9));
    command
        .add_option("--target-error", o.target_error,
                    "Path: estimated relative error at which a tile needs no more samples, such as 0.02")
        ->check(number_in(1e-6, 10.0));
    command.add_option("--max-bounces", o.max_bounces, "Path: surfaces that light may meet on its way (64)")
        ->check(CLI::Range(0, 100000));
    command.add_flag("--direct-only", o.direct_only, "Path: only light straight from its source");
    command.add_flag("--furnace", o.furnace,
                     "Path: light everything by a uniform luminance of 1 cd/m2 instead");
    command.add_flag("--depth-of-field", o.depth_of_field, "Path: blur by the camera's aperture");
    command
        .add_option("--focus-m", o.focus_m, "Path: distance in focus in m; the middle of the picture without")
        ->check(number_in(1e-9, 1e12));
    command.add_option("--checkpoint", o.checkpoint, "Path: file that keeps the work so far (OUTPUT.part)");
    command
        .add_option("--checkpoint-every", o.checkpoint_every_s, "Path: seconds between two of its versions")
        ->check(number_in(0.0, 1e6))
        ->capture_default_str();
}

void check_path_options(const CLI::App& command, const ShadowRequestOptions& shadows,
                        const std::string& mode) {
    if (mode != "path")
        refuse_without_effect(
            command,
            {"--time-limit", "--target-error", "--max-bounces", "--direct-only", "--furnace",
             "--depth-of-field", "--focus-m", "--checkpoint", "--checkpoint-every"},
            "in the mode " + mode + ": it is the path tracer's", "--mode path");
    refuse_together(command, {"--direct-only", "--max-bounces"});
    if (shadows.way == "none") refuse_together(command, {"--shadows", "--max-bounces"});
    for (const char* light :
         {"--env", "--env-scale", "--env-lux", "--env-rotate", "--env-visible", "--env-hidden",
          "--env-keep-sun", "--light-scale", "--light-units", "--units", "--emissive-scale"})
        refuse_together(command, {"--furnace", light});
    if (!given(command, "--depth-of-field"))
        refuse_without_effect(command, {"--focus-m"}, "without a lens", "--depth-of-field");
}

PathModePicture render_by_path(Job& job, const JobOptions& options, const PathModeOptions& path,
                               const PictureFileOptions& files) {
    const std::unique_ptr<truth::Team> team = truth::join_team();
    truth::PathRenderOptions o;
    measure::set_model(job.profile, o.path);
    o.path.max_bounces = path.max_bounces.value_or(o.path.max_bounces);
    o.path.direct_only = path.direct_only;
    o.path.shadows = path.shadows;
    o.path.furnace = path.furnace;
    o.width = job.width;
    o.height = job.height;
    const bool stops_otherwise = path.time_limit_s || path.target_error;
    o.samples = path.samples.value_or(stops_otherwise ? kPlentySamples : kDefaultSamples);
    o.time_limit_s = path.time_limit_s;
    o.target_error = path.target_error;
    o.seed = options.seed;
    o.lens = lens_of(job, path);
    o.aovs = path.light_paths || !files.aovs.empty();
    const std::uint64_t pixel_bytes = FilmLayout{o.aovs}.channels() * sizeof(double) +
                                      (o.aovs ? realtime::kAovCount + 1 : 1) * sizeof(glm::vec4);
    const std::uint64_t bytes = pixel_bytes * o.width * o.height;
    if (const std::uint64_t left = scene::available_memory().bytes; bytes > left)
        throw machine_error("the picture takes " + scene::memory_text(bytes) + " of memory, there are " +
                                scene::memory_text(left),
                            "--size", "a smaller picture");
    o.checkpoint = path.checkpoint;
    if (path.checkpoint.empty() && !files.outputs.empty()) o.checkpoint = files.outputs.front() + ".part";
    o.checkpoint_every_s = path.checkpoint_every_s;
    o.fingerprint = fingerprint(job, settings_text(path, options, o));
    const InterruptHandler interrupt;
    o.stop = &g_stop;
    truth::PathRender render = [&] {
        ProgressLine line(path.label);
        if (line.shown() && team->rank() == 0)
            o.progress = [&](const truth::PathProgress& p) {
                line.report(p.fraction, p.seconds_left, detail_of(p, path.target_error));
            };
        return render_with(*team, job, o);
    }();
    PathModePicture out;
    out.writes = team->rank() == 0;
    if (!out.writes) return out;
    out.finished = render.outcome == truth::PathOutcome::finished;
    out.error = render.film.picture_error(truth::kErrorFloor * render.film.median_luminance_nit());
    out.still = to_still(render.film, job);
    if (o.aovs) {
        out.environment_nit.resize(out.still.planes.light_nit.size());
        each_pixel(render.film, [&](std::size_t i, const double* p, std::uint32_t n) {
            out.environment_nit[i] = mean3(p + FilmLayout::environment, n);
        });
    }
    out.info.mode = "path";
    out.info.device = "CPU, Embree";
    out.info.samples = fewest_samples(render.film);
    out.info.seed = options.seed;
    out.info.settings["max_bounces"] = std::to_string(o.path.max_bounces);
    if (path.direct_only) out.info.settings["light"] = "direct only";
    if (!o.path.shadows) out.info.settings["light"] = "direct only, without shadows";
    if (path.furnace) out.info.settings["light"] = "furnace";
    if (o.aovs) out.info.layers = extra_layers(render.film);
    if (render.replaced_checkpoint)
        job.diagnostics.warn("a checkpoint of another job, or a damaged one, was replaced");
    const auto empty = std::count_if(render.film.tiles.begin(), render.film.tiles.end(),
                                     [](const Film::Tile& tile) { return tile.samples == 0; });
    if (empty > 0) job.diagnostics.warn("stopped early: some tiles have no samples and are black");
    out.note = note_of(render, out.error, o.checkpoint.string());
    if (out.finished) out.checkpoint = o.checkpoint.string();
    return out;
}

}  // namespace candela::app
