#include "candela/scene/environment_sources.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "candela/scene/environment_sphere.hpp"

namespace candela::scene {
namespace {

using detail::PictureSphere;

/// A source ends where it is this much above the light of its surroundings, or this far below its peak.
constexpr double kEdgeOverSurroundings = 4.0;
constexpr double kEdgeBelowPeak = 1.0e-3;

double median(std::vector<float>& values) {
    if (values.empty()) return 0.0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return static_cast<double>(*middle);
}

/// The eight neighbours of a texel that exist; rows go round, columns end at the poles.
template <class Visit>
void visit_neighbours(const Environment& e, std::uint32_t texel, Visit&& visit) {
    const std::uint32_t x = texel % e.width, y = texel / e.width;
    for (std::uint32_t v = y > 0 ? y - 1 : 0; v <= std::min(y + 1, e.height - 1); ++v) {
        for (const std::uint32_t u : {(x + e.width - 1) % e.width, x, (x + 1) % e.width}) {
            if (u != x || v != y) visit(v * e.width + u);
        }
    }
}

/// What the texels of a region stand in: the two rings of texels about it that belong to no source.
std::vector<std::uint32_t> rings_about(const Environment& e, const std::vector<std::uint32_t>& region,
                                       const std::vector<std::uint8_t>& taken) {
    std::vector<std::uint32_t> inside(region), rings;
    std::sort(inside.begin(), inside.end());
    const auto is_inside = [&](std::uint32_t t) {
        return std::binary_search(inside.begin(), inside.end(), t);
    };
    std::vector<std::uint32_t> from = region;
    for (int ring = 0; ring < 2; ++ring) {
        std::vector<std::uint32_t> next;
        for (const std::uint32_t texel : from) {
            visit_neighbours(e, texel, [&](std::uint32_t t) {
                if (!is_inside(t)) next.push_back(t);
            });
        }
        std::sort(next.begin(), next.end());
        next.erase(std::unique(next.begin(), next.end()), next.end());
        rings.insert(rings.end(), next.begin(), next.end());
        from = std::move(next);
    }
    std::sort(rings.begin(), rings.end());
    rings.erase(std::unique(rings.begin(), rings.end()), rings.end());
    std::erase_if(rings, [&](std::uint32_t t) { return taken[t] != 0; });
    return rings;
}

/// What would be there without the source: the mean of the rings about it by the inverse square of the
/// distance, in no channel more than what is there.
std::vector<glm::vec3> light_behind(const PictureSphere& sphere, const std::vector<std::uint32_t>& region,
                                    const std::vector<std::uint32_t>& rings) {
    const Environment& e = sphere.environment();
    std::vector<glm::dvec3> directions;
    for (const std::uint32_t t : rings) directions.push_back(sphere.direction(t));
    std::vector<glm::vec3> out;
    for (const std::uint32_t texel : region) {
        const glm::dvec3 here = sphere.direction(texel);
        glm::dvec3 sum(0.0);
        double weights = 0.0;
        for (std::size_t i = 0; i < rings.size(); ++i) {
            const double weight =
                sphere.solid_angle(rings[i]) / glm::dot(here - directions[i], here - directions[i]);
            sum += weight * glm::dvec3(e.luminance_nit[rings[i]]);
            weights += weight;
        }
        const glm::vec3 mean = weights > 0.0 ? glm::vec3(sum / weights) : glm::vec3(0.0f);
        out.push_back(glm::min(mean, e.luminance_nit[texel]));
    }
    return out;
}

/// Numbers of a source from what is over the light behind it.
void measure(const PictureSphere& sphere, const std::vector<glm::vec3>& behind, EnvironmentSource& source) {
    const Environment& e = sphere.environment();
    glm::dvec3 middle(0.0), sum(0.0);
    double peak = 0.0, of_luminance = 0.0;
    for (std::size_t i = 0; i < source.texels.size(); ++i) {
        const std::uint32_t texel = source.texels[i];
        const glm::dvec3 excess = double{e.scale} * glm::dvec3(e.luminance_nit[texel] - behind[i]);
        const double solid_angle = sphere.solid_angle(texel), luminance = shading::luminance(excess);
        sum += excess * solid_angle;
        middle += sphere.direction(texel) * (luminance * solid_angle);
        of_luminance += luminance * solid_angle;
        peak = std::max(peak, luminance);
    }
    source.illuminance_lx = sum;
    source.solid_angle_sr = peak > 0.0 ? of_luminance / peak : 0.0;
    const glm::vec3 picture =
        glm::length(middle) > 0.0 ? glm::vec3(glm::normalize(middle)) : glm::vec3(0.0f, 1.0f, 0.0f);
    source.direction = shading::rotate_about_y(picture, e.rotation_rad);
}

/// Finds one source after the other.
class Search {
  public:
    Search(const Environment& e, const SourceLimits& limits)
        : sphere_(e), limits_(limits), taken_(e.luminance_nit.size(), 0), seen_(taken_) {}

