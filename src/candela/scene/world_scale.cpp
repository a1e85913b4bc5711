#include "candela/scene/world_scale.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace candela::scene {
namespace {

constexpr double kSmallest_m = 0.125;
constexpr double kLargest_m = 131072.0;

void scale_place(glm::mat4& rigid, float factor) {
    rigid[3] = glm::vec4(glm::vec3(rigid[3]) * factor, 1.0f);
}

void scale_affine(glm::mat4& m, float factor) {
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 3; ++row) m[column][row] *= factor;
    }
}

void scale_light(Light& light, float factor) {
    light.position *= factor;
    light.range_m *= factor;
    light.radius_m *= factor;
    light.half_width_m *= factor;
    light.half_height_m *= factor;
    const bool states_luminance = is_shape(light.type);
    if (!states_luminance && !is_distant(light.type)) light.intensity *= factor * factor;
}

template <class Region>
void scale_region(Region& region, float factor) {
    scale_place(region.world, factor);
    region.half_size_m *= factor;
    region.fade_m *= factor;
}

void scale_volume(IrradianceVolume& volume, float factor) {
    scale_region(volume, factor);
    for (IrradianceProbe& probe : volume.probes) {
        for (glm::vec2& d : probe.distances) d *= glm::vec2(factor, factor * factor);
    }
}

void scale_probe(ReflectionProbe& probe, float factor) {
    scale_region(probe, factor);
    probe.capture_offset_m *= factor;
    probe.margin_m *= factor;
}

void scale_camera(Camera& camera, float factor) {
    scale_place(camera.world, factor);
    camera.ymag_m *= factor;
    camera.xmag_m *= factor;
    camera.znear_m *= factor;
    camera.zfar_m *= factor;
}

}  // namespace

double suitable_unit_m(const Scene& scene) {
    const Aabb bounds = world_bounds(scene);
    if (bounds.empty()) return scene.frame.unit_m;
    const glm::dvec3 low(bounds.min), high(bounds.max);
    const double size_m = glm::length(high - low) * scene.frame.unit_m;
    if (!(size_m > 0.0) || !std::isfinite(size_m)) return scene.frame.unit_m;
    if (size_m < kSmallest_m) return std::exp2(std::floor(std::log2(size_m)));
    if (size_m > kLargest_m) return std::exp2(std::ceil(std::log2(size_m / kLargest_m)));
    return 1.0;
}

void set_unit(Scene& scene, Camera& camera, double unit_m) {
    const auto factor = static_cast<float>(scene.frame.unit_m / unit_m);
    scene.frame.unit_m = unit_m;
    if (factor == 1.0f) return;
    for (Instance& instance : scene.instances) scale_affine(instance.world, factor);
    for (Node& node : scene.nodes) scale_affine(node.world, factor);
    for (Light& light : scene.lights) scale_light(light, factor);
    for (Camera& other : scene.cameras) scale_camera(other, factor);
    for (ReflectionProbe& probe : scene.reflection_probes) scale_probe(probe, factor);
    for (IrradianceVolume& volume : scene.irradiance_volumes) scale_volume(volume, factor);
    scale_camera(camera, factor);
}

}  // namespace candela::scene
