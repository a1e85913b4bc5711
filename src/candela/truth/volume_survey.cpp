#include "candela/truth/volume_survey.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>
#include <numeric>

#include "candela/truth/geometry.hpp"
#include "candela/truth/surface_point.hpp"
#include "shading/basis.glsl"
#include "shading/probes/parallax.glsl"
#include "shading/probes/volume.glsl"
#include "shading/sampling.glsl"
#include "shading/sequence.glsl"

namespace candela::truth {
namespace {

constexpr std::uint32_t kProbeRays = 256;
/// A probe that sees so much from behind and no sky stands inside of something.
constexpr double kBuried = 0.25;
/// What cracks between surfaces let through is no sky.
constexpr double kNoSky = 0.01;
/// The mean of probes in the open; less is a room with windows, or a street.
constexpr double kOpenSky = 0.25;
/// Beside a plane opening a probe inside sees half of the sky at most; behind a wall of one side it sees
/// more.
constexpr double kBehindSky = 0.5;
constexpr double kBehindBack = 0.1;
/// So much of a volume must be shut off from the sky to say that its walls end there.
constexpr double kEnoughEnclosed = 0.2;

constexpr std::uint32_t kSurfacePoints = 2048;
constexpr std::uint32_t kSurfaceRays = 64;
/// A surface that sees less of the sky, by the cosine, hardly sees it.
constexpr double kShadedSky = 0.3;
/// Sky within 60 degrees about the zenith is what a street has and a room has not.
constexpr float kZenith = 0.5f;
/// So many probes under a roof say which surfaces are in their room.
constexpr std::size_t kWitnesses = 64;
/// Fewer shaded surfaces say nothing.
constexpr double kEnoughShaded = 0.05;
/// From which weight on a volume or a probe reaches a point.
constexpr float kReached = 0.5f;

/// What a ray from a point meets, in shares of all directions.
struct View {
    double sky = 0.0;
    double zenith = 0.0;  ///< of it, what is overhead
    double back = 0.0;
};

class Rays {
  public:
    explicit Rays(const scene::Scene& scene) : geometry_(scene), surfaces_(scene, geometry_) {}

    void cast(const glm::vec3& from, const glm::vec3& direction, double share, View& view) const {
        const Ray ray{from, direction};
        Hit hit;
        if (!geometry_.intersect(ray, hit)) {
            view.sky += share;
            view.zenith += direction.y > kZenith ? share : 0.0;
        } else if (surfaces_.culled(ray, hit)) {
            view.back += share;
        }
    }
    [[nodiscard]] bool clear(const glm::vec3& a, const glm::vec3& b) const {
        const float length = glm::length(b - a);
        return length <= 0.0f || !geometry_.occluded({a, (b - a) / length, length});
    }
    [[nodiscard]] const Geometry& geometry() const { return geometry_; }

  private:
    Geometry geometry_;
    SurfaceReader surfaces_;
};

View view_of_probe(const Rays& rays, const glm::vec3& position) {
    View view;
    for (std::uint32_t i = 0; i < kProbeRays; ++i) {
        const glm::vec2 u = shading::hammersley(i, kProbeRays);
        glm::vec3 d = shading::sample_uniform_hemisphere({std::abs(2.0f * u.x - 1.0f), u.y});
        if (u.x < 0.5f) d.z = -d.z;
        rays.cast(position, d, 1.0 / kProbeRays, view);
    }
    return view;
}

/// Which probes see one another along the edges and diagonals of their cells, and who hangs together.
class Connections {
  public:
    explicit Connections(std::size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    }
    void join(std::size_t a, std::size_t b) { parent_[root(a)] = root(b); }
    [[nodiscard]] std::size_t root(std::size_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }

  private:
    std::vector<std::size_t> parent_;
};

class ProbeSurvey {
  public:
    ProbeSurvey(const Rays& rays, const scene::IrradianceVolume& volume)
        : rays_(rays), volume_(volume), views_(volume.probe_count()) {
        tbb::parallel_for(std::size_t{0}, views_.size(),
                          [&](std::size_t i) { views_[i] = view_of_probe(rays_, position(i)); });
    }

    [[nodiscard]] double outside_share() const;
    /// Where probes are that have a roof and stand in nothing.
    [[nodiscard]] std::vector<glm::vec3> indoors() const {
        std::vector<glm::vec3> out;
        for (std::size_t i = 0; i < views_.size(); ++i)
            if (views_[i].zenith <= kNoSky && views_[i].back <= kBuried) out.push_back(position(i));
        return out;
    }

