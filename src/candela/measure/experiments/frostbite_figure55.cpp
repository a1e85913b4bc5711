#include <glm/geometric.hpp>

#include "candela/measure/flip_rgb.hpp"
#include "candela/measure/lit_scene.hpp"
#include "candela/measure/numerics.hpp"
#include "candela/measure/reflection_techniques.hpp"
#include "shading/tone_curves.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;

constexpr float kRoughness = 0.35f;
constexpr int kSamples = 192;
constexpr int kPrefilterSamples = 64;

/// Windows of a street at dusk, low over the floor; +Y is up.
const ImageLight& street() {
    static const ImageLight light("street", [](const vec3& d) {
        vec3 out = mix(vec3(0.5f, 0.3f, 0.2f), vec3(0.03f, 0.06f, 0.15f), sqrt(saturate(d.y * 1.5f)));
        if (d.y < 0.0f) out = vec3(0.02f);
        for (int i = 0; i < 6; ++i) {
            const float azimuth_rad = -0.75f + 0.3f * float(i);
            const vec3 axis(std::sin(azimuth_rad), 0.1f + 0.08f * float(i % 3), -std::cos(azimuth_rad));
            const vec3 colour = i % 2 == 0 ? vec3(12.0f, 7.0f, 3.0f) : vec3(4.0f, 7.0f, 12.0f);
            out += colour * smoothstep(0.9975f, 0.9985f, dot(d, normalize(axis)));
        }
        return out;
    });
    return light;
}

/// LitScene has z up.
vec3 y_up(const glm::dvec3& d) {
    return {float(d.x), float(d.z), float(-d.y)};
}

LitScene floor_scene() {
    LitScene out;
    out.eye = {0.0, -6.0, 1.1};
    out.target = {0.0, 0.0, 0.25};
    out.balls.clear();
    out.width = 120;
    out.height = 72;
    return out;
}

using Reflected = std::function<vec3(const ReceiverFrame&, float NoV)>;

Panel floor_of(const Reflected& reflected) {
    const LitScene scene = floor_scene();
    return render(scene, [&](const glm::dvec3& normal, const glm::dvec3& position) {
        ReceiverFrame frame;
        frame.n = y_up(normal);
        frame.v = normalize(y_up(scene.eye - position));
        const float NoV = std::max(dot(frame.n, frame.v), 1.0e-3f);
        frame.t = normalize(frame.v - NoV * frame.n);
        frame.b = cross(frame.n, frame.t);
        return tone_curve(kToneAces, 0.6f * reflected(frame, NoV));
    });
}

Findings run() {
    const GlossySurface surface{1.0f, kRoughness, kPrefilterSamples};
    const Panel truth = floor_of(
        [&](const ReceiverFrame& f, float) { return reflected_truth(street(), f, surface, kSamples); });
    Findings out;
    Table table{"Difference from the truth as seen", {"technique", "mean FLIP"}, {}};
    std::vector<Panel> pictures;
    std::vector<double> flips;
    const std::vector<ReflectionTechnique> techniques = direction_techniques();
    for (const std::size_t i :
         {std::size_t{0}, std::size_t{1}, std::size_t{3}, std::size_t{4}, std::size_t{5}}) {
        const ReflectionTechnique& t = techniques[i];
        pictures.push_back(floor_of(
            [&](const ReceiverFrame& f, float NoV) { return t.reflected(street(), f, NoV, surface); }));
        flips.push_back(mean_flip_of_srgb(pictures.back().rgb, truth.rgb, truth.width, truth.height));
        table.rows.push_back({t.name, number(flips.back(), 3)});
    }
    pictures.push_back(truth);
    out.pictures = {beside({pictures[0], pictures[1], pictures[2]}, "A glossy floor under a street at dusk",
                           "Mirror direction; listing 22; one fitted read."),
                    beside({pictures[3], pictures[4], pictures[5]}, "The same, stretched",
                           "Two reads; three reads; truth.")};
    out.tables = {table};
    out.text =
        "A floor of roughness 0.35, seen at 4 to 25 degrees above it. With the mirror direction lamps are "
        "round on "
        "it; they are streaks in truth, which reads in a row come close to, still lumpy. Mean FLIP " +
        number(flips[0], 2) + " with the mirror direction, " + number(flips[1], 2) + " with listing 22, " +
        number(flips[2], 2) + " with one fitted read, " + number(flips[3], 2) + " and " +
        number(flips[4], 2) + " with two and three.";
    out.measured = {
        at_least("mirror direction: mean FLIP", flips[0], 0.1),
        at_most("two reads: mean FLIP over that of the mirror direction", flips[3] / flips[0], 0.8),
        at_most("three reads: mean FLIP over that of the mirror direction", flips[4] / flips[0], 0.55)};
    return out;
}

}  // namespace

Experiment frostbite_figure55() {
    return {"Lagarde & de Rousiers 2014 (Frostbite)", "Figure 55", "Stretched reflections at grazing angles",
            "A glossy metal floor under distant lamps: techniques on perfectly prefiltered light beside the "
            "integral of the "
            "whole BRDF.",
            run};
}

}  // namespace candela::measure::experiments
