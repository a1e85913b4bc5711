#include <glm/geometric.hpp>

#include "candela/measure/light_errors.hpp"
#include "shading/basis.glsl"
#include "shading/layer_reflection.glsl"
#include "shading/sampling.glsl"
#include "shading/sheen.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;

const std::vector<float> kCosines{0.1f, 0.3f, 0.6f, 0.9f};
constexpr int kTurns = 6;
constexpr int kSamples = 768;

/// A lobe of one layer, its settings and ways to see the surroundings in it.
struct Layer {
    std::string name;
    std::vector<vec2> settings;
    /// Light over the lobe, over the lobe.
    std::function<vec3(const ImageLight&, const ReceiverFrame&, const vec2&)> truth;
    struct Way {
        std::string name;
        std::string source;
        std::function<vec3(const ImageLight&, const ReceiverFrame&, float NoV, const vec2&)> seen;
        std::function<double()> cost_ns;
    };
    std::vector<Way> ways;
};

vec3 prefiltered(const ImageLight& light, const LobeRead& read) {
    return read.weight * light.prefiltered(read.direction, read.perceptual_roughness);
}

vec3 mirror_of(const ReceiverFrame& f) {
    return reflect(-f.v, f.n);
}

/// For what a lobe's integral is over.
const ImageLight& white_light() {
    static const ImageLight light("white", [](const vec3&) { return vec3(1.0f); });
    return light;
}

/// A surface's tangent is not the plane of incidence's: turned by a third of a right angle.
struct Grain {
    vec3 t;
    vec3 b;
};
Grain grain_of(const ReceiverFrame& f) {
    const vec3 t = std::cos(0.52f) * f.t + std::sin(0.52f) * f.b;
    return {t, cross(f.n, t)};
}

/// x: perceptual roughness, y: strength.
Layer anisotropic_metal() {
    Layer out{
        "anisotropic metal",
        {{0.2f, 0.4f}, {0.2f, 0.8f}, {0.4f, 0.5f}, {0.4f, 0.9f}, {0.6f, 0.7f}},
        [](const ImageLight& light, const ReceiverFrame& f, const vec2& s) {
            const Grain g = grain_of(f);
            const ReceiverFrame turned{g.t, g.b, f.n, f.v};
            const vec2 alpha = anisotropic_alpha(s.x, s.y);
            const vec3 v = to_local(f.v, g.t, g.b, f.n);
            const auto lobe = [&](const vec3& l) {
                const vec3 h = normalize(v + l);
                return vec3(D_GGXAnisotropic(h.z, h.x, h.y, alpha.x, alpha.y) * l.z *
                            V_SmithGGXCorrelatedAnisotropic(v.z, v.x, v.y, l.z, l.x, l.y, alpha.x, alpha.y));
            };
            return integrate_light_ggx(light, turned, alpha, kSamples, lobe) /
                   integrate_light_ggx(white_light(), turned, alpha, kSamples, lobe);
        },
        {}};
    out.ways.push_back({"mirror direction as if isotropic", "Karis 2013",
                        [](const ImageLight& light, const ReceiverFrame& f, float, const vec2& s) {
                            return light.prefiltered(mirror_of(f), s.x);
                        },
                        [] { return cost_ns([](const vec4& u) { return 2.0f * u.x * u.y - u.z; }); }});
    out.ways.push_back({"anisotropic_bent_normal", "Revie 2011; KHR_materials_anisotropy",
                        [](const ImageLight& light, const ReceiverFrame& f, float, const vec2& s) {
                            const vec3 bent = anisotropic_bent_normal(f.n, grain_of(f).b, f.v, s.y, s.x);
                            return light.prefiltered(reflect(-f.v, bent), s.x);
                        },
                        [] {
                            return cost_ns([](const vec4& u) {
                                return anisotropic_bent_normal(vec3(0, 0, 1), vec3(0, 1, 0),
                                                               vec3(u.x, u.y, u.z), u.w, 0.5f)
                                    .x;
                            });
                        }});
    const auto row = [](const vec3& n, const Grain& g, const vec3& v, float NoV, const vec2& s, auto add) {
        const AnisotropicLobe lobe = anisotropic_lobe(n, g.t, g.b, v, NoV, anisotropic_alpha(s.x, s.y));
        for (int i = 0; i < kAnisotropicReads; ++i) add(anisotropic_read(lobe, i));
    };
    out.ways.push_back({"anisotropic_read, five of them", "own, shading/layer_reflection.glsl",
                        [row](const ImageLight& light, const ReceiverFrame& f, float NoV, const vec2& s) {
                            vec3 sum(0.0f);
                            float weights = 0.0f;
                            row(f.n, grain_of(f), f.v, NoV, s, [&](const LobeRead& read) {
                                sum += prefiltered(light, read);
                                weights += read.weight;
                            });
                            return sum / weights;
                        },
                        [row] {
                            return cost_ns([row](const vec4& u) {
                                float sum = 0.0f;
                                const vec3 v(std::sqrt(1.0f - u.x * u.x), 0.0f, u.x);
                                row(vec3(0, 0, 1), {vec3(1, 0, 0), vec3(0, 1, 0)}, v, u.x, vec2(u.y, u.z),
                                    [&](const LobeRead& read) { sum += read.weight * read.direction.x; });
                                return sum;
                            });
                        }});
    return out;
}

