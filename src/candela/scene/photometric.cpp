#include "candela/scene/photometric.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shading/lights/photometric.glsl"

namespace candela::scene {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// Between which nodes an angle is, and how far along.
struct Place {
    std::size_t first;
    double along;  ///< 0 to 1
};

/// At a jump the side of the smaller angle.
Place place_in(const std::vector<double>& angles, double angle) {
    const auto above = std::lower_bound(angles.begin(), angles.end(), angle);
    const auto index = std::clamp<std::ptrdiff_t>(above - angles.begin() - 1, 0,
                                                  static_cast<std::ptrdiff_t>(angles.size()) - 2);
    const auto first = static_cast<std::size_t>(index);
    const double width = angles[first + 1] - angles[first];
    return {first, width > 0.0 ? std::clamp((angle - angles[first]) / width, 0.0, 1.0) : 1.0};
}

double node(const PhotometricProfile& p, std::size_t horizontal, std::size_t vertical) {
    return double{p.candela[horizontal * p.vertical_deg.size() + vertical]};
}

double turned(double c_deg) {
    const double c = std::fmod(c_deg, 360.0);
    return c < 0.0 ? c + 360.0 : c;
}

/// Mean over all half-planes.
std::vector<double> mean_over_c(const PhotometricProfile& p) {
    std::vector<double> out(p.vertical_deg.size());
    for (std::size_t h = 0; h + 1 < p.horizontal_deg.size(); ++h) {
        const double share = (p.horizontal_deg[h + 1] - p.horizontal_deg[h]) / 360.0;
        for (std::size_t v = 0; v < out.size(); ++v)
            out[v] += 0.5 * share * (node(p, h, v) + node(p, h + 1, v));
    }
    return out;
}

/// Integral of sin(gamma) times the line from (from, a) to (to, b), both angles in rad.
double ring(double from, double to, double a, double b) {
    if (!(to > from)) return 0.0;
    const double slope = (b - a) / (to - from);
    return a * (std::cos(from) - std::cos(to)) +
           slope * (std::sin(to) - std::sin(from) - (to - from) * std::cos(to));
}

/// The flux between gamma = 0 and `until_deg`.
double flux_until(const PhotometricProfile& p, double until_deg) {
    const std::vector<double> mean = mean_over_c(p);
    double sum = 0.0;
    for (std::size_t v = 0; v + 1 < mean.size() && p.vertical_deg[v] < until_deg; ++v) {
        const double from = p.vertical_deg[v], whole = p.vertical_deg[v + 1];
        const double to = std::min(whole, until_deg);
        const double end =
            whole > from ? std::lerp(mean[v], mean[v + 1], (to - from) / (whole - from)) : mean[v];
        sum += ring(from * kDegree, to * kDegree, mean[v], end);
    }
    return 2.0 * std::numbers::pi * sum;
}

/// A plane through the axis: intensity over an angle that runs once around, from the zenith through C + 180,
/// the aim and C to the zenith again. Degrees, -180 to 180.
struct Section {
    std::vector<double> angle;
    std::vector<double> candela;
};

Section section(const PhotometricProfile& p, double c_deg) {
    Section out;
    const std::size_t count = p.vertical_deg.size();
    const auto add = [&](double signed_angle, std::size_t v, double c) {
        const Place h = place_in(p.horizontal_deg, turned(c));
        out.angle.push_back(signed_angle);
        out.candela.push_back(std::lerp(node(p, h.first, v), node(p, h.first + 1, v), h.along));
    };
    for (std::size_t v = count; v-- > 0;) add(-p.vertical_deg[v], v, c_deg + 180.0);
    for (std::size_t v = 0; v < count; ++v) add(p.vertical_deg[v], v, c_deg);
    return out;
}

/// 360 degrees less the widest arc on which the section stays under `level`.
std::optional<double> holding_angle(const Section& s, double level) {
    std::vector<double> edges;  // first and last angle of each arc that reaches the level
    for (std::size_t i = 0; i < s.angle.size(); ++i) {
        if (s.candela[i] >= level) {
            edges.push_back(s.angle[i]);
        } else if (i + 1 < s.angle.size() && s.candela[i + 1] > level) {
            const double along = (level - s.candela[i]) / (s.candela[i + 1] - s.candela[i]);
            edges.push_back(std::lerp(s.angle[i], s.angle[i + 1], along));
        }
        if (i + 1 < s.angle.size() && s.candela[i] > level && s.candela[i + 1] < level) {
            const double along = (s.candela[i] - level) / (s.candela[i] - s.candela[i + 1]);
            edges.push_back(std::lerp(s.angle[i], s.angle[i + 1], along));
        }
    }
    if (edges.empty()) return std::nullopt;
    double widest = 0.0;
    const auto gap = [&](double from, double to) {
        const auto under = [&](double angle) {
            const Place at = place_in(s.angle, angle > 180.0 ? angle - 360.0 : angle);
            return std::lerp(s.candela[at.first], s.candela[at.first + 1], at.along) < level;
        };
        if (to - from > widest && under(0.5 * (from + to))) widest = to - from;
    };
    for (std::size_t i = 0; i + 1 < edges.size(); ++i) gap(edges[i], edges[i + 1]);
    gap(edges.back(), edges.front() + 360.0);
    if (widest <= 0.0) return std::nullopt;
    return 360.0 - widest;
}

std::optional<double> plane_spread(const PhotometricProfile& p, double c_deg, double fraction) {
    const Section s = section(p, c_deg);
    const double largest = *std::max_element(s.candela.begin(), s.candela.end());
    if (!(largest > 0.0)) return std::nullopt;
    return holding_angle(s, fraction * largest);
}

}  // namespace

