#include <glm/geometric.hpp>

#include "candela/measure/numerics.hpp"
#include "shading/basis.glsl"
#include "shading/microfacet.glsl"
#include "shading/probes/parallax.glsl"
#include "shading/transfer.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;

/// A room: a wall of stripes at its back, a glossy plane for a floor, the rest grey; seen from the front.
const vec3 kHalf(3.0f, 1.5f, 3.0f);
const vec3 kEye(0.0f, 0.3f, 2.9f);
constexpr int kWidth = 60, kHeight = 44;
constexpr uint kSamples = 128;

/// What of the room shines in a direction from a place in it.
float room(const vec3& from, const vec3& d) {
    const vec3 p = from + box_exit_m(nearest_in_proxy(kProxyBox, from, kHalf), d, kHalf) * d;
    if (p.z > -kHalf.z + 1e-3f) return 0.15f;
    return std::fmod(std::floor((p.x + 100.0f) * 4.0f), 2.0f) < 0.5f ? 0.9f : 0.02f;
}

/// The lobe about the mirror direction at a point of the floor, over its own weight.
float truth(const vec3& p, const vec3& v, float alpha) {
    double sum = 0.0;
    double weight = 0.0;
    const vec3 local_v(v.x, -v.z, v.y);
    for (uint i = 0; i < kSamples; ++i) {
        const vec3 h = sample_ggx_vndf(hammersley(i, kSamples), local_v, alpha);
        const vec3 l = 2.0f * glm::dot(local_v, h) * h - local_v;
        if (l.z <= 0.0f) continue;
        const double w = double(V_SmithGGXCorrelated(local_v.z, l.z, alpha) * l.z);
        sum += w * double(room(p, vec3(l.x, l.z, -l.y)));
        weight += w;
    }
    return float(sum / weight);
}

/// What a probe in the middle holds in a direction at a roughness: filtered with n = v = r.
float prefiltered(const vec3& direction, float perceptual_roughness) {
    const vec3 n = glm::normalize(direction);
    vec3 t;
    vec3 b;
    orthonormal_basis(n, t, b);
    double sum = 0.0;
    double weight = 0.0;
    for (uint i = 0; i < kSamples; ++i) {
        const vec3 h = sample_ggx_ndf(hammersley(i, kSamples), square(perceptual_roughness));
        const vec3 l(2.0f * h.z * h.x, 2.0f * h.z * h.y, 2.0f * h.z * h.z - 1.0f);
        if (l.z <= 0.0f) continue;
        sum += double(l.z * room(vec3(0.0f), l.x * t + l.y * b + l.z * n));
        weight += double(l.z);
    }
    return float(sum / weight);
}

struct Pictures {
    Panel panel;
    ErrorStatistics fixed;
    ErrorStatistics by_distance;
    ErrorStatistics blended;        ///< by distance, in the direction of probe_lookup()
    ErrorStatistics paper_blended;  ///< ... blended by perceptual roughness, as in appendix F
};

void put(Panel& panel, int x, int y, float value) {
    const float code = srgb_from_linear(vec3(saturate(value))).x;
    for (std::size_t c = 0; c < 3; ++c)
        panel.rgb[3 * (std::size_t(y) * panel.width + std::size_t(x)) + c] =
            std::uint8_t(std::lround(255.0f * code));
}

Pictures draw(float perceptual_roughness) {
    Pictures out;
    out.panel.title = "roughness " + number(double(perceptual_roughness));
    out.panel.caption = "Left: the truth. Middle: a probe at the surface's roughness. Right: by distance.";
    out.panel.width = std::uint32_t(3 * kWidth + 8);
    out.panel.height = kHeight;
    out.panel.zoom = 3;
    out.panel.rgb.assign(std::size_t{3} * out.panel.width * out.panel.height, 255);
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            // The floor, from the wall's foot on top to near the eye.
            const vec3 p(2.6f * (2.0f * (float(x) + 0.5f) / kWidth - 1.0f), -kHalf.y,
                         -kHalf.z + 4.0f * square((float(y) + 0.5f) / kHeight) + 0.02f);
            const vec3 v = glm::normalize(kEye - p);
            const vec3 mirror(-v.x, v.y, -v.z);
            const float true_value = truth(p, v, square(perceptual_roughness));
            const ProbeLookup at =
                probe_lookup(kProxyBox, kHalf, vec3(0.0f), p, mirror, perceptual_roughness);
            const vec3 corrected = probe_lookup(kProxyBox, kHalf, vec3(0.0f), p, mirror, 0.0f).direction;
            const float by_distance = prefiltered(corrected, at.perceptual_roughness);
            const float fixed = prefiltered(corrected, perceptual_roughness);
            out.fixed.add(double(fixed - true_value));
            out.by_distance.add(double(by_distance - true_value));
            const vec3 as_paper = glm::mix(corrected, mirror, perceptual_roughness);
            out.paper_blended.add(double(prefiltered(as_paper, at.perceptual_roughness) - true_value));
            out.blended.add(double(prefiltered(at.direction, at.perceptual_roughness) - true_value));
            put(out.panel, x, y, true_value);
            put(out.panel, kWidth + 4 + x, y, fixed);
            put(out.panel, 2 * kWidth + 8 + x, y, by_distance);
        }
    }
    return out;
}

Findings run() {
    Findings out;
    Table table{"Mean error of reflected luminance, display white 1",
                {"roughness", "as it is", "by distance", "and blended by alpha squared",
                 "and blended as in appendix F"},
                {}};
    for (const float roughness : {0.2f, 0.4f}) {
        const Pictures p = draw(roughness);
        if (roughness < 0.3f) {
            out.measured.push_back(
                at_most("roughness 0.2: mean error of the blend by alpha squared over the paper's",
                        p.blended.mean() / p.paper_blended.mean(), 0.4));
        }
        const std::string name = "roughness " + number(double(roughness));
        out.measured.push_back(at_most(name + ": mean error by distance over that without",
                                       p.by_distance.mean() / p.fixed.mean(), 0.95));
        table.rows.push_back({number(double(roughness)), readable(p.fixed.mean()),
                              readable(p.by_distance.mean()), readable(p.blended.mean()),
                              readable(p.paper_blended.mean())});
        out.pictures.push_back(p.panel);
    }
    out.tables = {table};
    out.text =
        "Stripes of a wall in a glossy floor, with a probe in the middle of the room, read in the corrected "
        "direction. "
        "At the wall's foot the truth is sharp and a filtered probe is not; the relation of listing 25 "
        "restores that. "
        "Appendix F blends the direction towards the uncorrected one by perceptual roughness: a fifth of the "
        "way at "
        "roughness 0.2, which moves the stripes from their place. By alpha squared, as the frame does it, "
        "rough surfaces "
        "get their smooth direction and glossy ones keep theirs.";
    return out;
}

}  // namespace

Experiment frostbite_figure61() {
    return {"Lagarde & de Rousiers 2014 (Frostbite)", "Figure 61",
            "Distance-based roughness on a glossy floor",
            "A textured wall in a glossy plane: the lobe integrated at the surface, and read from a probe "
            "with and without "
            "listing 25.",
            run};
}

}  // namespace candela::measure::experiments
