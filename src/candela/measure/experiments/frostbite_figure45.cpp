#include <glm/geometric.hpp>

#include "candela/measure/disney_figure.hpp"
#include "candela/measure/numerics.hpp"
#include "shading/lights/disk.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;
using glm::dvec3;

const dvec3 kCenter(0.0, -0.6, 1.9);
const dvec3 kShines = glm::normalize(dvec3(0.0, 0.3, -1.0));
constexpr double kRadius_m = 0.9;

std::vector<LightPiece> pieces() {
    constexpr int kRings = 12;
    constexpr int kSectors = 24;
    const dvec3 x(1.0, 0.0, 0.0);
    const dvec3 y = glm::cross(kShines, x);
    std::vector<LightPiece> out;
    for (int i = 0; i < kRings; ++i) {
        for (int j = 0; j < kSectors; ++j) {
            const double r = kRadius_m * std::sqrt((i + 0.5) / kRings);
            const double a = 2.0 * kPi * (j + 0.5) / kSectors;
            out.push_back({kCenter + r * (std::cos(a) * x + std::sin(a) * y), kShines,
                           kPi * kRadius_m * kRadius_m / (kRings * kSectors)});
        }
    }
    return out;
}

vec3 to_center(const dvec3& position) {
    return vec3(kCenter - position);
}

Findings run() {
    DisneyFigure figure;
    figure.title = "Disk";
    figure.scene.target = dvec3(0.0, 0.0, 0.4);
    figure.scene.height = 100;
    figure.illuminance = [](const dvec3& n, const dvec3& position) {
        return double(
            disk_projected_solid_angle(vec3(n), to_center(position), vec3(kShines), float(kRadius_m)));
    };
    figure.pieces = pieces();
    figure.techniques = {
        {"light position", "direction_above_horizon",
         [](const dvec3& n, const dvec3& position) {
             return dvec3(direction_above_horizon(vec3(n), glm::normalize(to_center(position))));
         },
         0.009,
         [] {
             return cost_ns(
                 [](const vec4& u) { return direction_above_horizon(vec3(0.0f, 0.0f, 1.0f), vec3(u)).x; });
         }},
        {"representative point", "disk_representative_direction",
         [](const dvec3& n, const dvec3& position) {
             return dvec3(disk_representative_direction(vec3(n), to_center(position), vec3(kShines),
                                                        float(kRadius_m)));
         },
         0.013,
         [] {
             return cost_ns([](const vec4& u) {
                 return disk_representative_direction(vec3(0.0f, 0.0f, 1.0f),
                                                      vec3(u) + vec3(0.0f, 0.0f, 1.0f),
                                                      vec3(0.0f, 0.0f, -1.0f), u.w)
                     .x;
             });
         }}};
    figure.white = 1.6;
    Findings out;
    add_disney_figure(out, figure);
    out.tables = {
        {"Error of the luminance, relative to a Lambertian surface's",
         {"direction", "mean", "largest"},
         {{"light position", number(out.techniques[0].mean_error, 3), number(out.techniques[0].max_error, 3)},
          {"representative point", number(out.techniques[1].mean_error, 3),
           number(out.techniques[1].max_error, 3)}}}};
    out.text = "Under a disk the BRDF at the light's position is within " +
               number(100.0 * out.techniques[0].mean_error, 2) +
               " % on average of the integral over the light: close, as the paper says. The representative "
               "point is within " +
               number(100.0 * out.techniques[1].mean_error, 2) + " %.";
    return out;
}

}  // namespace

Experiment frostbite_figure45() {
    return {
        "Lagarde & de Rousiers 2014 (Frostbite)", "Figure 45", "Disney's diffuse under a disk",
        "Disney's diffuse at one direction times the exact illuminance, against the integral over the light.",
        run};
}

}  // namespace candela::measure::experiments