/// x: sheen roughness.
Layer sheen() {
    Layer out{"sheen",
              {{0.15f, 0.0f}, {0.3f, 0.0f}, {0.5f, 0.0f}, {0.8f, 0.0f}},
              [](const ImageLight& light, const ReceiverFrame& f, const vec2& s) {
                  const vec3 v = to_local(f.v, f.t, f.b, f.n);
                  float albedo = 0.0f;
                  // Spaced into the band along the horizon, as integrate_sheen_albedo has it.
                  const vec3 sum = integrate_light(
                      light, f, kSamples,
                      [](const vec2& u) {
                          const float NoL = u.x * u.x;
                          const float sine = std::sqrt(1.0f - NoL * NoL);
                          const float phi = TWO_PI * u.y;
                          return DrawnDirection{vec3(sine * std::cos(phi), sine * std::sin(phi), NoL),
                                                1.0f / (2.0f * u.x * TWO_PI)};
                      },
                      [&](const vec3& l) {
                          const float value = evaluate_sheen(v.z, l.z, normalize(v + l).z, s.x) * l.z;
                          albedo += value * 2.0f * std::sqrt(l.z) * TWO_PI / float(kSamples);
                          return vec3(value);
                      });
                  return sum / albedo;
              },
              {}};
    out.ways.push_back({"irradiance", "KHR_materials_sheen without a map of its own",
                        [](const ImageLight& light, const ReceiverFrame& f, float, const vec2&) {
                            return light.irradiance_over_pi(f.n);
                        },
                        [] { return cost_ns([](const vec4& u) { return u.x; }); }});
    out.ways.push_back({"sheen_read", "own fit, shading/layer_reflection.glsl",
                        [](const ImageLight& light, const ReceiverFrame& f, float NoV, const vec2& s) {
                            return prefiltered(light, sheen_read(f.n, f.v, NoV, s.x));
                        },
                        [] {
                            return cost_ns([](const vec4& u) {
                                const LobeRead read =
                                    sheen_read(vec3(0, 0, 1), vec3(u.w, 0.0f, u.x), u.x, u.y);
                                return read.direction.x + read.perceptual_roughness;
                            });
                        }});
    return out;
}

