#include "candela/measure/disney_figure.hpp"

#include <glm/geometric.hpp>

#include "candela/measure/flip_rgb.hpp"
#include "candela/measure/numerics.hpp"
#include "shading/diffuse.glsl"
#include "shading/tone_curves.glsl"

namespace candela::measure {
namespace {

using glm::dvec3;

constexpr int kBalls = 5;
constexpr double kSpacing_m = 0.9;

/// From 0 at the left ball to 1 at the right one; the floor is half rough.
float roughness_at(const dvec3& position) {
    if (position.z < 1e-9) return 0.5f;
    const double index = std::round(position.x / kSpacing_m + 0.5 * (kBalls - 1));
    return float(std::clamp(index, 0.0, kBalls - 1.0) / (kBalls - 1));
}

double disney(const dvec3& n, const dvec3& v, const dvec3& l, float roughness) {
    const double LoV = glm::dot(l, v);
    const auto LoH = float(std::sqrt(std::max(0.5 * (1.0 + LoV), 0.0)));
    return double(shading::Fd_DisneyRenormalized(float(std::clamp(glm::dot(n, v), 0.0, 1.0)),
                                                 float(std::clamp(glm::dot(n, l), 0.0, 1.0)), LoH,
                                                 roughness));
}

/// Luminance per luminance of the light: the BRDF integrated over it.
double integrate_over(const std::vector<LightPiece>& pieces, const dvec3& n, const dvec3& v,
                      const dvec3& position) {
    const float roughness = roughness_at(position);
    double sum = 0.0;
    for (const LightPiece& piece : pieces) {
        const dvec3 to = piece.position - position;
        const double distance2 = glm::dot(to, to);
        const dvec3 l = to / std::sqrt(distance2);
        const double cosines = std::max(glm::dot(n, l), 0.0) * std::max(-glm::dot(piece.shines, l), 0.0);
        if (cosines > 0.0) sum += cosines * piece.area / distance2 * disney(n, v, l, roughness);
    }
    return sum;
}

}  // namespace

void add_disney_figure(Findings& out, DisneyFigure figure) {
    LitScene& scene = figure.scene;
    scene.balls.clear();
    for (int i = 0; i < kBalls; ++i)
        scene.balls.emplace_back(kSpacing_m * (i - 0.5 * (kBalls - 1)), 0.0, 0.4, 0.4);
    const auto exposed = [&](double luminance) {
        return shading::tone_curve(shading::kToneAces, glm::vec3(float(luminance * kPi / figure.white)));
    };
    const auto view = [&](const dvec3& position) { return glm::normalize(scene.eye - position); };
    const Panel reference = render(scene, [&](const dvec3& n, const dvec3& position) {
        return exposed(integrate_over(figure.pieces, n, view(position), position));
    });
    std::vector<Panel> pictures;
    std::string caption = "Roughness from 0 (left) to 1. From left: ";
    for (const DisneyTechnique& technique : figure.techniques) {
        ErrorStatistics error;
        int visit = 0;
        pictures.push_back(render(scene, [&](const dvec3& n, const dvec3& position) {
            const double e = figure.illuminance(n, position);
            if (e <= 0.0) return glm::vec3(0.0f);
            const dvec3 v = view(position);
            const double luminance =
                e * disney(n, v, technique.direction(n, position), roughness_at(position));
            // Every 16th ray will do for the row.
            if (position.z > 1e-9 && ++visit % 16 == 0)
                error.add((luminance - integrate_over(figure.pieces, n, v, position)) / (e / kPi));
            return exposed(luminance);
        }));
        out.measured.push_back(
            at_most(figure.title + ", " + technique.label + ": mean FLIP",
                    mean_flip_of_srgb(pictures.back().rgb, reference.rgb, reference.width, reference.height),
                    technique.flip_at_most));
        out.techniques.push_back({technique.name + ", " + figure.title, "Frostbite section 4.7.4",
                                  "Disney's diffuse integrated over an area light",
                                  "sum over the light, relative to Lambert's, the balls of the figure", "",
                                  error.mean(), error.max(), technique.cost_ns});
        caption += technique.label + "; ";
    }
    pictures.push_back(reference);
    out.pictures.push_back(beside(pictures, figure.title, caption + "truth."));
}

}  // namespace candela::measure
