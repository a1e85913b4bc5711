#include "candela/truth/irradiance_bake.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <mutex>

#include "candela/bake/irradiance_harmonics.hpp"
#include "shading/octahedral.glsl"
#include "shading/probes/volume.glsl"
#include "shading/sampling.glsl"
#include "shading/spherical_harmonics.glsl"

namespace candela::truth {
namespace {

using scene::IrradianceProbe;
using scene::IrradianceVolume;

/// Rays a side of a texel's square of distances.
constexpr int kDistanceRays = 4;
/// Width of that square in texels: neighbours overlap, so that the filtered picture has no steps.
constexpr float kDistanceWidth = 2.0f;
/// Distances end at this many cells: beyond, no point asks.
constexpr float kFarthestCells = 2.0f;
/// A path may find this many times the mean of its probe's paths: what one of thousands finds alone would be
/// a blot of a cell's size, and no neighbour would confirm it.
constexpr float kMostOverMean = 32.0f;
constexpr std::uint32_t kSeedOfVolume = 0x9e3779b9u;

glm::vec3 sphere_direction(const glm::vec2& u) {
    const float z = 1.0f - 2.0f * u.x;
    const float r = std::sqrt(std::max(1.0f - z * z, 0.0f));
    const float turn = shading::TWO_PI * u.y;
    return {r * std::cos(turn), r * std::sin(turn), z};
}

/// The camera of a bake sees neither lights nor what shines, but the sky even where no picture shows it.
scene::Scene without_lights_in_view(const scene::Scene& scene) {
    scene::Scene copy = scene;
    for (scene::Light& light : copy.lights) light.visible = false;
    if (copy.environment) copy.environment->visible = true;
    return copy;
}

PathOptions bake_options(PathOptions path) {
    path.direct_only = false;
    path.shadows = true;
    path.furnace = false;
    path.cull_first = false;
    return path;
}

class IrradianceBake {
  public:
    IrradianceBake(const scene::Scene& scene, const IrradianceBakeOptions& options)
        : options_(options),
          scene_(without_lights_in_view(scene)),
          surfaces_(scene_, integrator_.geometry()) {
        for (const IrradianceVolume& v : scene_.irradiance_volumes) total_ += v.probe_count();
    }

    std::vector<IrradianceVolume> run();

  private:
    void bake(const IrradianceVolume& volume, std::uint32_t volume_index, std::size_t index,
              IrradianceProbe& out) const;
    void gather(const glm::vec3& position, const glm::uvec2& pixel, IrradianceProbe& out) const;
    void measure_distances(const glm::vec3& position, float farthest_m, IrradianceProbe& out) const;
    void after_probe();

