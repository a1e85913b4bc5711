#include "shading/teaching_page.glsl"

#include "candela/measure/numerics.hpp"
#include "shading/fresnel.glsl"
#include "shading/lights/representative_point.glsl"
#include "shading/microfacet.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;

/// D G F / (4 n.l n.v) of both, F = 1; `literal` takes G1 as the page prints it.
float brdf(const vec3& v, const vec3& l, float roughness, bool literal) {
    const float alpha = alpha_from_perceptual_roughness(roughness);
    const float k = k_analytic(roughness);
    const float d = D_GGX(vec3(0, 0, 1), normalize(v + l), alpha);
    const float g = literal ? G1_TeachingPage(l.z, v.z, k) * G1_TeachingPage(v.z, v.z, k)
                            : G1_Schlick(l.z, k) * G1_Schlick(v.z, k);
    return d * g / (4.0f * l.z * v.z);
}

double albedo(double NoV, float roughness, bool literal) {
    const vec3 v = at_cosine(float(NoV));
    return integrate_hemisphere(v, alpha_from_perceptual_roughness(roughness), 96,
                                [&](const vec3& l) { return brdf(v, l, roughness, literal); });
}

struct Masking {
    double largest_ratio = 0.0;  ///< page over Karis
    double smallest_ratio = 1e9;
    double not_reciprocal = 1.0;  ///< f(l,v) / f(v,l), largest
    double largest_g = 0.0;
    ErrorStatistics error;       ///< of G, against Karis's
    ErrorStatistics visibility;  ///< of V_TeachingPage, relative, against G over 4 n.l n.v
};

Masking masking() {
    Masking out;
    for (const double roughness : linspace(0.0, 1.0, 21)) {
        const float k = k_analytic(float(roughness));
        for (const double v : linspace(0.02, 1.0, 50)) {
            for (const double l : linspace(0.02, 1.0, 50)) {
                const auto page = [k](double a, double b) {
                    return double(G1_TeachingPage(float(a), float(b), k) *
                                  G1_TeachingPage(float(b), float(b), k));
                };
                const double karis = double(G1_Schlick(float(l), k) * G1_Schlick(float(v), k));
                const double ratio = page(l, v) / karis;
                out.error.add(page(l, v) - karis);
                out.visibility.add(double(V_TeachingPage(float(v), k)) * 4.0 * l * v / page(l, v) - 1.0);
                out.largest_ratio = std::max(out.largest_ratio, ratio);
                out.smallest_ratio = std::min(out.smallest_ratio, ratio);
                out.not_reciprocal = std::max(out.not_reciprocal, page(l, v) / page(v, l));
                out.largest_g = std::max(out.largest_g, page(l, v));
            }
        }
    }
    return out;
}

double degrees_between(const vec3& a, const vec3& b) {
    return std::atan2(double(length(cross(a, b))), double(dot(a, b))) * 180.0 / kPi;
}

/// Angle between the page's representative direction and Karis's, for a light `offset_deg` beside the mirror
/// direction.
double direction_error(double view_deg, double offset_deg, double radius_over_distance) {
    const double t = view_deg * kPi / 180.0;
    const double s = (view_deg - offset_deg) * kPi / 180.0;
    const vec3 v(-std::sin(t), 0.0f, std::cos(t));
    const vec3 mirror(std::sin(t), 0.0f, std::cos(t));
    const vec3 l(std::sin(s), 0.0f, std::cos(s));
    const vec3 karis = normalize(representative_point_sphere(l, mirror, float(radius_over_distance)));
    return degrees_between(karis,
                           representative_direction_TeachingPage(l, v, mirror, float(radius_over_distance)));
}

/// The step of equation 11 with the sign that the text in hand prints, L - (L.r) r: away from the ray.
double printed_sign_error(double offset_deg, double radius) {
    const double s = offset_deg * kPi / 180.0;
    const vec3 mirror(0, 0, 1);
    const vec3 l(std::sin(s), 0.0f, std::cos(s));
    const vec3 away = 2.0f * l - representative_point_sphere(l, mirror, float(radius));
    return degrees_between(normalize(away), mirror) - offset_deg;
}

Plot albedos() {
    Plot plot{"Directional albedo of the specular term, F = 1",
              "Solid: Karis's G. Dashed: the page's G as printed.",
              {"n.v", 0.0, 1.0},
              {"albedo"},
              {}};
    int color = 0;
    for (const float roughness : {0.2f, 0.5f, 1.0f}) {
        const auto x = linspace(0.04, 1.0, 40);
        plot.series.push_back(curve(
            "roughness " + number(double(roughness)), x,
            [&](double c) { return albedo(c, roughness, false); }, Stroke::solid, color));
        plot.series.push_back(curve(
            "", x, [&](double c) { return albedo(c, roughness, true); }, Stroke::dashed, color));
        ++color;
    }
    return plot;
}

