#include "candela/truth/path_integrator.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "shading/lights/punctual.glsl"
#include "shading/surface_side.glsl"

namespace candela::truth {
namespace {

/// A stack of this many transparent sheets is taken as opaque: rays must end.
constexpr int kMaxSheets = 512;
/// Paths are cut by chance from here on.
constexpr int kSureBounces = 3;
/// Rays to lights end this much before them, so that a light that lies on a surface is not hidden by it.
constexpr float kBeforeLight = 1.0f - 1e-4f;

bool black(const glm::vec3& c) {
    return c.x <= 0.0f && c.y <= 0.0f && c.z <= 0.0f;
}

glm::vec3 share(const glm::vec3& part, const glm::vec3& whole) {
    glm::vec3 out;
    for (int c = 0; c < 3; ++c) out[c] = whole[c] > 0.0f ? part[c] / whole[c] : 0.0f;
    return out;
}

/// Turns normals that look away from the viewer, as both modes on the device do.
void face_viewer(SurfacePoint& p, const glm::vec3& v) {
    p.surface_normal = shading::normal_facing(p.surface_normal, v);
    if (glm::dot(p.normal, v) >= 1.0e-4f && glm::dot(p.coat_normal, v) >= 1.0e-4f) return;
    p.normal = shading::normal_facing(p.normal, v);
    p.coat_normal = shading::normal_facing(p.coat_normal, v);
    const glm::vec3 along = p.tangent - p.normal * glm::dot(p.normal, p.tangent);
    p.tangent = along / std::sqrt(std::max(glm::dot(along, along), 1.0e-12f));
    p.bitangent = glm::cross(p.normal, p.tangent);
}

EnvironmentLight environment_of(const scene::Scene& scene, const PathOptions& options) {
    if (options.furnace) return EnvironmentLight(1.0f);
    if (!scene.environment || scene.environment->luminance_nit.empty()) return {};
    return EnvironmentLight(*scene.environment);
}

}  // namespace

/// A surface on the path, ready to be lit.
struct PathIntegrator::Vertex {
    SurfacePoint point;
    std::uint32_t part = 0;  ///< index into Geometry::parts()
    glm::vec3 origin{0.0f};  ///< of rays that leave it
    glm::vec3 v{0.0f};       ///< unit, towards where the path came from
    glm::vec4 dfg{0.0f};
    shading::PreparedSurface prepared{};
    shading::BsdfLobes lobes{};

    /// Those that leave it close to, or below, the plane of its triangle start from the smooth surface.
    [[nodiscard]] glm::vec3 origin_towards(const glm::vec3& l) const {
        if (glm::dot(point.geometric_normal, l) >= shading::kGrazingCosine) return origin;
        return offset_from_surface(point.smooth_position, point.geometric_normal);
    }
};

/// What is left of light that comes along the path. The two forms of a material (shading::image_based_form)
/// differ at its last surface: what the path meets next decides between them, so that light which both a
/// light's and the material's draws find is weighed by one integrand.
struct PathIntegrator::Throughput {
    glm::vec3 factor{1.0f};
    glm::vec3 diffuse_share{0.0f};  ///< of the first surface's lobes, per channel; the rest is specular

    /// On through a surface whose lobes reflect `diffuse` and `specular`, over the density of the direction.
    void pass(const glm::vec3& diffuse, const glm::vec3& specular, float pdf, bool first) {
        const glm::vec3 both = diffuse + specular;
        if (first) diffuse_share = share(diffuse, both);
        factor *= both / pdf;
    }
};

/// A path under way.
struct PathIntegrator::Walk {
    Ray ray;
    PathResult result;
    Throughput from_lights;        ///< of what the ray meets of the scene's lights
    Throughput from_surroundings;  ///< of all other light: the environment's, and what surfaces reflect
    glm::vec3 last_origin{0.0f};   ///< where light was drawn from at the last surface
    glm::vec3 last_normal{0.0f};
    std::uint32_t last_part = 0;
    bool below_triangle = false;  ///< the ray leaves its triangle's plane downwards
    float last_pdf = 0.0f;        ///< of the direction that the path took; 1/sr
    int bounces = 0;

