#include <glm/geometric.hpp>

#include "candela/measure/lit_scene.hpp"
#include "candela/measure/numerics.hpp"
#include "shading/basis.glsl"
#include "shading/fresnel.glsl"
#include "shading/lights/sphere.glsl"
#include "shading/lights/units.glsl"
#include "shading/microfacet.glsl"
#include "shading/tone_curves.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;
using glm::dvec3;

constexpr float kPower_lm = 1500.0f;
constexpr float kAlpha = 0.08f;
constexpr std::array<float, 4> kRadii_m{0.05f, 0.12f, 0.22f, 0.35f};
const dvec3 kCenter(-0.7, -0.9, 1.25);

/// Integral of the specular lobe over the sphere's cone of directions, per luminance.
float specular(const vec3& n, const vec3& v, const vec3& to, float radius_m, int side) {
    vec3 t;
    vec3 b;
    const float distance = glm::length(to);
    const vec3 axis = to / distance;
    orthonormal_basis(axis, t, b);
    const float sine = std::min(radius_m / distance, 1.0f);
    const float height = sine * sine / (1.0f + std::sqrt(1.0f - sine * sine));  // 1 - cos
    float sum = 0.0f;
    for (int i = 0; i < side; ++i) {
        for (int j = 0; j < side; ++j) {
            const float z = 1.0f - height * (float(i) + 0.5f) / float(side);
            const float a = TWO_PI * (float(j) + 0.5f) / float(side);
            const float r = std::sqrt(std::max(1.0f - z * z, 0.0f));
            const vec3 l = to_world(vec3(r * std::cos(a), r * std::sin(a), z), t, b, axis);
            const float NoL = dot(n, l);
            const float NoV = std::max(dot(n, v), 1.0e-3f);
            if (NoL <= 0.0f) continue;
            const vec3 h = glm::normalize(v + l);
            sum += D_GGX(saturate(dot(n, h)), kAlpha) * V_SmithGGXCorrelated(NoV, NoL, kAlpha) *
                   F_Schlick(0.04f, 1.0f, saturate(dot(v, h))) * NoL;
        }
    }
    return sum * TWO_PI * height / float(side * side);
}

Panel picture(float radius_m, float luminance_nit) {
    LitScene scene;
    scene.width = 140;
    scene.height = 110;
    scene.balls = {{0.0, 0.1, 0.4, 0.4}};
    scene.target = dvec3(0.0, 0.0, 0.6);
    scene.field_of_view_rad = 0.5;
    scene.lamp = [=](const dvec3& origin, const dvec3& direction) {
        return ray_to_sphere(origin, direction, kCenter, double(radius_m));
    };
    return render(scene, [&](const dvec3& n, const dvec3& position) {
        const vec3 to(kCenter - position);
        const vec3 v(glm::normalize(scene.eye - position));
        const float diffuse = 0.3f * INV_PI * sphere_projected_solid_angle(vec3(n), to, radius_m);
        return tone_curve(
            kToneAces, glm::vec3((diffuse + specular(vec3(n), v, to, radius_m, 8)) * luminance_nit / 40.0f));
    });
}

Findings run() {
    Findings out;
    std::vector<Panel> by_power;
    std::vector<Panel> by_luminance;
    const float fixed_nit = sphere_nit_from_lm(kPower_lm, kRadii_m[2]);
    Table table{"One light, two units",
                {"radius, m", "1500 lm: floor, lx", "1500 lm: highlight, cd/m^2", "fixed cd/m^2: floor, lx",
                 "fixed cd/m^2: highlight, cd/m^2"},
                {}};
    std::array<double, 4> floor_lm{};
    std::array<double, 4> floor_nit{};
    std::array<double, 4> peak_lm{};
    std::array<double, 4> peak_nit{};
    const vec3 n(0.0f, 0.0f, 1.0f);
    const vec3 l = glm::normalize(vec3(-0.5f, 0.0f, 1.0f));
    const vec3 v(-l.x, 0.0f, l.z);
    for (std::size_t i = 0; i < kRadii_m.size(); ++i) {
        const float power_nit = sphere_nit_from_lm(kPower_lm, kRadii_m[i]);
        by_power.push_back(picture(kRadii_m[i], power_nit));
        by_luminance.push_back(picture(kRadii_m[i], fixed_nit));
        const double e = double(sphere_projected_solid_angle(n, 1.2f * l, kRadii_m[i]));
        const double s = double(specular(n, v, 1.2f * l, kRadii_m[i], 64));
        floor_lm[i] = e * double(power_nit);
        floor_nit[i] = e * double(fixed_nit);
        peak_lm[i] = s * double(power_nit);
        peak_nit[i] = s * double(fixed_nit);
        table.rows.push_back({number(double(kRadii_m[i])), readable(floor_lm[i]), readable(peak_lm[i]),
                              readable(floor_nit[i]), readable(peak_nit[i])});
    }
    out.text =
        "In lumens the level of illumination stays (" + number(floor_lm.front(), 4) +
        " lx for every radius) and the "
        "highlight dims by " +
        number(peak_lm.front() / peak_lm.back(), 3) +
        " times from the smallest to the largest. At a fixed luminance the level grows with the area (" +
        number(floor_nit.back() / floor_nit.front(), 3) +
        " times) and the highlight keeps the light's luminance times its reflectance once the light is "
        "larger than "
        "the lobe: " +
        number(peak_nit[3] / peak_nit[2], 3) + " times from the third to the fourth, against 2.5 in area.";
    out.measured = {
        within("1500 lm: floor, largest over smallest radius", floor_lm.back() / floor_lm.front(), 0.9999,
               1.0001),
        at_least("1500 lm: highlight, smallest over largest radius", peak_lm.front() / peak_lm.back(), 3.0),
        within("fixed luminance: floor, largest over smallest, over the areas'",
               floor_nit.back() / floor_nit.front() / 49.0, 0.9999, 1.0001),
        within("fixed luminance: highlight, fourth radius over third", peak_nit[3] / peak_nit[2], 1.0, 1.6)};
    out.pictures = {beside(by_power, "1500 lm",
                           "Radius 0.05, 0.12, 0.22 and 0.35 m: the level stays, the highlight dims."),
                    beside(by_luminance, "Fixed luminance",
                           "The same radii: the level rises, the highlight grows but keeps its luminance.")};
    out.tables = {table};
    return out;
}

}  // namespace

Experiment frostbite_figure31() {
    return {"Lagarde & de Rousiers 2014 (Frostbite)", "Figure 31", "A light's size in lumens and in nits",
            "A sphere light over a glossy floor and ball with four radii, by luminous power and by "
            "luminance; diffuse exact, "
            "specular by quadrature over the light.",
            run};
}

}  // namespace candela::measure::experiments
