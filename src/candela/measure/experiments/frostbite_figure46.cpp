#include <glm/geometric.hpp>

#include "candela/measure/disney_figure.hpp"
#include "candela/measure/numerics.hpp"
#include "shading/lights/rectangle.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;
using glm::dvec3;

/// A wide window of light above and before the balls, on the left. right x up points away from where it
/// shines.
const dvec3 kCenter(-1.2, -1.5, 1.6);
const dvec3 kRight = glm::normalize(dvec3(1.0, -0.4, 0.0));
const dvec3 kUp = glm::cross(glm::normalize(dvec3(-0.4, -1.0, 0.8)), kRight);
constexpr double kHalfWidth_m = 1.6;
constexpr double kHalfHeight_m = 0.8;

std::vector<LightPiece> pieces() {
    constexpr int kColumns = 28;
    constexpr int kRows = 14;
    std::vector<LightPiece> out;
    for (int i = 0; i < kColumns; ++i)
        for (int j = 0; j < kRows; ++j)
            out.push_back({kCenter + kRight * (kHalfWidth_m * ((2 * i + 1.0) / kColumns - 1.0)) +
                               kUp * (kHalfHeight_m * ((2 * j + 1.0) / kRows - 1.0)),
                           -glm::cross(kRight, kUp),
                           4.0 * kHalfWidth_m * kHalfHeight_m / (kColumns * kRows)});
    return out;
}

vec3 to_center(const dvec3& position) {
    return vec3(kCenter - position);
}

Findings run() {
    DisneyFigure figure;
    figure.title = "Rectangle";
    figure.scene.target = dvec3(0.0, 0.0, 0.4);
    figure.scene.height = 100;
    figure.illuminance = [](const dvec3& n, const dvec3& position) {
        return double(rectangle_projected_solid_angle(vec3(n), to_center(position), vec3(kRight), vec3(kUp),
                                                      float(kHalfWidth_m), float(kHalfHeight_m)));
    };
    figure.pieces = pieces();
    figure.techniques = {
        {"light position", "direction_above_horizon",
         [](const dvec3& n, const dvec3& position) {
             return dvec3(direction_above_horizon(vec3(n), glm::normalize(to_center(position))));
         },
         0.017,
         [] {
             return cost_ns(
                 [](const vec4& u) { return direction_above_horizon(vec3(0.0f, 0.0f, 1.0f), vec3(u)).x; });
         }},
        {"representative point", "rectangle_representative_direction",
         [](const dvec3& n, const dvec3& position) {
             return dvec3(rectangle_representative_direction(vec3(n), to_center(position), vec3(kRight),
                                                             vec3(kUp), float(kHalfWidth_m),
                                                             float(kHalfHeight_m)));
         },
         0.019,
         [] {
             return cost_ns([](const vec4& u) {
                 return rectangle_representative_direction(
                            vec3(0.0f, 0.0f, 1.0f), vec3(u) + vec3(0.0f, 0.0f, 1.0f), vec3(1.0f, 0.0f, 0.0f),
                            vec3(0.0f, 1.0f, 0.0f), u.w, u.x)
                     .x;
             });
         }}};
    figure.white = 1.6;
    Findings out;
    add_disney_figure(out, figure);
    const double position = out.techniques[0].mean_error;
    const double point = out.techniques[1].mean_error;
    out.measured.push_back(
        at_most("representative point over light position, mean error", point / position, 1.0));
    out.tables = {{"Error of the luminance, relative to a Lambertian surface's",
                   {"direction", "mean", "largest"},
                   {{"light position", number(position, 3), number(out.techniques[0].max_error, 3)},
                    {"representative point", number(point, 3), number(out.techniques[1].max_error, 3)}}}};
    out.text = "Under a wide rectangle the BRDF at the light's position is off by " +
               number(100.0 * position, 2) + " % on average, at the representative point by " +
               number(100.0 * point, 2) +
               " % (balls, relative to a Lambertian surface): the point is the better choice, as the paper "
               "says, though the "
               "mean FLIP of the two pictures, floor included, is about the same.";
    return out;
}

}  // namespace

Experiment frostbite_figure46() {
    return {"Lagarde & de Rousiers 2014 (Frostbite)", "Figure 46", "Disney's diffuse under a rectangle",
            "Disney's diffuse at the light's position and at the representative point, times the exact "
            "illuminance, against "
            "the integral over the light.",
            run};
}

}  // namespace candela::measure::experiments
