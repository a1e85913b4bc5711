#include "candela/measure/area_truth.hpp"
#include "candela/measure/numerics.hpp"
#include "shading/lights/isotropic_line.glsl"
#include "shading/lights/line.glsl"
#include "shading/lights/tube.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;

const vec3 kUp(0.0f, 0.0f, 1.0f);

struct Segment {
    glm::dvec3 start;
    glm::dvec3 end;
    [[nodiscard]] double length_m() const { return glm::length(end - start); }
    [[nodiscard]] bool above() const { return start.z > 0.0 && end.z > 0.0; }
    [[nodiscard]] bool below() const { return start.z <= 0.0 && end.z <= 0.0; }
};

/// Number k of a set that has every direction and crosses the horizon in a third of the cases.
Segment segment(uint k) {
    const vec2 place = sobol_owen(k, 1u);
    const vec2 turn = sobol_owen(k, 2u);
    const vec2 size = sobol_owen(k, 3u);
    const glm::dvec3 center = glm::dvec3(sample_uniform_hemisphere(place)) * (0.3 + 2.7 * double(size.x));
    glm::dvec3 axis = glm::dvec3(sample_uniform_hemisphere(turn));
    const double half = 0.05 + 1.2 * double(size.y);
    return {center - half * axis, center + half * axis};
}

/// Mean of n.L / |L|^3 over the segment, above the horizon: a sum over its points.
double truth(const Segment& s) {
    if (s.below()) return 0.0;
    double from = 0.0;
    double to = 1.0;
    const double crossing = s.start.z / (s.start.z - s.end.z);
    if (s.start.z < 0.0) from = crossing;
    if (s.end.z < 0.0) to = crossing;
    return integrate(
        [&](double t) {
            const glm::dvec3 p = s.start + t * (s.end - s.start);
            return p.z / std::pow(glm::dot(p, p), 1.5);
        },
        from, to, 200);
}

template <float (*F)(vec3, vec3, vec3, float)>
double formula(const Segment& s, double offset_m2) {
    return double(F(kUp, vec3(s.start), vec3(s.end), float(offset_m2)));
}
constexpr auto kUnclipped = formula<isotropic_line_attenuation_unclipped>;
constexpr auto kPrinted = formula<isotropic_line_attenuation_printed>;
constexpr auto kClipped = formula<isotropic_line_attenuation>;

/// Distance of the receiver's plane over a vertical line of 1 m whose middle is at this height, 1 m aside.
Segment standing(double height_m) {
    return {{1.0, 0.0, height_m - 0.5}, {1.0, 0.0, height_m + 0.5}};
}

/// Sums of errors and truths: a relative error that small values do not rule.
struct Sums {
    double error = 0.0;
    double truth = 0.0;
    double largest = 0.0;
    void add(double value, double is) {
        error += std::abs(value - is);
        truth += is;
        if (is > 1e-3) largest = std::max(largest, std::abs(value / is - 1.0));
    }
    [[nodiscard]] double percent() const { return 100.0 * error / truth; }
};

struct Errors {
    Sums equation15;        ///< above the horizon, times the length, against the integral over the length
    Sums equation15_alone;  ///< the same as printed
    Sums printed;           ///< equation 16, offset 0, segments that the horizon cuts
    Sums clipped;           ///< the same corrected
    Sums printed_all;       ///< all segments, 1 cm^2
    Sums clipped_all;
    Sums points;    ///< the line for a lamp's, a diffuse cylinder of the same lumens
    Sums cylinder;  ///< the same with the cylinder's sine towards the middle
    Sums tube;      ///< a thick tube by its axis
};

Errors measure_errors() {
    Errors e;
    for (uint k = 0; k < 4000; ++k) {
        const Segment s = segment(k);
        const double is = truth(s);
        if (is <= 0.0) continue;
        if (s.above()) {
            const double over_length = is * s.length_m();
            e.equation15.add(kUnclipped(s, 0.0) * s.length_m(), over_length);
            e.equation15_alone.add(kUnclipped(s, 0.0), over_length);
        } else {
            e.printed.add(kPrinted(s, 0.0), is);
            e.clipped.add(kClipped(s, 0.0), is);
        }
        e.printed_all.add(kPrinted(s, 1e-4), is);
        e.clipped_all.add(kClipped(s, 1e-4), is);
        const glm::dvec3 center = 0.5 * (s.start + s.end);
        const glm::dvec3 axis = glm::normalize(s.end - s.start);
        const double cylinder = line_illuminance_truth({0, 0, 1}, center, axis, 0.5 * s.length_m(), 64);
        // 1 cd across the axis: pi^2 lm, or pi / 4 cd of the points' kind.
        e.points.add(0.25 * kPi * kClipped(s, 1e-4), cylinder);
        e.cylinder.add(
            double(lamp_line_illuminance(kUp, vec3(center), vec3(axis), float(0.5 * s.length_m()))),
            cylinder);
        const TubeLight tube{center, axis, 0.5 * s.length_m(), 0.05};
        const double t =
            std::clamp(-glm::dot(s.start, s.end - s.start) / std::pow(s.length_m(), 2.0), 0.0, 1.0);
        if (k % 8u == 0u && glm::length(s.start + t * (s.end - s.start)) > 0.2) {
            e.tube.add(double(lamp_tube_projected_solid_angle(kUp, vec3(center), vec3(axis),
                                                              float(tube.half_length), float(tube.radius))),
                       illuminance_truth({0, 0, 1}, tube, 48));
        }
    }
    return e;
}

