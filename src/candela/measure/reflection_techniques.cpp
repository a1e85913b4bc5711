#include "candela/measure/reflection_techniques.hpp"

#include <glm/geometric.hpp>

#include "candela/bake/lobe_fit.hpp"
#include "candela/measure/numerics.hpp"
#include "shading/basis.glsl"
#include "shading/dominant_direction.glsl"
#include "shading/fresnel.glsl"

namespace candela::measure {
namespace {

using namespace shading;

const DfgLookup& dfg_table() {
    static const DfgLookup table(DfgKind::smith_correlated);
    return table;
}

float reflectance(const GlossySurface& s, float NoV) {
    const vec2 ab = dfg_table().read(NoV, s.perceptual_roughness);
    return s.f0 * ab.x + ab.y;
}

vec3 mirror_of(const ReceiverFrame& frame) {
    return reflect(-frame.v, frame.n);
}

/// One read of the surface's own roughness in this direction.
template <class Direction>
auto one_read(Direction direction) {
    return
        [direction](const ImageLight& light, const ReceiverFrame& frame, float NoV, const GlossySurface& s) {
            const float alpha = alpha_from_perceptual_roughness(s.perceptual_roughness);
            return light.prefiltered(direction(frame.n, mirror_of(frame), NoV, alpha), s.perceptual_roughness,
                                     s.prefilter_samples) *
                   reflectance(s, NoV);
        };
}

auto fitted_reads(int count) {
    return [count](const ImageLight& light, const ReceiverFrame& frame, float NoV, const GlossySurface& s) {
        vec3 sum(0.0f);
        const float share = fresnel_share(s.f0, 1.0f, dfg_table().read(NoV, s.perceptual_roughness));
        for (const LobeRead& read :
             bake::committed_lobe_reads(count, frame.n, frame.v, NoV, s.perceptual_roughness, share))
            sum += read.weight *
                   light.prefiltered(read.direction, read.perceptual_roughness, s.prefilter_samples);
        return sum * reflectance(s, NoV);
    };
}

/// n = z and v at a cosine of the numbers, for costs.
template <class F>
double cost_of(F f) {
    return cost_ns(
        [f](const vec4& u) { return f(vec3(0.0f, 0.0f, 1.0f), vec3(0.6f * u.w, 0.0f, u.x), u.x, u.y); });
}

}  // namespace

std::vector<ReflectionTechnique> direction_techniques() {
    const char* const own = "own fit, shading/stretched_reflection.glsl";
    std::vector<ReflectionTechnique> out;
    out.push_back({"mirror direction", "mirror direction, DFG table", "Karis 2013, Environment BRDF",
                   one_read([](const vec3&, const vec3& r, float, float) { return r; }), [] {
                       return cost_of([](const vec3& n, const vec3& v, float NoV, float) {
                           return (2.0f * NoV * n - v).x;
                       });
                   }});
    out.push_back({"dominant direction", "specular_dominant_direction, DFG table",
                   "Frostbite section 4.9.3, listing 22",
                   one_read([](const vec3& n, const vec3& r, float, float alpha) {
                       return specular_dominant_direction(n, r, alpha);
                   }),
                   [] {
                       return cost_of([](const vec3& n, const vec3& v, float NoV, float r) {
                           return specular_dominant_direction(n, 2.0f * NoV * n - v, r * r).x;
                       });
                   }});
    out.push_back({"dominant direction, peak", "specular_dominant_direction_fit, DFG table",
                   "Frostbite section 4.9.3, listing 21",
                   one_read([](const vec3& n, const vec3& r, float NoV, float alpha) {
                       return specular_dominant_direction_fit(n, r, NoV, alpha);
                   }),
                   [] {
                       return cost_of([](const vec3& n, const vec3& v, float NoV, float r) {
                           return specular_dominant_direction_fit(n, 2.0f * NoV * n - v, NoV, r * r).x;
                       });
                   }});
    out.push_back({"fitted direction", "fitted_reflection, DFG table", own, fitted_reads(1), [] {
                       return cost_of([](const vec3& n, const vec3& v, float NoV, float r) {
                           const LobeRead a = fitted_reflection(n, v, NoV, r, 0.0f);
                           return a.direction.x + a.perceptual_roughness;
                       });
                   }});
    out.push_back({"two reads", "stretched_reflection_2, DFG table", own, fitted_reads(2), [] {
                       return cost_of([](const vec3& n, const vec3& v, float NoV, float r) {
                           LobeRead a;
                           LobeRead b;
                           stretched_reflection_2(n, v, NoV, r, 0.0f, a, b);
                           return a.direction.x + a.weight + b.direction.x + b.perceptual_roughness;
                       });
                   }});
    out.push_back({"three reads", "stretched_reflection_3, DFG table", own, fitted_reads(3), [] {
                       return cost_of([](const vec3& n, const vec3& v, float NoV, float r) {
                           LobeRead a;
                           LobeRead b;
                           LobeRead c;
                           stretched_reflection_3(n, v, NoV, r, 0.0f, a, b, c);
                           return a.direction.x + a.weight + b.direction.x + b.weight + c.direction.x +
                                  c.perceptual_roughness;
                       });
                   }});
    return out;
}

std::vector<ReflectionTechnique> reflectance_techniques() {
    const char* const mobile = "Karis 2014, Environment BRDF";
    std::vector<ReflectionTechnique> out;
    out.push_back(
        {"EnvBRDFApprox", "mirror direction, EnvBRDFApprox", mobile,
         [](const ImageLight& light, const ReceiverFrame& frame, float NoV, const GlossySurface& s) {
             return light.prefiltered(mirror_of(frame), s.perceptual_roughness) *
                    EnvBRDFApprox(vec3(s.f0), s.perceptual_roughness, NoV);
         },
         [] { return cost_ns([](const vec4& u) { return EnvBRDFApprox(vec3(u.z), u.y, u.x).x; }); }});
    out.push_back(
        {"EnvBRDFApprox of a non-metal", "mirror direction, env_brdf_approx_nonmetal", mobile,
         [](const ImageLight& light, const ReceiverFrame& frame, float NoV, const GlossySurface& s) {
             return light.prefiltered(mirror_of(frame), s.perceptual_roughness) *
                    env_brdf_approx_nonmetal(s.perceptual_roughness, NoV);
         },
         [] { return cost_ns([](const vec4& u) { return env_brdf_approx_nonmetal(u.y, u.x); }); }});
    out.push_back({"fully rough", "fully_rough_color", mobile,
                   [](const ImageLight& light, const ReceiverFrame& frame, float, const GlossySurface& s) {
                       return light.irradiance_over_pi(frame.n) * fully_rough_color(vec3(0.0f), vec3(s.f0));
                   },
                   [] {
                       return cost_ns(
                           [](const vec4& u) { return fully_rough_color(vec3(u.x), vec3(u.y, u.z, u.w)).x; });
                   }});
    return out;
}

glm::vec3 reflected_truth(const ImageLight& light, const ReceiverFrame& frame, const GlossySurface& surface,
                          int samples) {
    const float alpha = alpha_from_perceptual_roughness(surface.perceptual_roughness);
    const vec3 v = to_local(frame.v, frame.t, frame.b, frame.n);
    const vec3 n(0.0f, 0.0f, 1.0f);
    return integrate_light_ggx(light, frame, vec2(alpha), samples, [&](const vec3& l) {
        const vec3 h = normalize(v + l);
        return vec3(D_GGX(n, h, alpha) * V_SmithGGXCorrelated(v.z, l.z, alpha) * l.z *
                    F_Schlick(surface.f0, 1.0f, dot(v, h)));
    });
}

}  // namespace candela::measure
