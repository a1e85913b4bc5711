#include <glm/geometric.hpp>

#include "candela/measure/lit_scene.hpp"
#include "candela/measure/numerics.hpp"
#include "shading/lights/disk.glsl"
#include "shading/lights/punctual.glsl"
#include "shading/lights/units.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;
using glm::dvec3;

constexpr float kPower_lm = 1500.0f;
constexpr float kRadius_m = 0.8f;
constexpr float kOuter_rad = 0.9f;
constexpr float kInner_rad = 0.7f;
const dvec3 kPosition(0.0, 0.2, 2.4);
const vec3 kDown(0.0f, 0.0f, -1.0f);

double angle(const vec3& to) {
    return double(
        angle_attenuation(-dot(glm::normalize(to), kDown), std::cos(kInner_rad), std::cos(kOuter_rad)));
}

double spot(const dvec3& n, const dvec3& position) {
    const vec3 to(kPosition - position);
    const double cosine = std::max(glm::dot(n, dvec3(glm::normalize(to))), 0.0);
    return double(lx_from_cd(spot_cd_from_lm(kPower_lm), glm::length(to))) * cosine * angle(to);
}

double disk(const dvec3& n, const dvec3& position) {
    const vec3 to(kPosition - position);
    const double luminance_nit = double(disk_nit_from_lm(kPower_lm, kRadius_m));
    return luminance_nit * double(disk_projected_solid_angle(vec3(n), to, kDown, kRadius_m)) *
           angle(disk_to_virtual_apex(to, kDown, kRadius_m, kOuter_rad));
}

Findings run() {
    LitScene scene;
    scene.balls = {{-1.0, 0.0, 0.4, 0.4}, {0.0, 0.2, 1.5, 0.4}, {1.0, 0.0, 0.4, 0.4}};
    scene.target = dvec3(0.0, 0.0, 0.9);
    const dvec3 up(0.0, 0.0, 1.0);
    const double far_ratio = disk(up, kPosition - 20.0 * up) / spot(up, kPosition - 20.0 * up);
    const double floor_ratio = disk(up, dvec3(0.0, 0.2, 0.0)) / spot(up, dvec3(0.0, 0.2, 0.0));
    const double near_ratio = disk(up, dvec3(0.0, 0.2, 1.9)) / spot(up, dvec3(0.0, 0.2, 1.9));
    Findings out;
    out.pictures = {beside(
        {render(scene, spot, 300.0), render(scene, disk, 300.0)}, "Spot and disk of 1500 lm",
        "Left: a spot in Frostbite's convention. Right: a disk of radius 0.8 m with the spot's attenuation "
        "by angle, from the cone's tip behind it.")};
    out.text =
        "At the same power a disk of radius 0.8 m and the spot agree from afar (" + number(far_ratio, 5) +
        " at 20 m); on the floor 2.4 m below the disk gives " + number(floor_ratio, 3) +
        " of the spot, on the ball 0.5 m below it " + number(near_ratio, 3) +
        ": the radius^2 that equation 39 adds to distance^2, the small region near the disk that the paper "
        "sees dimmer.";
    out.measured = {within("disk over spot at 20 m", far_ratio, 0.997, 1.003),
                    within("disk over spot 2.4 m below, over equation 39's",
                           floor_ratio / (2.4 * 2.4 / (2.4 * 2.4 + 0.64)), 0.999, 1.001),
                    within("disk over spot 0.5 m below, over equation 39's",
                           near_ratio / (0.25 / (0.25 + 0.64)), 0.999, 1.001)};
    const auto x = logspace(0.2, 20.0, 100);
    const auto below = [up](const Illuminance& e) {
        return [=](double d) { return e(up, kPosition - d * up); };
    };
    out.plots = {{"Illuminance below the light",
                  "",
                  {"distance, m", 0.2, 20.0, Scale::logarithmic},
                  {"illuminance, lx", 1.0, 2e4, Scale::logarithmic},
                  {curve("spot", x, below(spot)), curve("disk", x, below(disk), Stroke::dashed)}}};
    return out;
}

}  // namespace

Experiment frostbite_figure39() {
    return {"Lagarde & de Rousiers 2014 (Frostbite)", "Figure 39", "A spot light and a disk light",
            "The same luminous power from a spot and from a large disk.", run};
}

}  // namespace candela::measure::experiments