    std::vector<EnvironmentSource> run() {
        std::vector<EnvironmentSource> out;
        const double min_lx = limits_.min_fraction * total_lx();
        const double cap_sr =
            2.0 * M_PI * (1.0 - std::cos(limits_.half_angle_rad + sphere_.texel_side_rad()));
        for (int rejected = 0; rejected < limits_.max_rejected && out.size() < limits_.max_sources;) {
            const std::optional<std::uint32_t> seed = brightest();
            // What is left cannot give enough, however large it is.
            if (!seed || double{sphere_.luminance(*seed)} * cap_sr < min_lx) break;
            std::optional<EnvironmentSource> source = grow(*seed);
            const bool good = source && shading::luminance(source->illuminance_lx) >= min_lx;
            if (good) {
                for (const std::uint32_t t : source->texels) taken_[t] = seen_[t] = 1;
                out.push_back(std::move(*source));
            } else {
                ++rejected;
                sphere_.visit_cap(sphere_.direction(*seed), 0.5 * limits_.half_angle_rad,
                                  [&](std::uint32_t t) { seen_[t] = 1; });
                seen_[*seed] = 1;
            }
        }
        std::stable_sort(out.begin(), out.end(), [](const auto& a, const auto& b) {
            return shading::luminance(a.illuminance_lx) > shading::luminance(b.illuminance_lx);
        });
        return out;
    }

  private:
    double total_lx() const {
        double sum = 0.0;
        for (std::uint32_t t = 0; t < sphere_.texels(); ++t)
            sum += double{sphere_.luminance(t)} * sphere_.solid_angle(t);
        return sum;
    }

    std::optional<std::uint32_t> brightest() const {
        std::optional<std::uint32_t> out;
        float most = 0.0f;
        for (std::uint32_t t = 0; t < sphere_.texels(); ++t) {
            if (seen_[t] == 0 && sphere_.luminance(t) > most) most = sphere_.luminance(t), out = t;
        }
        return out;
    }

    double median_of(const std::vector<std::uint32_t>& texels) const {
        std::vector<float> values;
        values.reserve(texels.size());
        for (const std::uint32_t t : texels) values.push_back(sphere_.luminance(t));
        return median(values);
    }

    double surroundings(std::uint32_t seed) const {
        const double inner = limits_.half_angle_rad + 2.0 * sphere_.texel_side_rad();
        const double outer = inner + std::max(limits_.half_angle_rad, 3.0 * sphere_.texel_side_rad());
        const glm::dvec3 middle = sphere_.direction(seed);
        std::vector<std::uint32_t> ring;
        sphere_.visit_cap(middle, outer, [&](std::uint32_t t) {
            if (taken_[t] == 0 && glm::dot(middle, sphere_.direction(t)) < std::cos(inner)) ring.push_back(t);
        });
        return median_of(ring);
    }

    /// The texels connected to the seed that are brighter than `edge`; none when they reach further than a
    /// source may.
    std::vector<std::uint32_t> connected(std::uint32_t seed, double edge) const {
        const Environment& e = sphere_.environment();
        const glm::dvec3 middle = sphere_.direction(seed);
        const double farthest = limits_.half_angle_rad + sphere_.texel_side_rad();
        std::vector<std::uint32_t> out{seed};
        std::vector<std::uint8_t> met(taken_.size(), 0);
        met[seed] = 1;
        for (std::size_t i = 0; i < out.size(); ++i) {
            bool too_far = false;
            visit_neighbours(e, out[i], [&](std::uint32_t t) {
                if (met[t] != 0 || taken_[t] != 0 || !(double{sphere_.luminance(t)} > edge)) return;
                met[t] = 1;
                too_far = too_far || glm::dot(middle, sphere_.direction(t)) < std::cos(farthest);
                out.push_back(t);
            });
            if (too_far) return {};
        }
        return out;
    }

