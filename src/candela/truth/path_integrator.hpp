#pragma once

#include <limits>
#include <optional>

#include "candela/truth/albedo_table.hpp"
#include "candela/truth/environment_light.hpp"
#include "candela/truth/light_sampler.hpp"
#include "candela/truth/path_sampler.hpp"
#include "candela/truth/surface_point.hpp"
#include "shading/bsdf_sampling.glsl"

namespace candela::truth {

/// Which draws of directions count. All is what pictures are made with; one of two alone is right too but for
/// noise, and shows that their weights are.
enum class Draws : std::uint8_t {
    all,
    lights,   ///< from lights and environment
    material  ///< from the material, and from lights that it cannot find
};

struct PathOptions {
    shading::BsdfTechniques techniques{};  ///< of the material model: the profile's
    scene::FullyRoughRule fully_rough = scene::FullyRoughRule::none;  ///< the profile's
    shading::Falloff falloff{};                                       ///< the profile's
    int max_bounces = 64;      ///< surfaces after the first that a path may meet
    bool direct_only = false;  ///< light that comes straight from a source, as area-light techniques see it
    bool shadows = true;       ///< without them: direct light as if nothing were in its way
    bool furnace = false;      ///< a uniform environment of luminance 1 is the only light
    /// What a back face is to the first ray: nothing, as to the frame's camera, or a surface, as to all other
    /// rays.
    bool cull_first = true;
    Draws draws = Draws::all;
};

/// What one path found, in cd/m^2 but where said otherwise. The four lobes are as the real-time frame has
/// them: direct from punctual lights and emissive surfaces, indirect from the environment and from other
/// surfaces.
struct PathResult {
    glm::vec3 luminance_nit{0.0f};
    glm::vec3 direct_diffuse{0.0f};
    glm::vec3 direct_specular{0.0f};
    glm::vec3 indirect_diffuse{0.0f};
    glm::vec3 indirect_specular{0.0f};
    glm::vec3 environment{
        0.0f};  ///< of both indirect ones: straight from the environment to the first surface
    glm::vec3 emissive{0.0f};
    glm::vec3 unlit{0.0f};    ///< display-referred colour of a surface without light
    bool sees_unlit = false;  ///< the camera ray ends on such a surface
    glm::vec3 albedo{0.0f};
    glm::vec3 normal{0.0f};
    float distance_m = std::numeric_limits<float>::infinity();  ///< along the camera ray
    std::uint32_t object_id = 0;                                ///< instance + 1; 0: nothing hit
    std::uint32_t material_id = 0;                              ///< material + 1
};

/// Unidirectional path tracing with multiple importance sampling (Veach 1997, chapters 8 to 10): at
/// each surface one draw each from the environment, the near lights, the distant lights and the material.
/// May be used from several threads at once; the scene must outlive it.
class PathIntegrator {
  public:
    PathIntegrator(const scene::Scene& scene, const PathOptions& options);

    [[nodiscard]] PathResult trace(const Ray& camera_ray, const PathSampler& sampler) const;

    [[nodiscard]] const Geometry& geometry() const noexcept { return geometry_; }

  private:
    struct Vertex;
    struct Throughput;
    struct Walk;
    enum class Next : std::uint8_t { surface, sky, lost };
    [[nodiscard]] Next next_surface(Ray& ray, Hit& hit, const PathSampler& sampler, int bounce) const;
    /// Where a ray goes on that passes through its hit.
    [[nodiscard]] glm::vec3 behind(const Ray& ray, const Hit& hit) const;
    /// Part of the light that gets through to `distance_m` along the ray: 0 behind anything opaque.
    [[nodiscard]] float transmitted(const Ray& ray) const;
    void shade(const Vertex& vertex, const shading::BsdfTechniques& form, const glm::vec3& l,
               glm::vec3& diffuse, glm::vec3& specular) const;
    void add_lights(Walk& walk, const Vertex& vertex, const PathSampler& sampler) const;
    void add_light(Walk& walk, const Vertex& vertex, const LightSample& light, bool environment) const;
    /// Of a draw of density `own` of the lights or the material, where the other's would be `other`.
    [[nodiscard]] float weight(Draws by, float own, float other) const;
    /// What lights of a size add to a ray that goes on to surface_m; sky: to no surface at all.
    void add_shapes(Walk& walk, float surface_m) const;
    void add_suns(Walk& walk, bool sky) const;
    /// Whether the camera's ray ends at a light's shape before surface_m.
    [[nodiscard]] bool see_shape(Walk& walk, float surface_m) const;
    void add_emission(Walk& walk, const SurfacePoint& point, const Hit& hit) const;
    void add_environment(Walk& walk) const;
    [[nodiscard]] bool bounce(Walk& walk, const Vertex& vertex, const PathSampler& sampler) const;

    const scene::Scene* scene_;
    PathOptions options_;
    Geometry geometry_;
    SurfaceReader surfaces_;
    EnvironmentLight environment_;
    std::optional<LightSampler> lights_;
    shading::BsdfTechniques environment_form_;  ///< of the material model where light comes from no light
    AlbedoTable albedo_;
    bool any_transparency_;
    bool background_visible_;
};

}  // namespace candela::truth