Findings run() {
    const Masking m = masking();
    ErrorStatistics d_difference;
    ErrorStatistics k_difference;
    for (const double roughness : linspace(0.1, 1.0, 46)) {
        const double alpha = roughness * roughness;
        k_difference.add(double(k_analytic(float(roughness))) - std::pow(std::sqrt(alpha) + 1.0, 2.0) / 8.0);
        for (const double c : linspace(0.0, 1.0, 201)) {
            const double base = c * c * (alpha * alpha - 1.0) + 1.0;
            d_difference.add(double(D_GGX(float(c), float(alpha))) / (alpha * alpha / (base * base * kPi)) -
                             1.0);
        }
    }
    ErrorStatistics direction;
    for (const double view : {0.0, 20.0, 40.0, 60.0}) {
        for (const double offset : {2.0, 5.0, 10.0, 20.0}) {
            for (const double radius : {0.05, 0.1, 0.2, 0.4})
                direction.add(direction_error(view, offset, radius));
        }
    }
    double brightest = 0.0;  // over Karis's albedo
    for (const double c : linspace(0.04, 1.0, 25)) {
        for (const float r : {0.2f, 0.5f, 1.0f})
            brightest = std::max(brightest, albedo(c, r, true) / albedo(c, r, false));
    }
    const double missing = 1.0 / double(representative_point_sphere_normalization(0.01f, 0.3f, 1.0f));
    Findings out;
    out.text =
        "The profile lesson-literal shades word by word, lesson with these errors corrected. D, k and F are "
        "Karis's, and alpha is the square of the roughness slider. Three things differ. (1) "
        "The page prints n.v in the "
        "denominator of G1 for the light as well: masking is then wrong by a factor between " +
        number(m.smallest_ratio, 2) + " and " + number(m.largest_ratio, 3) + ", G rises to " +
        number(m.largest_g, 3) +
        " where it must not pass 1, the directional albedo changes by up to a factor of " +
        number(brightest, 3) + ", and light and view may no longer be exchanged (factor " +
        number(m.not_reciprocal, 3) +
        "). (2) Its representative point uses v.r for l.r and the ratio radius/distance for "
        "radius/|centerToRay|; the direction is off by " +
        number(direction.mean(), 2) + " degrees on average, " + number(direction.max(), 3) +
        " at most. (3) It leaves out the energy factor (alpha/alpha')^2: at alpha 0.01 and a light of radius "
        "0.3 of its distance, highlights are " +
        number(missing, 3) +
        " times too bright. It also offers F0 = 1 for metals, one number without colour. The text of Karis "
        "2013 in hand prints the step of "
        "equation 11 with the opposite sign, which would move the point away from the ray; shading/ has it "
        "towards the ray.";
    out.measured = {
        at_most("D against equation 3, largest relative difference", d_difference.max(), 1e-4),
        at_most("k against equation 4, largest difference", k_difference.max(), 1e-6),
        within("G as printed over Karis's, largest", m.largest_ratio, 6.9, 7.1),
        within("G as printed over Karis's, smallest", m.smallest_ratio, 0.14, 0.145),
        within("G as printed, largest value (1 is the limit)", m.largest_g, 2.2, 2.4),
        within("directional albedo, G as printed over Karis's, largest", brightest, 2.2, 2.33),
        within("f(l,v) / f(v,l) with G as printed, largest (1: reciprocal)", m.not_reciprocal, 49.0, 49.5),
        at_most("V_TeachingPage (profile lesson-literal) against that G over 4 n.l n.v", m.visibility.max(),
                1e-5),
        within("representative direction against Karis's, mean", direction.mean(), 5.0, 6.0, "degrees"),
        within("representative direction against Karis's, largest", direction.max(), 29.0, 30.0, "degrees"),
        within("energy without (alpha/alpha')^2, alpha 0.01, radius 0.3", missing, 120.9, 121.1),
        at_least("equation 11 with the printed sign: angle to the ray grows by",
                 printed_sign_error(10.0, 0.1), 1.0, "degrees")};
    const auto x = linspace(0.0, 30.0, 121);
    Plot directions{"Angle between the page's representative direction and Karis's",
                    "Light of radius 0.2 of its distance.",
                    {"light's angle to the mirror direction, degrees", 0.0, 30.0},
                    {"degrees"},
                    {}};
    for (const double view : {0.0, 20.0, 40.0, 60.0})
        directions.series.push_back(curve(
            "view at " + number(view) + " degrees", x,
            [&](double o) { return direction_error(view, o, 0.2); },
            view < 30.0 ? Stroke::solid : Stroke::dashed));
    out.plots = {albedos(), directions};
    out.techniques = {
        {"G1_TeachingPage", "Teaching page, item 5", "Karis 2013, equation 4",
         "G(l,v) of equation 4, roughness 0 to 1, cosines 0.02 to 1", "", m.error.mean(), m.error.max(),
         [] { return cost_ns([](const vec4& u) { return G1_TeachingPage(u.x, u.y, 0.3f * u.z + 0.1f); }); }},
        {"representative_direction_TeachingPage", "Teaching page, item 2", "Karis 2013, equation 11",
         "direction of equation 11, view 0 to 60 degrees, radius/distance 0.05 to 0.4", "degrees",
         direction.mean(), direction.max(), [] {
             return cost_ns([](const vec4& u) {
                 return representative_direction_TeachingPage(vec3(u.x, u.y, 1), vec3(u.z, u.w, 1),
                                                              vec3(0, 0, 1), 0.2f)
                     .x;
             });
         }}};
    return out;
}

}  // namespace

Experiment teaching_page() {
    return {"Teaching page", "Sections 2 and 3", "Its complete shading model against Karis 2013",
            "D, G, F and the representative point word by word, against the formulas they stand for: "
            "masking, albedo, reciprocity, direction and energy.",
            run};
}

}  // namespace candela::measure::experiments