    std::optional<EnvironmentSource> grow(std::uint32_t seed) const {
        const double peak = double{sphere_.luminance(seed)}, around = surroundings(seed);
        if (peak < limits_.contrast * around) return std::nullopt;
        EnvironmentSource out;
        for (double edge = std::max(kEdgeOverSurroundings * around, kEdgeBelowPeak * peak);
             edge < peak && out.texels.empty(); edge *= 2.0)
            out.texels = connected(seed, edge);
        if (out.texels.empty()) return std::nullopt;
        const std::vector<std::uint32_t> rings = rings_about(sphere_.environment(), out.texels, taken_);
        const double beside = median_of(rings);
        if (peak < limits_.contrast * beside) return std::nullopt;
        out.contrast = peak / beside;
        measure(sphere_, light_behind(sphere_, out.texels, rings), out);
        // A texel of a coarse picture is a part of the sky.
        if (out.half_angle_rad() > limits_.half_angle_rad) return std::nullopt;
        return out;
    }

    PictureSphere sphere_;
    SourceLimits limits_;
    std::vector<std::uint8_t> taken_;
    std::vector<std::uint8_t> seen_;  ///< not to be tried as a seed again
};

Light light_of(const EnvironmentSource& source, const Environment& e) {
    Light out;
    out.type = LightType::sun;
    out.direction = -source.direction;
    const glm::vec3 side =
        std::abs(out.direction.y) < 0.99f ? glm::vec3(0.0f, 1.0f, 0.0f) : glm::vec3(1.0f, 0.0f, 0.0f);
    out.right = glm::normalize(glm::cross(out.direction, side));
    const double lx = shading::luminance(source.illuminance_lx);
    out.color = glm::vec3(source.illuminance_lx / lx);
    out.intensity = static_cast<float>(lx);
    out.angular_diameter_rad = static_cast<float>(2.0 * source.half_angle_rad());
    out.visible = e.visible;
    out.unit = LightUnit::lux;
    out.carrier = "environment";
    return out;
}

}  // namespace

double EnvironmentSource::half_angle_rad() const noexcept {
    // 2 pi (1 - cos a) as 4 pi sin^2(a / 2), which keeps the digits of a small disc.
    return 2.0 * std::asin(std::sqrt(std::min(solid_angle_sr / (4.0 * M_PI), 1.0)));
}

std::vector<EnvironmentSource> find_sources(const Environment& environment, const SourceLimits& limits) {
    return Search(environment, limits).run();
}

std::optional<EnvironmentSource> find_sun(const Environment& environment) {
    constexpr double max_half_angle_rad = 0.0174533, min_fraction = 0.2, min_direction_y = -0.035;
    SourceLimits limits;
    limits.max_sources = 3;
    limits.max_rejected = 8;
    limits.min_fraction = 0.02;
    const double upward_lx = upward_illuminance_lx(environment);
    for (EnvironmentSource& source : find_sources(environment, limits)) {
        const double four_texels = 4.0 * M_PI / environment.height * 2.0 * M_PI / environment.width;
        const double limit_rad = std::max(max_half_angle_rad, std::sqrt(four_texels / M_PI));
        const double lx = shading::luminance(source.illuminance_lx);
        const double rest_lx = std::max(upward_lx - lx * std::max(double{source.direction.y}, 0.0), 0.0);
        if (double{source.direction.y} > min_direction_y && source.half_angle_rad() <= limit_rad &&
            lx > min_fraction * (lx + rest_lx))
            return std::move(source);
    }
    return std::nullopt;
}

std::vector<Light> take_out(Environment& environment, const std::vector<EnvironmentSource>& sources) {
    const PictureSphere sphere(environment);
    std::vector<std::uint8_t> taken(environment.luminance_nit.size(), 0);
    for (const EnvironmentSource& source : sources) {
        for (const std::uint32_t t : source.texels) taken[t] = 1;
    }
    std::vector<Light> out;
    std::vector<std::vector<glm::vec3>> behind;
    for (EnvironmentSource source : sources) {
        behind.push_back(light_behind(sphere, source.texels, rings_about(environment, source.texels, taken)));
        measure(sphere, behind.back(), source);
        out.push_back(light_of(source, environment));
        out.back().name =
            (sources.size() > 1 ? "source " + std::to_string(out.size()) : "sun") + " of " + environment.name;
    }
    // Only now: the measures above read the picture.
    for (std::size_t s = 0; s < sources.size(); ++s) {
        for (std::size_t i = 0; i < sources[s].texels.size(); ++i)
            environment.luminance_nit[sources[s].texels[i]] = behind[s][i];
    }
    return out;
}

bool split_sun(Scene& scene) {
    if (!scene.environment) return false;
    const std::optional<EnvironmentSource> sun = find_sun(*scene.environment);
    if (!sun) return false;
    scene.lights.push_back(take_out(*scene.environment, {*sun}).front());
    return true;
}

}  // namespace candela::scene