  private:
    struct Space {
        std::size_t probes = 0;
        double sky = 0.0;
        double most_sky = 0.0;
    };
    [[nodiscard]] glm::ivec3 cell(std::size_t i) const {
        const auto x = static_cast<int>(i) % volume_.cells.x;
        const auto row = static_cast<int>(i) / volume_.cells.x;
        return {x, row % volume_.cells.y, row / volume_.cells.y};
    }
    [[nodiscard]] std::size_t index(const glm::ivec3& c) const {
        return static_cast<std::size_t>((c.z * volume_.cells.y + c.y) * volume_.cells.x + c.x);
    }
    [[nodiscard]] glm::vec3 position(std::size_t i) const { return volume_.position(cell(i)); }
    [[nodiscard]] bool buried(std::size_t i) const {
        return views_[i].back > kBuried && views_[i].sky < kNoSky;
    }
    [[nodiscard]] bool behind(std::size_t i) const {
        return views_[i].sky > kBehindSky && views_[i].back > kBehindBack;
    }
    /// Bit k: the neighbour kNeighbours[k] is seen.
    [[nodiscard]] std::uint32_t seen_neighbours(std::size_t i) const;
    [[nodiscard]] Connections connections() const;

    const Rays& rays_;
    const scene::IrradianceVolume& volume_;
    std::vector<View> views_;
};

/// One of each pair: the thirteen that come later in the grid.
std::vector<glm::ivec3> later_neighbours() {
    std::vector<glm::ivec3> out;
    for (int code = 14; code < 27; ++code) out.push_back({code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1});
    return out;
}

std::uint32_t ProbeSurvey::seen_neighbours(std::size_t i) const {
    static const std::vector<glm::ivec3> neighbours = later_neighbours();
    std::uint32_t seen = 0;
    for (std::size_t k = 0; k < neighbours.size(); ++k) {
        const glm::ivec3 c = cell(i) + neighbours[k];
        const bool there =
            glm::all(glm::greaterThanEqual(c, glm::ivec3(0))) && glm::all(glm::lessThan(c, volume_.cells));
        if (there && !buried(index(c)) && rays_.clear(position(i), position(index(c)))) seen |= 1u << k;
    }
    return seen;
}

Connections ProbeSurvey::connections() const {
    static const std::vector<glm::ivec3> neighbours = later_neighbours();
    std::vector<std::uint32_t> seen(views_.size(), 0);
    tbb::parallel_for(std::size_t{0}, views_.size(), [&](std::size_t i) {
        if (!buried(i)) seen[i] = seen_neighbours(i);
    });
    Connections out(views_.size());
    for (std::size_t i = 0; i < seen.size(); ++i) {
        for (std::size_t k = 0; k < neighbours.size(); ++k)
            if ((seen[i] >> k & 1u) != 0) out.join(i, index(cell(i) + neighbours[k]));
    }
    return out;
}

double ProbeSurvey::outside_share() const {
    Connections connected = connections();
    std::vector<Space> spaces(views_.size());
    std::size_t probes = 0;
    for (std::size_t i = 0; i < views_.size(); ++i) {
        if (buried(i)) continue;
        Space& space = spaces[connected.root(i)];
        ++probes;
        ++space.probes;
        space.sky += views_[i].sky;
        space.most_sky = std::max(space.most_sky, views_[i].sky);
    }
    if (probes == 0) return 0.0;
    std::size_t enclosed = 0;
    for (const Space& space : spaces) enclosed += space.most_sky <= kNoSky ? space.probes : 0;
    const bool walls = double(enclosed) >= kEnoughEnclosed * double(probes);
    std::size_t outside = 0;
    for (std::size_t i = 0; i < views_.size(); ++i) {
        if (buried(i)) continue;
        const Space& space = spaces[connected.root(i)];
        const bool open = walls && space.sky >= kOpenSky * double(space.probes);
        outside += open || behind(i) ? 1 : 0;
    }
    return double(outside) / double(probes);
}

/// Whether a volume or a reflection probe gives most of a point's diffuse light.
bool reached(const scene::Scene& scene, const glm::vec3& position) {
    const auto local = [&](const glm::mat4& world) {
        return glm::vec3(glm::inverse(world) * glm::vec4(position, 1.0f));
    };
    for (const scene::IrradianceVolume& v : scene.irradiance_volumes) {
        const float outside_m = shading::outside_box_m(local(v.world), v.half_size_m);
        // A wall lies on the box, give or take rounding.
        if (shading::volume_influence(outside_m, std::max(v.fade_m, 1e-3f)) >= kReached) return true;
    }
    return std::any_of(scene.reflection_probes.begin(), scene.reflection_probes.end(), [&](const auto& p) {
        return shading::probe_influence(static_cast<int>(p.shape), local(p.world), p.half_size_m, p.margin_m,
                                        p.fade_m) >= kReached;
    });
}

struct Triangle {
    std::uint32_t part;
    std::uint32_t index;
};

/// Points spread over the surfaces of a scene by their area.
class SurfaceSurvey {
  public:
    /// `indoors`: what sees a surface there is in one room with it.
    SurfaceSurvey(const scene::Scene& scene, const Rays& rays, const std::vector<glm::vec3>& indoors)
        : scene_(scene), rays_(rays) {
        const std::size_t step = std::max<std::size_t>(1, indoors.size() / kWitnesses);
        for (std::size_t i = step / 2; i < indoors.size(); i += step) witnesses_.push_back(indoors[i]);
        const std::vector<Part>& parts = rays.geometry().parts();
        double sum_m2 = 0.0;
        for (std::uint32_t part = 0; part < parts.size(); ++part) {
            const auto count = static_cast<std::uint32_t>(parts[part].primitive->indices.size() / 3);
            for (std::uint32_t i = 0; i < count; ++i) {
                glm::vec3 corner[3];
                rays.geometry().corners(part, i, corner);
                sum_m2 += 0.5 * double(glm::length(glm::cross(corner[1] - corner[0], corner[2] - corner[0])));
                triangles_.push_back({part, i});
                areas_m2_.push_back(sum_m2);
            }
        }
    }

