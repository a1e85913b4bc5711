#pragma once

#include <cmath>
#include <string>

#include "candela/scene/scene.hpp"

namespace candela::test {

inline scene::Material grey(float albedo) {
    scene::Material m;
    m.name = "grey";
    m.base_color = glm::vec4(albedo, albedo, albedo, 1.0f);
    m.metallic = 0.0f;
    m.specular = 0.0f;
    return m;
}

/// A square of 2 * half_m, facing +Z.
inline scene::Primitive square(float half_m, std::uint32_t material = 0) {
    scene::Primitive p;
    for (const auto& [x, y] : {std::pair{-1.0f, -1.0f}, {1.0f, -1.0f}, {1.0f, 1.0f}, {-1.0f, 1.0f}}) {
        p.positions.emplace_back(half_m * x, half_m * y, 0.0f);
        p.normals.emplace_back(0.0f, 0.0f, 1.0f);
        p.tangents.emplace_back(1.0f, 0.0f, 0.0f, 1.0f);
        p.uv[0].emplace_back(0.5f + 0.5f * x, 0.5f - 0.5f * y);
        p.bounds.extend(p.positions.back());
    }
    p.indices = {0, 1, 2, 0, 2, 3};
    p.material = material;
    return p;
}

inline scene::Primitive sphere(float radius_m, std::uint32_t material = 0, int segments = 64,
                               int rings = 32) {
    constexpr float pi = 3.14159265f;
    scene::Primitive p;
    for (int r = 0; r <= rings; ++r) {
        for (int s = 0; s <= segments; ++s) {
            const float theta = pi * static_cast<float>(r) / static_cast<float>(rings);
            const float phi = 2.0f * pi * static_cast<float>(s) / static_cast<float>(segments);
            const glm::vec3 n{std::sin(theta) * std::sin(phi), std::cos(theta),
                              std::sin(theta) * std::cos(phi)};
            p.normals.push_back(n);
            p.positions.push_back(radius_m * n);
            p.tangents.emplace_back(std::cos(phi), 0.0f, -std::sin(phi), 1.0f);
            p.uv[0].emplace_back(static_cast<float>(s) / static_cast<float>(segments),
                                 static_cast<float>(r) / static_cast<float>(rings));
            p.bounds.extend(p.positions.back());
        }
    }
    const auto at = [&](int r, int s) { return static_cast<std::uint32_t>(r * (segments + 1) + s); };
    for (int r = 0; r < rings; ++r) {
        for (int s = 0; s < segments; ++s) {
            for (const std::uint32_t i :
                 {at(r, s), at(r + 1, s), at(r + 1, s + 1), at(r, s), at(r + 1, s + 1), at(r, s + 1)}) {
                p.indices.push_back(i);
            }
        }
    }
    p.material = material;
    return p;
}

inline scene::Scene scene_of(scene::Primitive primitive, scene::Material material) {
    scene::Scene s;
    s.materials.push_back(std::move(material));
    s.meshes.push_back({"mesh", {std::move(primitive)}});
    s.instances.push_back({"instance", 0, glm::mat4(1.0f)});
    return s;
}

/// A sun straight down -Z: perpendicular to square().
inline scene::Light sun(float illuminance_lx) {
    scene::Light light;
    light.type = scene::LightType::directional;
    light.direction = glm::vec3(0.0f, 0.0f, -1.0f);
    light.intensity = illuminance_lx;
    return light;
}

inline scene::Exposure fixed_ev(float ev100) {
    scene::Exposure e;
    e.ev100 = ev100;
    return e;
}

inline scene::Environment constant(float nit) {
    scene::Environment e;
    e.name = "constant";
    e.width = 32;
    e.height = 16;
    e.luminance_nit.assign(std::size_t{32} * 16, glm::vec3(nit));
    return e;
}

}  // namespace candela::test