/// Height of the standing line's middle at which a formula goes out; the line itself does at -0.5 m.
double goes_out_m(double (*f)(const Segment&, double)) {
    double low = -0.6;
    double high = 0.5;
    for (int i = 0; i < 50; ++i) {
        const double middle = 0.5 * (low + high);
        (f(standing(middle), 0.0) > 1e-9 ? high : low) = middle;
    }
    return high;
}

Findings run() {
    const Errors e = measure_errors();
    Findings out;
    out.text =
        "Equation 15 is printed with dL, the length, on its left and the mean over the segment on its right: "
        "|L1 - L0| is "
        "missing (as printed it is off by " +
        number(e.equation15_alone.percent(), 3) +
        " %, with it exact). Equation 16, which stands for the mean, clamps the mean cosine instead of "
        "cutting the line at "
        "the horizon: a vertical line of 1 m at 1 m distance goes out when its middle is at " +
        fixed(goes_out_m(kPrinted), 2) +
        " m of height, where half of it is in view, and segments that the horizon cuts are off by " +
        number(e.printed.percent(), 3) +
        " %. Cut at the horizon it is exact. Its points shine alike in all directions; a lamp's diffuse "
        "cylinder does not, which makes " +
        number(e.points.percent(), 3) +
        " % for a line; times the cylinder's sine towards the middle, which is own, " +
        number(e.cylinder.percent(), 3) + " % are left, and " + number(e.tube.percent(), 3) +
        " % for a tube of 5 cm.";
    out.measured = {
        at_most("equation 15 times the length against the sum over the line", e.equation15.percent(), 0.01,
                "%"),
        within("equation 15 as printed, the same", e.equation15_alone.percent(), 52.0, 57.0, "%"),
        within("equation 16 as printed, segments that the horizon cuts", e.printed.percent(), 40.0, 45.0,
               "%"),
        at_most("equation 16 cut at the horizon, the same", e.clipped.percent(), 0.01, "%"),
        at_most("equation 16 cut at the horizon, largest of one", 100.0 * e.clipped.largest, 0.1, "%"),
        within("height of the middle at which equation 16 as printed goes out", goes_out_m(kPrinted), -0.01,
               0.01, "m"),
        within("the same, cut at the horizon", goes_out_m(kClipped), -0.51, -0.49, "m"),
        within("against a diffuse cylinder of the same lumens", e.points.percent(), 20.0, 21.0, "%"),
        at_most("the same times the sine towards the middle", e.cylinder.percent(), 12.0, "%"),
        at_most("against a tube of radius 5 cm", e.tube.percent(), 20.0, "%")};
    const auto x = linspace(-0.6, 1.0, 161);
    out.plots = {{"A vertical line of 1 m, 1 m away, rising over the horizon",
                  "",
                  {"height of its middle, m", -0.6, 1.0},
                  {"lx per cd"},
                  {curve("sum over the line", x, [](double h) { return truth(standing(h)); }),
                   curve(
                       "equation 16 as printed", x, [](double h) { return kPrinted(standing(h), 0.0); },
                       Stroke::dashed),
                   curve(
                       "cut at the horizon", x, [](double h) { return kClipped(standing(h), 0.0); },
                       Stroke::dotted)}}};
    const auto cost = [](float (*f)(vec3, vec3, vec3, float)) {
        return [f] {
            return cost_ns([f](const vec4& u) {
                return f(kUp, vec3(u.x, u.y, u.z), vec3(u.y, u.w, u.x - 0.5f), 1.0e-4f);
            });
        };
    };
    const std::string points =
        "sum over points that shine alike in all directions; every orientation, a third cut by the horizon";
    out.techniques = {
        {"isotropic_line_attenuation_printed, 1 cm^2", "Karis 2013, equation 16", "illuminance of a line",
         points, "%", e.printed_all.percent(), 100.0 * e.printed_all.largest,
         cost(isotropic_line_attenuation_printed)},
        {"isotropic_line_attenuation, 1 cm^2", "Karis 2013, equations 15 and 16, corrected",
         "illuminance of a line", points, "%", e.clipped_all.percent(), 100.0 * e.clipped_all.largest,
         cost(isotropic_line_attenuation)},
        {"isotropic_line_attenuation, for a lamp", "Karis 2013, equation 16, corrected",
         "illuminance of a line", "sum over a diffuse cylinder of the same lumens", "%", e.points.percent(),
         100.0 * e.points.largest, cost(isotropic_line_attenuation)},
        {"lamp_line_illuminance", "Karis 2013, equation 16, corrected; sine own", "illuminance of a line",
         "sum over a diffuse cylinder", "%", e.cylinder.percent(), 100.0 * e.cylinder.largest,
         [] {
             return cost_ns([](const vec4& u) {
                 return lamp_line_illuminance(kUp, vec3(u.x, u.y, u.z), vec3(1.0f, 0.0f, 0.0f), u.w);
             });
         }},
        {"lamp_tube_projected_solid_angle", "Karis 2013, equation 16, corrected",
         "illuminance of a tube per luminance", "quadrature, radius 5 cm, at least 20 cm from the axis", "%",
         e.tube.percent(), 100.0 * e.tube.largest, [] {
             return cost_ns([](const vec4& u) {
                 return lamp_tube_projected_solid_angle(kUp, vec3(u.x, u.y, u.z), vec3(1.0f, 0.0f, 0.0f), u.w,
                                                        0.05f);
             });
         }}};
    return out;
}

}  // namespace

Experiment karis2013_equation16() {
    return {"Karis 2013", "Equations 15 and 16", "The illuminance of a line light",
            "Both equations as printed and corrected (length; horizon) against sums over the line, over "
            "lamps' diffuse "
            "cylinders and over tubes.",
            run};
}

}  // namespace candela::measure::experiments
