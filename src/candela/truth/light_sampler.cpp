#include "candela/truth/light_sampler.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "candela/truth/light_bounds.hpp"
#include "candela/truth/punctual_light.hpp"
#include "shading/lights/triangle.glsl"

namespace candela::truth {
namespace {

/// Under this a triangle is flat enough for a point drawn on its area, and single precision too coarse for
/// its sides.
constexpr float kLeastSphericalTriangle_sr = 1e-3f;

struct SeenTriangle {
    glm::vec3 corners[3];
    glm::vec3 directions[3];
    glm::vec3 normal{0.0f};  ///< twice the area long
    float solid_angle_sr = 0.0f;

    SeenTriangle(const Geometry& geometry, std::uint32_t part, std::uint32_t triangle,
                 const glm::vec3& point) {
        geometry.corners(part, triangle, corners);
        normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        for (int c = 0; c < 3; ++c) {
            const glm::vec3 d = corners[c] - point;
            directions[c] = d / std::max(glm::length(d), 1e-20f);
        }
        solid_angle_sr = shading::triangle_solid_angle(directions[0], directions[1], directions[2]);
    }
    [[nodiscard]] bool spherical() const {
        return solid_angle_sr > kLeastSphericalTriangle_sr && solid_angle_sr < 6.2f;
    }
    /// Density in 1/sr of a point drawn on the area.
    [[nodiscard]] float area_pdf(const glm::vec3& direction, float distance_m) const {
        const float projected = 0.5f * std::abs(glm::dot(normal, direction));
        return projected > 1e-20f ? distance_m * distance_m / projected : 0.0f;
    }
    /// Distance along the unit direction to the triangle's plane.
    [[nodiscard]] float distance_m(const glm::vec3& point, const glm::vec3& direction) const {
        const float approach = glm::dot(normal, direction);
        return std::abs(approach) > 1e-30f ? glm::dot(normal, corners[0] - point) / approach : 0.0f;
    }
    /// Barycentric coordinates of a point of the plane.
    [[nodiscard]] glm::vec2 barycentric(const glm::vec3& p) const {
        const float scale = 1.0f / std::max(glm::dot(normal, normal), 1e-30f);
        const float u = glm::dot(glm::cross(p - corners[0], corners[2] - corners[0]), normal) * scale;
        const float v = glm::dot(glm::cross(corners[1] - corners[0], p - corners[0]), normal) * scale;
        const float u_in = std::clamp(u, 0.0f, 1.0f);
        return {u_in, std::clamp(v, 0.0f, 1.0f - u_in)};
    }
};

}  // namespace

LightSampler::LightSampler(const scene::Scene& scene, const Geometry& geometry, const SurfaceReader& surfaces,
                           const shading::Falloff& falloff)
    : scene_(&scene),
      geometry_(&geometry),
      surfaces_(&surfaces),
      textures_(scene),
      falloff_(falloff),
      distant_(scene),
      light_of_triangle_(geometry.parts().size()) {
    std::vector<LightBounds> bounds;
    for (const scene::Light& light : scene.lights) {
        if (light.intensity > 0.0f && !scene::is_distant(light.type)) add_light(light, bounds);
    }
    for (std::uint32_t part = 0; part < geometry.parts().size(); ++part) {
        const scene::Material& m = surfaces.material(part);
        if (!m.unlit && m.emissive_nit != glm::vec3(0.0f)) add_emissive(part, bounds);
    }
    tree_ = LightTree(bounds);
    std::vector<const scene::Light*> shapes;
    for (const std::uint32_t i : shapes_) shapes.push_back(lights_[i].light);
    shape_tree_ = ShapeTree(std::move(shapes));
}

void LightSampler::add_light(const scene::Light& light, std::vector<LightBounds>& bounds) {
    if (scene::is_shape(light.type)) shapes_.push_back(static_cast<std::uint32_t>(lights_.size()));
    lights_.push_back({&light, 0, 0});
    bounds.push_back(light_bounds(light, *scene_, textures_));
}

void LightSampler::add_emissive(std::uint32_t part, std::vector<LightBounds>& bounds) {
    const Part& p = geometry_->parts()[part];
    const bool two_sided = surfaces_->material(part).double_sided;
    std::vector<std::uint32_t>& of_triangle = light_of_triangle_[part];
    for (std::uint32_t t = 0; t < p.primitive->indices.size() / 3; ++t) {
        glm::vec3 corner[3];
        geometry_->corners(part, t, corner);
        const glm::vec3 normal = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
        const float area2 = glm::length(normal);
        // A picture's mean over the triangle, from the centroid and the middles of its thirds.
        float nit = 0.0f;
        constexpr std::array<std::array<float, 2>, 4> at{
            {{1.0f / 3, 1.0f / 3}, {1.0f / 6, 1.0f / 6}, {2.0f / 3, 1.0f / 6}, {1.0f / 6, 2.0f / 3}}};
        for (const auto& [u, v] : at)
            nit += 0.25f * shading::luminance(surfaces_->emissive_nit(part, t, u, v));
        // What those points missed must still be drawn now and then.
        nit = std::max(nit, 0.01f * shading::luminance(surfaces_->material(part).emissive_nit));
        LightBounds b;
        for (const glm::vec3& c : corner) b.box.extend(c);
        b.axis = area2 > 0.0f ? normal / area2 : glm::vec3(0, 1, 0);
        b.power = std::isfinite(area2) ? 0.5f * area2 * nit : 0.0f;
        b.two_sided = two_sided;
        of_triangle.push_back(static_cast<std::uint32_t>(lights_.size()));
        lights_.push_back({nullptr, part, t});
        bounds.push_back(b);
    }
}

LightSample LightSampler::sample_triangle(const NearLight& light, const glm::vec3& point,
                                          const glm::vec2& u) const {
    const SeenTriangle seen(*geometry_, light.part, light.triangle, point);
    LightSample out;
    out.surface = true;
    glm::vec2 at;
    if (seen.spherical()) {
        out.direction =
            shading::sample_spherical_triangle(seen.directions[0], seen.directions[1], seen.directions[2], u);
        out.distance_m = seen.distance_m(point, out.direction);
        if (!(out.distance_m > 0.0f)) return out;
        at = seen.barycentric(point + out.direction * out.distance_m);
        out.pdf = 1.0f / seen.solid_angle_sr;
    } else {
        const float root = std::sqrt(u.x);
        at = {root * (1.0f - u.y), root * u.y};
        const glm::vec3 to_light =
            seen.corners[0] * (1.0f - at.x - at.y) + seen.corners[1] * at.x + seen.corners[2] * at.y - point;
        out.distance_m = glm::length(to_light);
        if (!(out.distance_m > 0.0f)) return out;
        out.direction = to_light / out.distance_m;
        out.pdf = seen.area_pdf(out.direction, out.distance_m);
    }
    const bool from_front = glm::dot(seen.normal, out.direction) < 0.0f;
    if (!from_front && !surfaces_->material(light.part).double_sided) return out;
    // corners() turns mirrored triangles around; the surface's own coordinates do not.
    if (geometry_->parts()[light.part].mirrored) std::swap(at.x, at.y);
    out.light = surfaces_->emissive_nit(light.part, light.triangle, at.x, at.y);
    const float passes = surfaces_->transparency({light.part, light.triangle, at.x, at.y, 0.0f});
    out.light *= 1.0f - passes;
    return out;
}

LightSample LightSampler::sample_near(const glm::vec3& point, const glm::vec3& normal, float choice,
                                      const glm::vec2& u) const {
    const LightTree::Choice chosen = tree_.sample(point, normal, choice);
    if (!(chosen.probability > 0.0f)) return {};
    const NearLight& light = lights_[chosen.light];
    LightSample out = !light.light ? sample_triangle(light, point, u)
                      : scene::is_shape(light.light->type)
                          ? sample_shape(*light.light, point, u)
                          : sample_punctual(*light.light, *scene_, falloff_, point, u.x);
    out.pdf *= chosen.probability;
    return out;
}

LightSample LightSampler::sample_shape(const scene::Light& light, const glm::vec3& point,
                                       const glm::vec2& u) const {
    const shading::LightDirection drawn = truth::sample_shape(light, point, u);
    LightSample out;
    out.casts_shadow = light.casts_shadow;
    out.direction = drawn.direction;
    out.distance_m = drawn.distance_m;
    out.pdf = drawn.pdf;
    if (!(drawn.pdf > 0.0f)) return out;
    out.light =
        shape_nit(light, {point, drawn.direction}, drawn.distance_m) * shape_attenuation(light, point);
    return out;
}

glm::vec3 LightSampler::shape_nit(const scene::Light& light, const Ray& ray, float distance_m) const {
    const glm::vec3 nit = light.color * light.intensity;
    if (light.type != scene::LightType::rectangle || light.image == scene::no_index) return nit;
    const glm::vec3 from_center = ray.origin + ray.direction * distance_m - light.position;
    return nit * textures_.read_srgb_image(
                     light.image, shading::rectangle_image_uv(from_center, light.right, light.up(),
                                                              light.half_width_m, light.half_height_m));
}

glm::vec3 LightSampler::shape_nit(std::uint32_t index, const Ray& ray, float distance_m) const {
    return shape_nit(shape(index), ray, distance_m);
}

float LightSampler::pdf_shape(std::uint32_t index, const Ray& ray, const glm::vec3& normal) const {
    const float probability = tree_.probability(ray.origin, normal, shapes_[index]);
    return probability > 0.0f ? probability * truth::pdf_shape(shape(index), ray.origin, ray.direction)
                              : 0.0f;
}

float LightSampler::pdf_triangle(const Ray& ray, const glm::vec3& normal, const Hit& hit) const {
    const std::vector<std::uint32_t>& of_triangle = light_of_triangle_[hit.part];
    if (of_triangle.empty()) return 0.0f;
    const float probability = tree_.probability(ray.origin, normal, of_triangle[hit.triangle]);
    if (probability <= 0.0f) return 0.0f;
    const SeenTriangle seen(*geometry_, hit.part, hit.triangle, ray.origin);
    const float pdf = seen.spherical()
                          ? 1.0f / seen.solid_angle_sr
                          : seen.area_pdf(ray.direction, seen.distance_m(ray.origin, ray.direction));
    return probability * pdf;
}

}  // namespace candela::truth