    const IrradianceBakeOptions& options_;
    scene::Scene scene_;
    PathIntegrator integrator_{scene_, bake_options(options_.path)};
    SurfaceReader surfaces_;
    std::size_t total_ = 0;
    std::atomic<std::size_t> done_ = 0;
    std::mutex mutex_;
};

/// Whether a hit is the back of something that has none.
bool behind_surface(const SurfaceReader& surfaces, const Geometry& geometry, const Ray& ray, const Hit& hit) {
    if (surfaces.material(hit.part).double_sided) return false;
    glm::vec3 corner[3];
    geometry.corners(hit.part, hit.triangle, corner);
    return glm::dot(glm::cross(corner[1] - corner[0], corner[2] - corner[0]), ray.direction) > 0.0f;
}

void IrradianceBake::gather(const glm::vec3& position, const glm::uvec2& pixel, IrradianceProbe& out) const {
    std::vector<glm::vec3> lights(options_.samples);
    std::vector<glm::vec3> directions(options_.samples);
    std::uint32_t back_faces = 0;
    double mean = 0.0;
    for (std::uint32_t i = 0; i < options_.samples; ++i) {
        const PathSampler sampler(pixel, i, options_.seed);
        const Ray ray{position, sphere_direction(sampler.pixel())};
        Hit hit;
        if (integrator_.geometry().intersect(ray, hit) &&
            behind_surface(surfaces_, integrator_.geometry(), ray, hit)) {
            ++back_faces;
        }
        const PathResult path = integrator_.trace(ray, sampler);
        directions[i] = ray.direction;
        lights[i] = path.luminance_nit - path.emissive;
        mean += double(shading::luminance(lights[i])) / options_.samples;
    }
    std::array<glm::dvec3, 9> sums{};
    for (std::uint32_t i = 0; i < options_.samples; ++i) {
        const float over = shading::luminance(lights[i]) / std::max(kMostOverMean * float(mean), 1e-20f);
        const glm::dvec3 light(lights[i] / std::max(over, 1.0f));
        for (int k = 0; k < shading::kShCoefficients; ++k)
            sums[std::size_t(k)] += light * double(shading::sh_basis(k, directions[i]));
    }
    out.valid = double(back_faces) <= kMostBackFaces * options_.samples;
    const double scale = 4.0 * double(shading::PI) / options_.samples;
    for (int k = 0; k < shading::kShCoefficients; ++k) {
        out.irradiance_sh[std::size_t(k)] =
            glm::vec3(sums[std::size_t(k)] * (scale * double(shading::sh_cosine_over_pi(k))));
    }
    bake::window_negative(out.irradiance_sh);
}

void IrradianceBake::measure_distances(const glm::vec3& position, float farthest_m,
                                       IrradianceProbe& out) const {
    constexpr int size = shading::kDistanceSize;
    out.distances.resize(std::size_t(size) * size);
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            double sum = 0.0;
            double squares = 0.0;
            for (int i = 0; i < kDistanceRays * kDistanceRays; ++i) {
                const glm::vec2 part =
                    (glm::vec2(i % kDistanceRays, i / kDistanceRays) + 0.5f) / float(kDistanceRays);
                const glm::vec2 at = glm::vec2(x, y) + 0.5f + kDistanceWidth * (part - 0.5f);
                // Across the octahedron's edges the texel goes on where the fold says.
                const glm::vec2 folded = shading::octahedral_unfolded(at / float(size) * 2.0f - 1.0f);
                Hit hit;
                const Ray ray{position, shading::octahedral_decode(folded), farthest_m};
                const double d = double(integrator_.geometry().intersect(ray, hit) ? hit.t : farthest_m);
                sum += d;
                squares += d * d;
            }
            const double n = kDistanceRays * kDistanceRays;
            out.distances[std::size_t(y) * size + std::size_t(x)] =
                glm::vec2(float(sum / n), float(squares / n));
        }
    }
}

void IrradianceBake::bake(const IrradianceVolume& volume, std::uint32_t volume_index, std::size_t index,
                          IrradianceProbe& out) const {
    const auto x = int(index % std::size_t(volume.cells.x));
    const auto y = int(index / std::size_t(volume.cells.x) % std::size_t(volume.cells.y));
    const auto z = int(index / std::size_t(volume.cells.x) / std::size_t(volume.cells.y));
    const glm::vec3 position = volume.position({x, y, z});
    gather(position, {static_cast<std::uint32_t>(index), kSeedOfVolume * (volume_index + 1)}, out);
    measure_distances(position, kFarthestCells * glm::length(volume.spacing_m()), out);
}

void IrradianceBake::after_probe() {
    const std::size_t done = ++done_;
    if (!options_.progress) return;
    const std::lock_guard lock(mutex_);
    options_.progress(double(done) / double(total_));
}

std::vector<IrradianceVolume> IrradianceBake::run() {
    std::vector<IrradianceVolume> out = scene_.irradiance_volumes;
    for (std::uint32_t v = 0; v < out.size(); ++v) {
        out[v].probes.assign(out[v].probe_count(), {});
        tbb::parallel_for(std::size_t{0}, out[v].probes.size(), [&](std::size_t i) {
            bake(out[v], v, i, out[v].probes[i]);
            after_probe();
        });
    }
    return out;
}

}  // namespace

std::vector<IrradianceVolume> bake_irradiance(const scene::Scene& scene,
                                              const IrradianceBakeOptions& options) {
    return IrradianceBake(scene, options).run();
}

}  // namespace candela::truth