    [[nodiscard]] double uncovered_share() const;

  private:
    /// The part of the hemisphere before a point that is sky; 1 where surfaces are seen from behind, so that
    /// the insides of things count for nothing.
    [[nodiscard]] double sky_of(const glm::vec3& position, const glm::vec3& n) const;
    [[nodiscard]] bool witnessed(const glm::vec3& position, const glm::vec3& n) const {
        const glm::vec3 from = offset_from_surface(position, n);
        return std::any_of(witnesses_.begin(), witnesses_.end(), [&](const glm::vec3& witness) {
            return glm::dot(witness - position, n) > 0.0f && rays_.clear(from, witness);
        });
    }

    const scene::Scene& scene_;
    const Rays& rays_;
    std::vector<glm::vec3> witnesses_;
    std::vector<Triangle> triangles_;
    std::vector<double> areas_m2_;  ///< summed up
};

double SurfaceSurvey::sky_of(const glm::vec3& position, const glm::vec3& n) const {
    View view;
    const glm::vec3 from = offset_from_surface(position, n);
    glm::vec3 t, b;
    shading::orthonormal_basis(n, t, b);
    for (std::uint32_t i = 0; i < kSurfaceRays; ++i) {
        const glm::vec3 d = shading::sample_cosine_hemisphere(shading::hammersley(i, kSurfaceRays));
        rays_.cast(from, shading::to_world(d, t, b, n), 1.0 / kSurfaceRays, view);
    }
    return view.back > kNoSky ? 1.0 : view.sky;
}

double SurfaceSurvey::uncovered_share() const {
    if (areas_m2_.empty() || !(areas_m2_.back() > 0.0)) return 0.0;
    std::atomic<std::size_t> shaded = 0;
    std::atomic<std::size_t> uncovered = 0;
    tbb::parallel_for(0u, kSurfacePoints, [&](std::uint32_t i) {
        const double at = (double(i) + 0.5) / kSurfacePoints * areas_m2_.back();
        const auto found = std::lower_bound(areas_m2_.begin(), areas_m2_.end(), at) - areas_m2_.begin();
        const Triangle& t = triangles_[static_cast<std::size_t>(found)];
        glm::vec3 corner[3];
        rays_.geometry().corners(t.part, t.index, corner);
        const glm::vec2 u = shading::sobol_owen(i, 0);
        const float root = std::sqrt(u.y);
        const glm::vec3 position =
            (1.0f - root) * corner[0] + root * (1.0f - u.x) * corner[1] + root * u.x * corner[2];
        const glm::vec3 n = glm::normalize(glm::cross(corner[1] - corner[0], corner[2] - corner[0]));
        if (sky_of(position, n) > kShadedSky) return;
        const bool covered = reached(scene_, position);
        if (!covered && !witnessed(position, n)) return;
        ++shaded;
        if (!covered) ++uncovered;
    });
    if (double(shaded) < kEnoughShaded * kSurfacePoints) return 0.0;
    return double(uncovered) / double(shaded);
}

}  // namespace

VolumeSurvey survey_volumes(const scene::Scene& scene) {
    VolumeSurvey out;
    if (scene.irradiance_volumes.empty()) return out;
    const Rays rays(scene);
    std::vector<glm::vec3> indoors;
    for (const scene::IrradianceVolume& volume : scene.irradiance_volumes) {
        const ProbeSurvey survey(rays, volume);
        out.outside.push_back(survey.outside_share());
        const std::vector<glm::vec3> here = survey.indoors();
        indoors.insert(indoors.end(), here.begin(), here.end());
    }
    out.uncovered = SurfaceSurvey(scene, rays, indoors).uncovered_share();
    return out;
}

}  // namespace candela::truth
