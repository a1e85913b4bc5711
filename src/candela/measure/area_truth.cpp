#include "candela/measure/area_truth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "candela/measure/numerics.hpp"

namespace candela::measure {
namespace {

using glm::cross;
using glm::dot;
using glm::dvec3;

double square(double x) {
    return x * x;
}

struct Interval {
    double low = 0.0;
    double high = 0.0;
    [[nodiscard]] bool empty() const { return !(low < high); }
};

/// Where `constant + slope y` is not negative.
Interval above(Interval y, double constant, double slope) {
    if (slope == 0.0) return constant >= 0.0 ? y : Interval{0.0, 0.0};
    const double zero = -constant / slope;
    return slope > 0.0 ? Interval{std::max(y.low, zero), y.high} : Interval{y.low, std::min(y.high, zero)};
}

/// Integral over [low, high] of f whose ends may fall like a square root: the points crowd there.
template <class F>
double integrate_between(F f, double low, double high, int panels) {
    if (!(low < high)) return 0.0;
    const double middle = 0.5 * (low + high);
    const double half = 0.5 * (high - low);
    return integrate([&](double t) { return f(middle - half * std::cos(t)) * half * std::sin(t); }, 0.0, kPi,
                     panels);
}

/// The same, cut at the places where f is not smooth.
template <class F, std::size_t N>
double integrate_pieces(F f, double low, double high, std::array<double, N> cuts, int panels) {
    std::sort(cuts.begin(), cuts.end());
    double sum = 0.0;
    double from = low;
    for (const double cut : cuts) {
        const double to = std::clamp(cut, from, high);
        sum += integrate_between(f, from, to, panels);
        from = to;
    }
    return sum + integrate_between(f, from, high, panels);
}

/// A strip of a plane at height h over the receiver, at x, from y.low to y.high: the integral over y of
/// h (n . p) / |p|^4 where n . p >= 0, p = (x, y, h); y = w tan(b), w^2 = h^2 + x^2.
double strip(const dvec3& n, double x, Interval y, double h) {
    const double constant = n.x * x + n.z * h;
    y = above(y, constant, n.y);
    if (y.empty()) return 0.0;
    const double w = std::hypot(x, h);
    const auto primitive = [&](double at) {
        const double b = std::atan2(at, w);
        const double s = std::sin(b);
        return 0.5 * h / square(w) * (constant / w * (b + s * std::cos(b)) + n.y * s * s);
    };
    return primitive(y.high) - primitive(y.low);
}

dvec3 perpendicular(const dvec3& v) {
    return glm::normalize(cross(v, std::abs(v.x) < 0.7 ? dvec3(1.0, 0.0, 0.0) : dvec3(0.0, 1.0, 0.0)));
}

}  // namespace

double illuminance_truth(const dvec3& n, const SphereLight& light, int panels) {
    // Rings about the direction to the centre. Of each, the azimuths above the horizon: |a| <= visible.
    const double distance = glm::length(light.center);
    const double cosine = dot(n, light.center) / distance;
    const double sine = std::sqrt(std::max(1.0 - cosine * cosine, 0.0));
    const double sigma = std::asin(std::min(light.radius / distance, 1.0));
    const auto ring = [&](double t) {
        const double constant = cosine * std::cos(t);
        const double slope = sine * std::sin(t);
        if (constant >= slope) return 2.0 * kPi * constant * std::sin(t);
        if (constant <= -slope) return 0.0;
        const double visible = std::acos(-constant / slope);
        return 2.0 * (constant * visible + slope * std::sin(visible)) * std::sin(t);
    };
    return integrate_pieces(ring, 0.0, sigma, std::array{std::abs(std::atan2(cosine, sine))}, panels);
}

double illuminance_truth(const dvec3& n, const RectangleLight& light, int panels) {
    const dvec3 away = cross(light.right, light.up);
    const double h = dot(away, light.center);
    if (h <= 0.0) return 0.0;
    const dvec3 normal(dot(n, light.right), dot(n, light.up), dot(n, away));
    const double x = dot(light.center, light.right);
    const double y = dot(light.center, light.up);
    const Interval strip_y{y - light.half_height, y + light.half_height};
    // x = h sinh(a): fine near the receiver's foot, coarse far from it. The horizon crosses two sides at the
    // cuts.
    const auto at = [&](double a) { return strip(normal, h * std::sinh(a), strip_y, h) * h * std::cosh(a); };
    const auto crossing = [&](double side) {
        return std::asinh(-(normal.z * h + normal.y * side) / (normal.x * h));
    };
    const double low = std::asinh((x - light.half_width) / h);
    const double high = std::asinh((x + light.half_width) / h);
    const bool level = normal.x == 0.0;
    return integrate_pieces(
        at, low, high, std::array{level ? low : crossing(strip_y.low), level ? low : crossing(strip_y.high)},
        panels);
}

double illuminance_truth(const dvec3& n, const DiskLight& light, int panels) {
    const dvec3 away = -light.direction;
    const double h = dot(away, light.center);
    if (h <= 0.0) return 0.0;
    const dvec3 in_plane = light.center - away * h;
    const double x = glm::length(in_plane);
    const dvec3 right = x > 1e-12 ? in_plane / x : perpendicular(away);
    const dvec3 normal(dot(n, right), dot(n, cross(away, right)), dot(n, away));
    const double r = light.radius;
    const auto at = [&](double a) {
        const double x_at = h * std::sinh(a);
        const double half = std::sqrt(std::max(square(r) - square(x_at - x), 0.0));
        return strip(normal, x_at, {-half, half}, h) * h * std::cosh(a);
    };
    // The horizon meets the rim where normal.x x + normal.z h = -normal.y y, y^2 = r^2 - (x - centre)^2.
    const double low = std::asinh((x - r) / h);
    const double high = std::asinh((x + r) / h);
    std::array cuts{low, low};
    const double slope2 = square(normal.x) + square(normal.y);
    if (slope2 > 0.0) {
        const double height = normal.x * x + normal.z * h;
        const double discriminant = slope2 * square(r) - square(height);
        if (discriminant > 0.0) {
            const double middle = -normal.x * height / slope2;
            const double spread = std::abs(normal.y) * std::sqrt(discriminant) / slope2;
            cuts = {std::asinh((x + middle - spread) / h), std::asinh((x + middle + spread) / h)};
        }
    }
    return integrate_pieces(at, low, high, cuts, panels);
}

double illuminance_truth(const dvec3& n, const TubeLight& light, int panels) {
    const double middle = dot(light.center, light.axis);
    const dvec3 across = light.center - middle * light.axis;
    const double y = glm::length(across);
    const double start = middle - light.half_length;
    const double end = middle + light.half_length;
    if (y <= light.radius)
        return illuminance_truth(
            n, SphereLight{across + light.axis * std::clamp(0.0, start, end), light.radius}, 16);
    const dvec3 across_unit = across / y;
    const dvec3 normal(dot(n, light.axis), dot(n, across_unit), dot(n, cross(light.axis, across_unit)));
    // Half planes through the receiver that contain the axis's direction, turned about it by up to
    // asin(radius / y): each cuts the capsule in two half circles and their tangents, seen between two angles
    // from the axis, and n . l is normal_x cos(t) + slope sin(t) there.
    const auto half_plane = [&](double turn) {
        const double sine = light.radius / y * std::sin(turn);
        const double cosine = std::sqrt(1.0 - sine * sine);
        const double radius = light.radius * std::cos(turn);
        const double height = y * cosine;
        const auto seen = [&](double x, double side) {
            return std::atan2(height, x) + side * std::asin(std::min(radius / std::hypot(x, height), 1.0));
        };
        const double slope = normal.y * cosine + normal.z * sine;
        Interval t{std::min(seen(start, -1.0), seen(end, -1.0)), std::max(seen(start, 1.0), seen(end, 1.0))};
        // n . l >= 0: within 90 degrees of the direction (normal.x, slope).
        double best = std::atan2(slope, normal.x);
        if (best < -0.5 * kPi) best += 2.0 * kPi;
        t = {std::max(t.low, best - 0.5 * kPi), std::min(t.high, best + 0.5 * kPi)};
        if (t.empty()) return 0.0;
        const auto primitive = [&](double a) {
            const double s = std::sin(a);
            return 0.5 * (normal.x * s * s + slope * (a - s * std::cos(a)));
        };
        const double jacobian = light.radius / y * std::cos(turn) / cosine;
        return (primitive(t.high) - primitive(t.low)) * jacobian;
    };
    return integrate(half_plane, -0.5 * kPi, 0.0, panels) + integrate(half_plane, 0.0, 0.5 * kPi, panels);
}

double line_illuminance_truth(const dvec3& n, const dvec3& center, const dvec3& axis, double half_length,
                              int panels) {
    const auto point = [&](double t) {
        const dvec3 p = center + axis * (half_length * t);
        const double distance2 = dot(p, p);
        const double distance = std::sqrt(distance2);
        return glm::length(cross(axis, p)) / distance * std::max(dot(n, p), 0.0) / (distance * distance2);
    };
    const double slope = dot(n, axis) * half_length;
    const double crossing = slope == 0.0 ? -1.0 : -dot(n, center) / slope;
    return 0.5 * integrate_pieces(point, -1.0, 1.0, std::array{crossing}, panels);
}

}  // namespace candela::measure
