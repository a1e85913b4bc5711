#include "candela/measure/numerics.hpp"
#include "shading/probes/composition.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;

/// Light of `count` equal probes over a distant light of 0: what the smaller ones leave to the rest.
double lobe_answered(int count, double visibility) {
    ProbeSum sum = empty_probe_sum();
    for (int i = 0; i < count; ++i) add_probe(sum, vec3(1.0f), float(visibility));
    return double(sum.alpha);
}

/// The algorithm before version 2.0 of the paper, as its list of corrections describes it ("Version", section
/// 4.9.5): each probe is taken to see another part of the lobe.
double lobe_answered_before(int count, double visibility) {
    return std::min(1.0, count * visibility);
}

Findings run() {
    ErrorStatistics uniform;
    for (uint i = 0; i < 1024; ++i) {
        ProbeSum sum = empty_probe_sum();
        for (uint k = 0; k < 4; ++k) add_probe(sum, vec3(3.0f), sobol_owen(i, k).x);
        uniform.add(double(add_distant(sum, vec3(3.0f)).x) / 3.0 - 1.0);
    }
    // The rays of the figure: (1) meets what the small probe A saw, (2) passes A's empty part and meets B,
    // (3) neither.
    const auto ray = [](float in_a, float in_b) {
        ProbeSum sum = empty_probe_sum();
        add_probe(sum, vec3(0.0f, 1.0f, 0.0f), in_a);
        add_probe(sum, vec3(1.0f, 0.0f, 0.0f), in_b);
        return add_distant(sum, vec3(0.0f, 0.0f, 1.0f));
    };
    const vec3 one = ray(1.0f, 1.0f);
    const vec3 two = ray(0.0f, 1.0f);
    const vec3 three = ray(0.0f, 0.0f);
    Findings out;
    out.text =
        "Ten overlapping probes of visibility 0.1 answer for 0.1 of the lobe, as one does; before the "
        "correction they "
        "answered for all of it, and the sky went dark behind them. Light that is the same everywhere stays "
        "what it "
        "is, whatever the probes see. Rays (1), (2) and (3) of the figure end at A, B and the sky.";
    out.measured = {within("ten probes of visibility 0.1: part of the lobe", lobe_answered(10, 0.1),
                           0.1 - 1e-6, 0.1 + 1e-6),
                    at_most("four probes in uniform light, largest relative error", uniform.max(), 1e-6),
                    within("ray (1): share of A", double(one.y), 1.0, 1.0),
                    within("ray (2): share of B", double(two.x), 1.0, 1.0),
                    within("ray (3): share of the sky", double(three.z), 1.0, 1.0)};
    const auto x = linspace(0.0, 1.0, 101);
    out.plots = {
        {"Part of the lobe that overlapping probes answer for",
         "Solid: the corrected algorithm, the same for any number. Dashed: as it was.",
         {"visibility of each probe", 0.0, 1.0},
         {"part of the lobe", 0.0, 1.05},
         {curve("corrected, 1 to 10 probes", x, [](double v) { return lobe_answered(10, v); }),
          curve(
              "before, 2 probes", x, [](double v) { return lobe_answered_before(2, v); }, Stroke::dashed),
          curve(
              "before, 10 probes", x, [](double v) { return lobe_answered_before(10, v); },
              Stroke::dashed)}}};
    return out;
}

}  // namespace

Experiment frostbite_figure62() {
    return {"Lagarde & de Rousiers 2014 (Frostbite)", "Figure 62",
            "Composition of local probes and the distant light",
            "Shares of nested and overlapping probes by section 4.9.5's corrected algorithm.", run};
}

}  // namespace candela::measure::experiments