double intensity_cd(const PhotometricProfile& profile, double c_deg, double gamma_deg) {
    const Place h = place_in(profile.horizontal_deg, turned(c_deg));
    const Place v = place_in(profile.vertical_deg, gamma_deg);
    const auto along_vertical = [&](std::size_t horizontal) {
        return std::lerp(node(profile, horizontal, v.first), node(profile, horizontal, v.first + 1), v.along);
    };
    return std::lerp(along_vertical(h.first), along_vertical(h.first + 1), h.along);
}

double intensity_cd(const PhotometricProfile& profile, const glm::vec3& direction) {
    const glm::vec2 angles = shading::photometric_angles(direction);
    return intensity_cd(profile, double{angles.x} / kDegree, double{angles.y} / kDegree);
}

double integrated_lm(const PhotometricProfile& profile) {
    return flux_until(profile, 180.0);
}

double downward_lm(const PhotometricProfile& profile) {
    return flux_until(profile, 90.0);
}

std::optional<double> stated_lm(const PhotometricProfile& profile) {
    const std::optional<double> lamps = profile.lamp_sets.at(profile.lamp_set).flux_lm;
    if (!lamps) return std::nullopt;
    return *lamps * profile.ballast_factor * profile.ballast_lamp_factor *
           profile.light_output_ratio.value_or(1.0);
}

PhotometricPeak peak(const PhotometricProfile& profile) {
    PhotometricPeak out{node(profile, 0, 0), 0.0, 0.0};
    for (std::size_t v = 0; v < profile.vertical_deg.size(); ++v) {
        for (std::size_t h = 0; h < profile.horizontal_deg.size(); ++h) {
            const double here = node(profile, h, v);
            if (here > out.candela) out = {here, profile.horizontal_deg[h], profile.vertical_deg[v]};
        }
    }
    return out;
}

PhotometricSpread spread(const PhotometricProfile& profile, double fraction) {
    return {plane_spread(profile, 0.0, fraction), plane_spread(profile, 90.0, fraction)};
}

double tilt_factor(const PhotometricProfile& profile, double tilt_deg) {
    const PhotometricTilt& tilt = profile.tilt;
    if (tilt.angles_deg.empty()) return 1.0;
    if (tilt.angles_deg.size() == 1) return tilt.factors.front();
    const Place at = place_in(tilt.angles_deg, tilt_deg);
    return std::lerp(tilt.factors[at.first], tilt.factors[at.first + 1], at.along);
}

}  // namespace candela::scene