/// x: the coat's roughness. Its Fresnel is taken at the normal, so the lobe is D V n.l.
Layer coat() {
    Layer out{"clear coat",
              {{0.05f, 0.0f}, {0.15f, 0.0f}, {0.3f, 0.0f}},
              [](const ImageLight& light, const ReceiverFrame& f, const vec2& s) {
                  const float alpha = alpha_from_perceptual_roughness(s.x);
                  const vec3 v = to_local(f.v, f.t, f.b, f.n);
                  const auto lobe = [&](const vec3& l) {
                      return vec3(D_GGX(vec3(0, 0, 1), normalize(v + l), alpha) *
                                  V_SmithGGXCorrelated(v.z, l.z, alpha) * l.z);
                  };
                  return integrate_light_ggx(light, f, vec2(alpha), kSamples, lobe) /
                         integrate_light_ggx(white_light(), f, vec2(alpha), kSamples, lobe);
              },
              {}};
    out.ways.push_back({"mirror direction", "Karis 2013",
                        [](const ImageLight& light, const ReceiverFrame& f, float, const vec2& s) {
                            return light.prefiltered(mirror_of(f), s.x);
                        },
                        [] { return cost_ns([](const vec4& u) { return 2.0f * u.x * u.y - u.z; }); }});
    out.ways.push_back({"stretched_reflection_2", "own fit, shading/stretched_reflection.glsl",
                        [](const ImageLight& light, const ReceiverFrame& f, float NoV, const vec2& s) {
                            LobeRead a;
                            LobeRead b;
                            stretched_reflection_2(f.n, f.v, NoV, s.x, 0.0f, a, b);
                            return prefiltered(light, a) + prefiltered(light, b);
                        },
                        [] {
                            return cost_ns([](const vec4& u) {
                                LobeRead a;
                                LobeRead b;
                                stretched_reflection_2(vec3(0, 0, 1), vec3(u.w, 0.0f, u.x), u.x, u.y, 0.0f, a,
                                                       b);
                                return a.direction.x + a.weight + b.direction.x;
                            });
                        }});
    return out;
}

std::vector<LightErrors> errors_of(const Layer& layer) {
    std::vector<LightErrors> out(layer.ways.size(), LightErrors(layer.settings.size(), kCosines.size()));
    for (std::size_t l = 0; l < image_lights().size(); ++l)
        for (std::size_t s = 0; s < layer.settings.size(); ++s)
            for (std::size_t a = 0; a < kCosines.size(); ++a)
                for (int turn = 0; turn < kTurns; ++turn) {
                    const ImageLight& light = image_lights()[l];
                    const auto cells = int(layer.settings.size() * kCosines.size());
                    const ReceiverFrame frame = receiver_frame(
                        kCosines[a], turn * cells + int(s * kCosines.size() + a), kTurns * cells);
                    const vec3 truth = layer.truth(light, frame, layer.settings[s]);
                    for (std::size_t i = 0; i < layer.ways.size(); ++i)
                        out[i].add(l, s, a, layer.ways[i].seen(light, frame, kCosines[a], layer.settings[s]),
                                   truth);
                }
    return out;
}

Findings run() {
    Findings out;
    const std::array<double, 3> bounds{0.36, 0.64, 0.55};
    std::size_t bound = 0;
    for (const Layer& layer : {anisotropic_metal(), sheen(), coat()}) {
        const std::vector<LightErrors> errors = errors_of(layer);
        std::vector<std::string> names;
        for (std::size_t i = 0; i < layer.ways.size(); ++i) {
            const Layer::Way& way = layer.ways[i];
            names.push_back(way.name);
            out.techniques.push_back(
                {way.name + ", " + layer.name, way.source, "light seen in the lobe of a layer",
                 "the lobe integrated over six lights, n.v 0.1 to 0.9; largest: of one light and "
                 "roughness",
                 "%", errors[i].mean(), errors[i].largest(), way.cost_ns});
        }
        out.tables.push_back(error_table(layer.name + ": mean error in % of the light seen", names, errors));
        out.measured.push_back(
            at_most(layer.name + ": error of " + names.back() + " over that of " + names.front(),
                    errors.back().mean() / errors.front().mean(), bounds[bound++]));
        out.text += layer.name + ": " + number(errors.front().mean(), 2) + " % with " + names.front() + ", " +
                    number(errors.back().mean(), 2) + " with " + names.back() + ". ";
    }
    return out;
}

}  // namespace

Experiment image_light_layers() {
    return {"KHR_materials_anisotropy, _sheen, _clearcoat", "their image-based light",
            "Anisotropic metal, sheen and clear coat under the surroundings",
            "What is read of perfectly prefiltered light for each layer against its lobe over six generated "
            "lights.",
            run};
}

}  // namespace candela::measure::experiments
