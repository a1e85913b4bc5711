#include <array>
#include <stdexcept>

#include "candela/measure/numerics.hpp"
#include "candela/measure/specular_techniques.hpp"

namespace candela::measure::experiments {
namespace {

constexpr std::array kAlphas{0.02f, 0.05f, 0.1f, 0.2f, 0.4f, 0.8f};
constexpr std::array kSizes{0.02f, 0.1f, 0.3f, 1.0f};  ///< over the distance
constexpr std::array kAngles_deg{0.0f, 40.0f, 70.0f};

/// Faces the receiver from the mirror direction, 1 m away.
ShapedLight light_in_mirror(LightShape shape, float NoV, float size) {
    ShapedLight light;
    light.shape = shape;
    light.center = at_cosine(NoV);
    light.up = glm::vec3(0.0f, 1.0f, 0.0f);
    light.right = glm::cross(light.up, light.center);
    light.radius = size;
    light.half_width = size;
    light.half_height = 0.5f * size;
    return light;
}

/// What a technique gives over the integral.
struct Energies {
    std::array<double, kAlphas.size()> by_alpha{};  ///< means over angles, at size 0.3
    double largest = 0.0;
    double of_small_light = 0.0;  ///< largest deviation from 1 at the smallest size, alpha 0.2 on
    ErrorStatistics error;        ///< of all, against 1
};

struct Comparison {
    Energies printed;
    Energies normalized;
};

const SpecularTechnique& labelled(const std::vector<SpecularTechnique>& all, const std::string& label) {
    for (const SpecularTechnique& t : all) {
        if (t.label == label) return t;
    }
    throw std::logic_error("no such technique: " + label);
}

Comparison compare(LightShape shape) {
    const std::vector<SpecularTechnique> all = specular_techniques(shape);
    const SpecularTechnique& printed = labelled(all, "dominant direction, not normalized");
    const SpecularTechnique& normalized = labelled(all, "dominant direction");
    Comparison out;
    for (std::size_t a = 0; a < kAlphas.size(); ++a) {
        for (const float angle_deg : kAngles_deg) {
            const float NoV = std::cos(angle_deg * shading::PI / 180.0f);
            const SpecularTruth truth(NoV, kAlphas[a], specular_albedo(NoV, kAlphas[a]), 1024, 1024);
            const SpecularView view{truth.view(), kAlphas[a], truth.albedo()};
            for (const float size : kSizes) {
                const ShapedLight light = light_in_mirror(shape, NoV, size);
                const double integral = truth.integrate(light).value;
                const auto add = [&](const SpecularTechnique& t, Energies& e) {
                    const double ratio = t.estimate(light, view) / integral;
                    e.largest = std::max(e.largest, ratio);
                    e.error.add(ratio - 1.0);
                    if (size == 0.3f) e.by_alpha[a] += ratio / double(kAngles_deg.size());
                    if (size == kSizes[0] && kAlphas[a] >= 0.2f)
                        e.of_small_light = std::max(e.of_small_light, std::abs(ratio - 1.0));
                };
                add(printed, out.printed);
                add(normalized, out.normalized);
            }
        }
    }
    return out;
}

Series energies(const std::string& name, const Energies& e, Stroke stroke, int color) {
    Series out{name, {}, {}, stroke, color};
    for (std::size_t a = 0; a < kAlphas.size(); ++a) {
        out.x.push_back(double(kAlphas[a]));
        out.y.push_back(e.by_alpha[a]);
    }
    return out;
}

Findings run() {
    const Comparison disk = compare(LightShape::disk);
    const Comparison rectangle = compare(LightShape::rectangle);
    Findings out;
    out.text =
        "As printed, a disk or a rectangle whose image fills the lobe is as bright as if all of its light "
        "came from the mirror "
        "direction: up to " +
        number(disk.printed.largest, 3) + " (disk) and " + number(rectangle.printed.largest, 3) +
        " times the integral. With Karis's reasoning applied to them (own, "
        "dominant-direction-normalized) it is up to " +
        number(disk.normalized.largest, 3) + " and " + number(rectangle.normalized.largest, 3) +
        " times. Lights that are small for the lobe need no normalization: of a radius of 2 % of the "
        "distance "
        "the printed form is within " +
        number(100.0 * std::max(disk.printed.of_small_light, rectangle.printed.of_small_light), 2) +
        " % from alpha 0.2 on.";
    const auto measure = [&](const std::string& name, const Comparison& c, double largest, double normalized,
                             double improvement, double small) {
        out.measured.push_back(within(name + " as printed, largest highlight over the integral",
                                      c.printed.largest, 0.97 * largest, 1.03 * largest));
        out.measured.push_back(at_most(name + ", normalized, largest highlight over the integral",
                                       c.normalized.largest, normalized));
        out.measured.push_back(at_most(name + ", error normalized over as printed, means",
                                       c.normalized.error.mean() / c.printed.error.mean(), improvement));
        out.measured.push_back(at_most(name + " of 2 % of the distance as printed, alpha 0.2 on, error",
                                       c.printed.of_small_light, small));
    };
    measure("disk", disk, 660.0, 2.8, 0.0125, 0.042);
    measure("rectangle", rectangle, 490.0, 3.1, 0.0188, 0.047);
    out.plots = {{"Highlight over the integral, light of 0.3 of its distance in the mirror direction",
                  "Solid: as printed. Dashed: with the own normalization.",
                  {"alpha", 0.02, 0.8, Scale::logarithmic},
                  {"energy", 0.1, 1000.0, Scale::logarithmic},
                  {energies("disk", disk.printed, Stroke::solid, 0),
                   energies("rectangle", rectangle.printed, Stroke::solid, 1),
                   energies("", disk.normalized, Stroke::dashed, 0),
                   energies("", rectangle.normalized, Stroke::dashed, 1)}}};
    return out;
}

}  // namespace

Experiment frostbite_flat_highlights() {
    return {"Lagarde & de Rousiers 2014 (Frostbite)", "Section 4.7.5",
            "Highlights of disks and rectangles, which have no normalization",
            "Representative point in the dominant direction as printed, and with the own normalization, "
            "against the sampled integral; the lights face the surface from the mirror direction.",
            run};
}

}  // namespace candela::measure::experiments