    /// Vertex normals leave directions in the lobe that are above the smooth surface and below the triangle
    /// that stands for it. What such a ray meets of the same mesh is not another surface that lights this
    /// one, as shadow rays have it too.
    [[nodiscard]] bool meets_own_facets(const Hit& hit) const {
        return bounces > 0 && below_triangle && hit.part == last_part;
    }

    /// Light that reaches the camera by way of surfaces met so far; of a light or an emissive surface that it
    /// left towards the first of them, it is direct.
    void add(const Throughput& by, const glm::vec3& arriving, bool towards_first, bool environment = false) {
        const bool direct = towards_first && !environment;
        const glm::vec3 light = by.factor * arriving;
        result.luminance_nit += light;
        if (towards_first && environment) result.environment += light;
        const glm::vec3 diffuse = light * by.diffuse_share;
        (direct ? result.direct_diffuse : result.indirect_diffuse) += diffuse;
        (direct ? result.direct_specular : result.indirect_specular) += light - diffuse;
    }
};

PathIntegrator::PathIntegrator(const scene::Scene& scene, const PathOptions& options)
    : scene_(&scene),
      options_(options),
      geometry_(scene),
      surfaces_(scene, geometry_, options.fully_rough),
      environment_(environment_of(scene, options)),
      environment_form_(shading::image_based_form(options.techniques)),
      albedo_(options.techniques.specular_visibility != shading::kVisibilitySmithCorrelated),
      any_transparency_(surfaces_.any_transparency()),
      background_visible_(options.furnace || (scene.environment && scene.environment->visible)) {
    if (!options.furnace) lights_.emplace(scene, geometry_, surfaces_, options.falloff);
}

glm::vec3 PathIntegrator::behind(const Ray& ray, const Hit& hit) const {
    glm::vec3 corner[3];
    geometry_.corners(hit.part, hit.triangle, corner);
    const glm::vec3 n = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
    const float length = glm::length(n);
    const glm::vec3 side = length > 0.0f && std::isfinite(length) ? n / length : ray.direction;
    return offset_from_surface(ray.origin + ray.direction * hit.t,
                               glm::dot(side, ray.direction) > 0.0f ? side : -side);
}

PathIntegrator::Next PathIntegrator::next_surface(Ray& ray, Hit& hit, const PathSampler& sampler,
                                                  int bounce) const {
    const Ray start = ray;
    float walked_m = 0.0f;
    for (int sheet = 0; sheet < kMaxSheets; ++sheet) {
        if (!geometry_.intersect(ray, hit)) return Next::sky;
        walked_m += hit.t;
        const bool passes =
            (bounce == 0 && options_.cull_first && surfaces_.culled(ray, hit)) ||
            (any_transparency_ &&
             surfaces_.transparency(hit) > sampler.loose(bounce, static_cast<std::uint32_t>(sheet)));
        if (!passes) {
            ray.origin = start.origin;
            hit.t = walked_m;
            return Next::surface;
        }
        ray.origin = behind(ray, hit);
        ray.t_max -= hit.t;
        if (ray.t_max <= 0.0f) return Next::sky;
    }
    return Next::lost;
}

float PathIntegrator::transmitted(const Ray& ray) const {
    if (!any_transparency_) return geometry_.occluded(ray) ? 0.0f : 1.0f;
    float through = 1.0f;
    Ray rest = ray;
    for (int sheet = 0; sheet < kMaxSheets; ++sheet) {
        Hit hit;
        if (!geometry_.intersect(rest, hit)) return through;
        through *= surfaces_.transparency(hit);
        if (through <= 0.0f) return 0.0f;
        rest.origin = behind(rest, hit);
        rest.t_max -= hit.t;
        if (rest.t_max <= 0.0f) return through;
    }
    return 0.0f;
}

void PathIntegrator::shade(const Vertex& vertex, const shading::BsdfTechniques& form, const glm::vec3& l,
                           glm::vec3& diffuse, glm::vec3& specular) const {
    const SurfacePoint& p = vertex.point;
    const float NoL = glm::dot(p.normal, l);
    if (NoL <= 0.0f || !shading::above_surface(p.surface_normal, l)) {
        diffuse = specular = glm::vec3(0.0f);
        return;
    }
    if (p.layered) {
        shading::evaluate_layered(p.surface, form, p.normal, p.tangent, p.bitangent, p.coat_normal, vertex.v,
                                  l, vertex.dfg, diffuse, specular);
    } else {
        const glm::vec3 h = glm::normalize(vertex.v + l);
        const glm::vec3 nxh = glm::cross(p.normal, h);
        shading::evaluate_prepared(vertex.prepared, form, NoL, shading::saturate(glm::dot(p.normal, h)),
                                   glm::dot(nxh, nxh), shading::saturate(glm::dot(l, h)), diffuse, specular);
    }
    diffuse *= NoL;
    specular *= NoL;
}

float PathIntegrator::weight(Draws by, float own, float other) const {
    if (options_.draws != Draws::all) return options_.draws == by ? 1.0f : 0.0f;
    return shading::power_heuristic(own, other);
}

void PathIntegrator::add_light(Walk& walk, const Vertex& vertex, const LightSample& light,
                               bool environment) const {
    if (!(light.pdf > 0.0f) || black(light.light)) return;
    glm::vec3 diffuse;
    glm::vec3 specular;
    shade(vertex, environment ? environment_form_ : options_.techniques, light.direction, diffuse, specular);
    if (black(diffuse + specular)) return;
    float share_of_draw = 1.0f;
    // Without shadows a ray cannot find a surface behind others: these are then drawn in this way alone.
    const bool only_way = light.delta || (!options_.shadows && light.surface);
    if (!only_way) {
        const SurfacePoint& p = vertex.point;
        share_of_draw = weight(Draws::lights, light.pdf,
                               shading::pdf_bsdf(vertex.lobes, p.surface, p.normal, p.tangent, p.bitangent,
                                                 p.coat_normal, vertex.v, light.direction));
    }
    if (!(share_of_draw > 0.0f)) return;
    Ray shadow{vertex.origin_towards(light.direction), light.direction, light.distance_m};
    if (std::isfinite(light.distance_m)) {
        const glm::vec3 way = vertex.origin + light.direction * light.distance_m - shadow.origin;
        const float length_m = glm::length(way);
        shadow.direction = way / std::max(length_m, 1e-20f);
        shadow.t_max = length_m * kBeforeLight;
    }
    const float visible = options_.shadows && light.casts_shadow ? transmitted(shadow) : 1.0f;
    if (visible <= 0.0f) return;
    Throughput by = walk.from_surroundings;
    by.pass(diffuse, specular, light.pdf, walk.bounces == 0);
    walk.add(by, light.light * (share_of_draw * visible), walk.bounces == 0, environment);
}

void PathIntegrator::add_lights(Walk& walk, const Vertex& vertex, const PathSampler& sampler) const {
    using Slot = PathSampler::Slot;
    const glm::vec2 choice = sampler.pair(walk.bounces, Slot::light_choice);
    if (!environment_.black()) {
        const DirectionSample s = environment_.sample(sampler.pair(walk.bounces, Slot::environment));
        LightSample light;
        light.direction = s.direction;
        light.light = s.luminance_nit;
        light.pdf = s.pdf;
        add_light(walk, vertex, light, true);
    }
    if (!lights_) return;
    if (lights_->any_near()) {
        add_light(walk, vertex,
                  lights_->sample_near(vertex.origin, vertex.point.normal, choice.x,
                                       sampler.pair(walk.bounces, Slot::near_light)),
                  false);
    }
    if (!lights_->distant().empty()) {
        const glm::vec2 u =
            lights_->distant().any_suns() ? sampler.pair(walk.bounces, Slot::distant_light) : glm::vec2(0.5f);
        add_light(walk, vertex, lights_->distant().sample(vertex.point.normal, choice.y, u), false);
    }
}

void PathIntegrator::add_emission(Walk& walk, const SurfacePoint& point, const Hit& hit) const {
    if (options_.furnace || black(point.emissive_nit)) return;
    if (walk.bounces == 0) {
        walk.result.luminance_nit += point.emissive_nit;
        walk.result.emissive += point.emissive_nit;
        return;
    }
    const float drawn = lights_->pdf_triangle({walk.last_origin, walk.ray.direction}, walk.last_normal, hit);
    walk.add(walk.from_lights, point.emissive_nit * weight(Draws::material, walk.last_pdf, drawn),
             walk.bounces == 1);
}

void PathIntegrator::add_shapes(Walk& walk, float surface_m) const {
    if (!lights_ || lights_->shapes().empty()) return;
    const Ray ray{walk.last_origin, walk.ray.direction};
    lights_->shapes().each_entry(ray, [&](std::uint32_t shape, float distance_m) {
        const scene::Light& light = lights_->shape(shape);
        if (options_.shadows && light.casts_shadow && distance_m * kBeforeLight > surface_m) return;
        const float window = shape_attenuation(light, ray.origin);
        if (window <= 0.0f) return;
        const float share_of_draw =
            weight(Draws::material, walk.last_pdf, lights_->pdf_shape(shape, ray, walk.last_normal));
        walk.add(walk.from_lights, lights_->shape_nit(shape, ray, distance_m) * (window * share_of_draw),
                 walk.bounces == 1);
    });
}

void PathIntegrator::add_suns(Walk& walk, bool sky) const {
    if (!lights_) return;
    lights_->distant().each_sun(walk.ray.direction, walk.last_normal,
                                [&](const scene::Light& light, const glm::vec3& luminance_nit, float drawn) {
                                    if (walk.bounces == 0) {
                                        if (sky && light.visible) walk.result.luminance_nit += luminance_nit;
                                        return;
                                    }
                                    if (!sky && options_.shadows && light.casts_shadow) return;
                                    walk.add(walk.from_lights,
                                             luminance_nit * weight(Draws::material, walk.last_pdf, drawn),
                                             walk.bounces == 1);
                                });
}

bool PathIntegrator::see_shape(Walk& walk, float surface_m) const {
    if (!lights_ || lights_->shapes().empty()) return false;
    std::uint32_t nearest = 0;
    float nearest_m = std::numeric_limits<float>::infinity();
    lights_->shapes().each_entry(walk.ray, [&](std::uint32_t shape, float distance_m) {
        if (!lights_->shape(shape).visible || distance_m >= nearest_m) return;
        nearest = shape;
        nearest_m = distance_m;
    });
    if (!std::isfinite(nearest_m) || nearest_m * kBeforeLight > surface_m) return false;
    const glm::vec3 luminance_nit = lights_->shape_nit(nearest, walk.ray, nearest_m);
    walk.result.luminance_nit += luminance_nit;
    walk.result.emissive += luminance_nit;
    walk.result.distance_m = nearest_m;
    walk.result.normal = shape_normal(lights_->shape(nearest), walk.ray, nearest_m);
    return true;
}

void PathIntegrator::add_environment(Walk& walk) const {
    if (environment_.black()) return;
    const glm::vec3 luminance_nit = environment_.luminance_nit(walk.ray.direction);
    if (walk.bounces == 0) {
        if (background_visible_) walk.result.luminance_nit += luminance_nit;
        return;
    }
    walk.add(walk.from_surroundings,
             luminance_nit * weight(Draws::material, walk.last_pdf, environment_.pdf(walk.ray.direction)),
             walk.bounces == 1, true);
}

/// Goes on in a direction drawn from the material; false when the path ends here.
bool PathIntegrator::bounce(Walk& walk, const Vertex& vertex, const PathSampler& sampler) const {
    using Slot = PathSampler::Slot;
    const SurfacePoint& p = vertex.point;
    const glm::vec2 choice = sampler.pair(walk.bounces, Slot::bsdf_choice);
    const glm::vec3 l = glm::normalize(shading::sample_bsdf(vertex.lobes, p.surface, p.normal, p.tangent,
                                                            p.bitangent, p.coat_normal, vertex.v, choice.x,
                                                            sampler.pair(walk.bounces, Slot::bsdf)));
    const float pdf = shading::pdf_bsdf(vertex.lobes, p.surface, p.normal, p.tangent, p.bitangent,
                                        p.coat_normal, vertex.v, l);
    if (!(pdf > 0.0f)) return false;
    glm::vec3 diffuse;
    glm::vec3 specular;
    shade(vertex, environment_form_, l, diffuse, specular);
    if (black(diffuse + specular)) return false;
    Throughput lights = walk.from_surroundings;
    walk.from_surroundings.pass(diffuse, specular, pdf, walk.bounces == 0);
    if (shading::has_two_forms(options_.techniques)) {
        shade(vertex, options_.techniques, l, diffuse, specular);
        lights.pass(diffuse, specular, pdf, walk.bounces == 0);
    } else {
        lights = walk.from_surroundings;
    }
    if (walk.bounces >= kSureBounces) {
        const float survive = std::min(shading::max_component(walk.from_surroundings.factor), 0.97f);
        if (choice.y >= survive) return false;
        walk.from_surroundings.factor /= survive;
        lights.factor /= survive;
    }
    walk.from_lights = lights;
    walk.ray = {vertex.origin_towards(l), l};
    walk.last_origin = vertex.origin;
    walk.last_pdf = pdf;
    walk.last_normal = p.normal;
    walk.last_part = vertex.part;
    walk.below_triangle = glm::dot(p.geometric_normal, l) <= 0.0f;
    ++walk.bounces;
    return true;
}

PathResult PathIntegrator::trace(const Ray& camera_ray, const PathSampler& sampler) const {
    Walk walk;
    walk.ray = camera_ray;
    const bool direct_only = options_.direct_only || !options_.shadows;
    const int last = direct_only ? std::min(1, options_.max_bounces) : options_.max_bounces;
    while (true) {
        Hit hit;
        const bool sees_through = walk.bounces > 0 && !options_.shadows;
        const Next next = sees_through ? Next::sky : next_surface(walk.ray, hit, sampler, walk.bounces);
        const float surface_m = next == Next::sky       ? std::numeric_limits<float>::infinity()
                                : next == Next::surface ? hit.t
                                                        : 0.0f;
        if (walk.bounces == 0) {
            if (next != Next::lost && see_shape(walk, std::min(surface_m, camera_ray.t_max))) break;
        } else {
            add_shapes(walk, surface_m);
        }
        add_suns(walk, next == Next::sky);
        if (next == Next::sky) add_environment(walk);
        if (next != Next::surface || walk.meets_own_facets(hit)) break;
        Vertex vertex;
        vertex.part = hit.part;
        vertex.point = surfaces_.read(walk.ray, hit);
        SurfacePoint& p = vertex.point;
        if (walk.bounces == 0) {
            walk.result.distance_m = hit.t;
            walk.result.object_id = geometry_.parts()[hit.part].instance + 1;
            walk.result.material_id = geometry_.parts()[hit.part].material + 1;
            walk.result.albedo = p.unlit ? p.unlit_color : p.surface.base_color;
            walk.result.normal = p.normal;
            if (p.unlit) {
                walk.result.unlit = p.unlit_color;
                walk.result.sees_unlit = true;
            }
        }
        if (p.unlit) break;
        add_emission(walk, p, hit);
        if (walk.bounces >= last) break;
        vertex.v = -walk.ray.direction;
        face_viewer(p, vertex.v);
        vertex.origin = offset_from_surface(p.position, p.geometric_normal);
        const float NoV = std::clamp(glm::dot(p.normal, vertex.v), 1.0e-4f, 1.0f);
        vertex.dfg = albedo_.read(NoV, p.surface.perceptual_roughness);
        glm::vec4 coat_dfg(0.0f);
        float coat_NoV = NoV;
        if (p.surface.coat > 0.0f) {
            coat_NoV = std::clamp(glm::dot(p.coat_normal, vertex.v), 1.0e-4f, 1.0f);
            coat_dfg = albedo_.read(coat_NoV, p.surface.coat_perceptual_roughness);
        }
        vertex.prepared = shading::prepare_surface(p.surface, options_.techniques, NoV, vertex.dfg);
        vertex.lobes =
            shading::bsdf_lobes(p.surface, options_.techniques, NoV, coat_NoV, vertex.dfg, coat_dfg);
        add_lights(walk, vertex, sampler);
        if (!bounce(walk, vertex, sampler)) break;
    }
    const glm::vec3& nit = walk.result.luminance_nit;
    // One path that is not a number would be its whole pixel, and the whole probe that is baked of it.
    if (!std::isfinite(nit.x + nit.y + nit.z)) return {};
    return walk.result;
}

}  // namespace candela::truth
