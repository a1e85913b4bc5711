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

/// With the cones of listing 9.
double disk_of(float radius_m, const dvec3& n, const dvec3& position) {
    const vec3 to(kPosition - position);
    const double luminance_nit = double(disk_nit_from_lm(kPower_lm, radius_m));
    return luminance_nit * double(disk_projected_solid_angle(vec3(n), to, kDown, radius_m)) *
           double(disk_cone_attenuation(to, kDown, radius_m, std::cos(kInner_rad), std::cos(kOuter_rad)));
}
double disk(const dvec3& n, const dvec3& position) {
    return disk_of(kRadius_m, n, position);
}

/// Differences on the floor to the spot times the disk's own cosine, over the spot's illuminance below it.
ErrorStatistics differences_on_floor(float radius_m) {
    const dvec3 up(0.0, 0.0, 1.0);
    const dvec3 below(0.0, 0.2, 0.0);
    ErrorStatistics out;
    for (const double x : linspace(0.0, 4.0, 101)) {
        const dvec3 at = below + dvec3(x, 0.0, 0.0);
        const double cosine = glm::dot(glm::normalize(at - kPosition), dvec3(kDown));
        out.add((disk_of(radius_m, up, at) - cosine * spot(up, at)) / spot(up, below));
    }
    return out;
}
/// Distance from the axis on the floor where the disk's light ends.
double edge_m(float radius_m) {
    double low = 0.0;
    double high = 20.0;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (disk_of(radius_m, {0.0, 0.0, 1.0}, {middle, 0.2, 0.0}) > 0.0 ? low : high) = middle;
    }
    return low;
}

Findings run() {
    LitScene scene;
    scene.balls = {{-1.0, 0.0, 0.4, 0.4}, {0.0, 0.2, 1.5, 0.4}, {1.0, 0.0, 0.4, 0.4}};
    scene.target = dvec3(0.0, 0.0, 0.9);
    const dvec3 up(0.0, 0.0, 1.0);
    const double far_ratio = disk(up, kPosition - 20.0 * up) / spot(up, kPosition - 20.0 * up);
    const double floor_ratio = disk(up, dvec3(0.0, 0.2, 0.0)) / spot(up, dvec3(0.0, 0.2, 0.0));
    const double near_ratio = disk(up, dvec3(0.0, 0.2, 1.9)) / spot(up, dvec3(0.0, 0.2, 1.9));
    const ErrorStatistics on_floor = differences_on_floor(kRadius_m);
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
        "sees dimmer. Listing 9 puts the tip of the disk's cone behind it, so that the cone's rim is the "
        "disk's: on the floor the light ends " +
        number(edge_m(kRadius_m) - edge_m(1e-3f), 3) +
        " m further out than the spot's. As the disk shrinks it becomes the spot but for the cosine at a "
        "disk: "
        "the rest is " +
        number(100.0 * on_floor.max(), 2) + " % at 0.8 m and " +
        number(100.0 * differences_on_floor(0.01f).max(), 2) + " % at 1 cm.";
    out.measured = {
        within("disk over spot at 20 m", far_ratio, 0.997, 1.003),
        within("disk over spot 2.4 m below, over equation 39's",
               floor_ratio / (2.4 * 2.4 / (2.4 * 2.4 + 0.64)), 0.999, 1.001),
        within("disk over spot 0.5 m below, over equation 39's", near_ratio / (0.25 / (0.25 + 0.64)), 0.999,
               1.001),
        within("where the light ends on the floor, over the spot's distance and the radius",
               edge_m(kRadius_m) / (2.4 * std::tan(double(kOuter_rad)) + double(kRadius_m)), 0.999, 1.001),
        at_most("disk of 1 cm against the spot times the cosine at a disk, largest difference on the floor",
                100.0 * differences_on_floor(0.01f).max(), 0.6, "%"),
        at_most("the same, over a disk of 4 cm",
                differences_on_floor(0.01f).max() / differences_on_floor(0.04f).max(), 0.3)};
    const auto x = logspace(0.2, 20.0, 100);
    const auto below = [up](const Illuminance& e) {
        return [=](double d) { return e(up, kPosition - d * up); };
    };
    out.plots = {{"Illuminance below the light",
                  "",
                  {"distance, m", 0.2, 20.0, Scale::logarithmic},
                  {"illuminance, lx", 1.0, 2e4, Scale::logarithmic},
                  {curve("spot", x, below(spot)), curve("disk", x, below(disk), Stroke::dashed)}}};
    out.techniques = {
        {"disk_cone_attenuation, radius 0.8 m", "Frostbite, section 4.7.2.3, listing 9",
         "the cones of a disk light",
         "a spot of the same power times the cosine at a disk, floor 2.4 m below, 1: straight below", "",
         on_floor.mean(), on_floor.max(), [] {
             return cost_ns([](const vec4& u) {
                 return disk_cone_attenuation(vec3(u.x, u.y, u.z - 2.0f), kDown, u.w, 0.9f, 0.5f);
             });
         }}};
    return out;
}

}  // namespace

Experiment frostbite_figure39() {
    return {"Lagarde & de Rousiers 2014 (Frostbite)", "Figure 39 and listing 9",
            "A spot light and a disk light",
            "The same luminous power from a spot and from a large disk with the spot's cones.", run};
}

}  // namespace candela::measure::experiments
