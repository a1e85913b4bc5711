#include <map>

#include "candela/measure/numerics.hpp"
#include "candela/measure/reflection_techniques.hpp"

namespace candela::measure::experiments {
namespace {

using namespace shading;

constexpr std::array<float, 6> kRoughness{0.1f, 0.25f, 0.4f, 0.6f, 0.8f, 1.0f};
constexpr std::array<float, 6> kCosines{0.08f, 0.2f, 0.35f, 0.55f, 0.75f, 0.95f};
constexpr int kTurns = 8;
constexpr int kSamples = 768;

/// Differences and what they are differences from, summed.
struct Share {
    double difference = 0.0;
    double light = 0.0;
    void add(const vec3& value, const vec3& truth) {
        difference += double(std::abs(luminance(value) - luminance(truth)));
        light += double(luminance(truth));
    }
    [[nodiscard]] double percent() const { return 100.0 * difference / light; }
};

/// Of one technique: by light, by roughness, by angle, each over all others. Lights are of equal weight.
struct Errors {
    std::array<Share, 6> light;
    std::array<std::array<Share, 6>, 6> roughness;  ///< [light][roughness]
    std::array<std::array<Share, 6>, 6> angle;

    void add(std::size_t l, std::size_t r, std::size_t a, const vec3& value, const vec3& truth) {
        light[l].add(value, truth);
        roughness[l][r].add(value, truth);
        angle[l][a].add(value, truth);
    }
    [[nodiscard]] double mean() const {
        double sum = 0.0;
        for (const Share& s : light) sum += s.percent() / double(light.size());
        return sum;
    }
    [[nodiscard]] double largest() const {
        double out = 0.0;
        for (const auto& of_light : roughness)
            for (const Share& s : of_light) out = std::max(out, s.percent());
        return out;
    }
    [[nodiscard]] static double over_lights(const std::array<std::array<Share, 6>, 6>& table, std::size_t i) {
        double sum = 0.0;
        for (const auto& of_light : table) sum += of_light[i].percent() / double(table.size());
        return sum;
    }
};

std::vector<Errors> measure_all(const std::vector<ReflectionTechnique>& techniques, float f0) {
    std::vector<Errors> out(techniques.size());
    const std::vector<ImageLight>& lights = image_lights();
    for (std::size_t l = 0; l < lights.size(); ++l)
        for (std::size_t r = 0; r < kRoughness.size(); ++r)
            for (std::size_t a = 0; a < kCosines.size(); ++a)
                for (int turn = 0; turn < kTurns; ++turn) {
                    const ReceiverFrame frame = receiver_frame(kCosines[a], turn, kTurns);
                    const GlossySurface surface{f0, kRoughness[r]};
                    const vec3 truth = reflected_truth(lights[l], frame, surface, kSamples);
                    for (std::size_t i = 0; i < techniques.size(); ++i)
                        out[i].add(l, r, a, techniques[i].reflected(lights[l], frame, kCosines[a], surface), truth);
                }
    return out;
}

Table by_light(const std::vector<ReflectionTechnique>& techniques, const std::vector<Errors>& errors,
               const std::string& title) {
    Table out{title, {"technique"}, {}};
    for (const ImageLight& light : image_lights()) out.columns.push_back(light.name());
    out.columns.emplace_back("mean");
    for (std::size_t i = 0; i < techniques.size(); ++i) {
        out.rows.push_back({techniques[i].name});
        for (const Share& s : errors[i].light) out.rows.back().push_back(fixed(s.percent(), 2));
        out.rows.back().push_back(fixed(errors[i].mean(), 2));
    }
    return out;
}

Plot over(const std::string& title, const std::string& label, const std::vector<ReflectionTechnique>& techniques,
          const std::vector<Errors>& errors, const std::array<float, 6>& x,
          std::array<std::array<Share, 6>, 6> Errors::*table) {
    Plot out{title, "Mean over six lights and all else.", {label, 0.0, 1.0}, {"% of the light", 0.0, 0.0}, {}};
    for (std::size_t i = 0; i < techniques.size(); ++i) {
        Series s{techniques[i].name, {}, {}};
        for (std::size_t k = 0; k < x.size(); ++k) {
            s.x.push_back(double(x[k]));
            s.y.push_back(Errors::over_lights(errors[i].*table, k));
        }
        out.series.push_back(std::move(s));
    }
    return out;
}

Findings run() {
    std::vector<ReflectionTechnique> all = direction_techniques();
    const std::size_t directions = all.size();
    for (ReflectionTechnique& t : reflectance_techniques()) all.push_back(std::move(t));
    std::vector<ReflectionTechnique> of_metal = all;
    // There is no non-metal among the metals.
    of_metal.erase(of_metal.begin() + std::ptrdiff_t(directions) + 1);
    const std::vector<Errors> metal = measure_all(of_metal, 1.0f);
    const std::vector<Errors> plastic = measure_all(all, 0.04f);
    const std::vector<ReflectionTechnique> by_direction(all.begin(), all.begin() + std::ptrdiff_t(directions));

    Findings out;
    out.tables = {by_light(of_metal, metal, "F0 = 1: mean error in % of the reflected light"),
                  by_light(all, plastic, "F0 = 0.04: mean error in % of the reflected light")};
    out.plots = {over("F0 = 1 over roughness", "perceptual roughness", by_direction, metal, kRoughness,
                      &Errors::roughness),
                 over("F0 = 1 over the angle", "n.v", by_direction, metal, kCosines, &Errors::angle),
                 over("F0 = 0.04 over the angle", "n.v", by_direction, plastic, kCosines, &Errors::angle)};
    const std::array<double, 6> bounds{40.0, 25.0, 36.0, 12.0, 8.0, 7.0};
    for (std::size_t i = 0; i < directions; ++i)
        out.measured.push_back(
            at_most(all[i].name + ", mean error, F0 = 1", metal[i].mean(), bounds[i], "%"));
    out.measured.push_back(at_most("three reads over the mirror direction", metal[5].mean() / metal[0].mean(), 0.25));
    out.measured.push_back(
        at_most("three reads over the mirror direction, F0 = 0.04", plastic[5].mean() / plastic[0].mean(), 0.6));
    out.text = "Error of the reflected light over roughness 0.1 to 1, n.v 0.08 to 0.95 and six lights: " +
               number(metal[0].mean(), 2) + " % of white metal's with the mirror direction, " +
               number(metal[1].mean(), 2) + " with listing 22, " + number(metal[3].mean(), 2) +
               " with one read at the fitted place, " + number(metal[4].mean(), 2) + " and " +
               number(metal[5].mean(), 2) + " with two and three along the lobe.";
    const auto add_rows = [&](const std::vector<ReflectionTechnique>& techniques, const std::vector<Errors>& errors,
                              std::size_t first, const std::string& material) {
        for (std::size_t i = first; i < techniques.size(); ++i)
            out.techniques.push_back({techniques[i].function + ", " + material, techniques[i].source,
                                      "light reflected from the surroundings",
                                      "integral of L D V F n.l, six lights, roughness 0.1 to 1, n.v 0.08 to 0.95; "
                                      "largest: of one light and roughness",
                                      "%", errors[i].mean(), errors[i].largest(), techniques[i].cost_ns});
    };
    add_rows(of_metal, metal, 0, "F0 = 1");
    add_rows(all, plastic, 0, "F0 = 0.04");
    return out;
}

}  // namespace

Experiment image_light_reflection() {
    return {"Lagarde & de Rousiers 2014 (Frostbite)", "Figure 59, in numbers", "What the split sum loses, and what gets it back",
            "Each technique on perfectly prefiltered light against the integral of the whole BRDF over six generated lights.",
            run};
}

}  // namespace candela::measure::experiments
