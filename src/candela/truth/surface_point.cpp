#include "candela/truth/surface_point.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "shading/basis.glsl"
#include "shading/fresnel.glsl"
#include "shading/fully_rough.glsl"
#include "shading/ray_origin.glsl"

namespace candela::truth {

/// The three corners of a hit, to interpolate from.
struct SurfaceReader::Corners {
    const Part* part;
    const scene::Primitive* primitive;
    const std::uint32_t* index;
    float u;
    float v;

    Corners(const Part& p, std::uint32_t triangle, float u_in, float v_in)
        : part(&p),
          primitive(p.primitive),
          index(p.primitive->indices.data() + std::size_t{3} * triangle),
          u(u_in),
          v(v_in) {}

    template <class T>
    [[nodiscard]] T mix(const std::vector<T>& values) const {
        return values[index[0]] * (1.0f - u - v) + values[index[1]] * u + values[index[2]] * v;
    }
    template <class T>
    [[nodiscard]] T mix(const std::array<T, 3>& corners) const {
        return corners[0] * (1.0f - u - v) + corners[1] * u + corners[2] * v;
    }
    /// get(vertex) of each corner. What the part transforms is asked for once for each hit and passed on: the
    /// transforms are a good part of a bounce's cost.
    template <class Get>
    [[nodiscard]] auto each(const Get& get) const {
        return std::array{get(index[0]), get(index[1]), get(index[2])};
    }
    [[nodiscard]] std::array<glm::vec3, 3> positions() const {
        return each([&](std::uint32_t i) { return part->position(i); });
    }
    [[nodiscard]] std::array<glm::vec3, 3> normals() const {
        return each([&](std::uint32_t i) { return part->normal(i); });
    }
    [[nodiscard]] glm::vec2 uv(const scene::TextureRef& ref) const {
        const auto& set = primitive->uv[ref.uv_set < 2 ? ref.uv_set : 0];
        return set.empty() ? glm::vec2(0.0f) : mix(set);
    }
    /// Counter-clockwise seen from the front; not normalized.
    [[nodiscard]] glm::vec3 geometric_normal(const std::array<glm::vec3, 3>& p) const {
        const glm::vec3 n = glm::cross(p[1] - p[0], p[2] - p[0]);
        return part->mirrored ? -n : n;
    }
};

namespace {

glm::vec3 unit_or(const glm::vec3& v, const glm::vec3& fallback) {
    const float length2 = glm::dot(v, v);
    return length2 > 1e-30f && std::isfinite(length2) ? v * (1.0f / std::sqrt(length2)) : fallback;
}

glm::vec3 tangent_space_normal(const glm::vec4& texel, float scale) {
    const glm::vec3 n = glm::vec3(texel) * 2.0f - 1.0f;
    return {n.x * scale, n.y * scale, n.z};
}

bool has_layers(const scene::Material& m) {
    return m.clearcoat.factor > 0.0f || m.sheen.color != glm::vec3(0.0f) || m.anisotropy.strength > 0.0f;
}

}  // namespace

bool SurfaceReader::any_transparency() const {
    return std::any_of(scene_->materials.begin(), scene_->materials.end(),
                       [](const scene::Material& m) { return m.alpha_mode != scene::AlphaMode::opaque; });
}

glm::vec4 SurfaceReader::base_color(const Corners& at, const scene::Material& m) const {
    glm::vec4 c = m.base_color;
    if (m.base_color_texture) {
        c *= textures_.read(m.base_color_texture, at.uv(m.base_color_texture), Transfer::srgb);
    }
    if (!at.primitive->colors.empty()) c *= at.mix(at.primitive->colors);
    return c;
}

float SurfaceReader::transparency(const Hit& hit) const {
    const scene::Material& m = material(hit.part);
    if (m.alpha_mode == scene::AlphaMode::opaque) return 0.0f;
    const Corners at(geometry_->parts()[hit.part], hit.triangle, hit.u, hit.v);
    const float alpha = base_color(at, m).a;
    if (m.alpha_mode == scene::AlphaMode::mask) return alpha < m.alpha_cutoff ? 1.0f : 0.0f;
    return 1.0f - std::clamp(alpha, 0.0f, 1.0f);
}

bool SurfaceReader::culled(const Ray& ray, const Hit& hit) const {
    if (material(hit.part).double_sided) return false;
    const Corners at(geometry_->parts()[hit.part], hit.triangle, hit.u, hit.v);
    return glm::dot(ray.direction, at.geometric_normal(at.positions())) >= 0.0f;
}

glm::vec3 SurfaceReader::emissive_nit(std::uint32_t part, std::uint32_t triangle, float u, float v) const {
    const scene::Material& m = material(part);
    if (!m.emissive_texture) return m.emissive_nit;
    const Corners at(geometry_->parts()[part], triangle, u, v);
    return m.emissive_nit *
           glm::vec3(textures_.read(m.emissive_texture, at.uv(m.emissive_texture), Transfer::srgb));
}

void SurfaceReader::read_normals(const Corners& at, const std::array<glm::vec3, 3>& normals,
                                 const scene::Material& m, float facing, SurfacePoint& out) const {
    const glm::vec3 vertex_normal = unit_or(at.mix(normals), out.geometric_normal * facing);
    out.normal = vertex_normal * facing;
    out.coat_normal = out.normal;
    out.surface_normal = out.normal;
    const bool mapped = m.normal_texture || (out.layered && m.clearcoat.normal_texture);
    const bool wants_tangent = mapped || m.anisotropy.strength > 0.0f;
    if (!wants_tangent || !at.part->has_tangents()) return;
    const glm::vec4 t = at.mix(at.each([&](std::uint32_t i) { return at.part->tangent(i); }));
    out.tangent = glm::vec3(t);
    out.bitangent = (t.w < 0.0f ? -1.0f : 1.0f) * glm::cross(vertex_normal, out.tangent) * facing;
    const glm::vec3 base = out.normal;
    const auto map = [&](const scene::TextureRef& ref, float scale) {
        const glm::vec3 n = tangent_space_normal(textures_.read(ref, at.uv(ref), Transfer::linear), scale);
        return unit_or(n.x * out.tangent + n.y * out.bitangent + n.z * base, base);
    };
    if (m.normal_texture) out.normal = map(m.normal_texture, m.normal_scale);
    if (out.layered && m.clearcoat.normal_texture) {
        out.coat_normal = map(m.clearcoat.normal_texture, m.clearcoat.normal_scale);
    }
}

void SurfaceReader::read_base(const Corners& at, const scene::Material& m, const glm::vec4& base,
                              shading::Surface& s) const {
    s.base_color = glm::vec3(base);
    s.metallic = m.metallic;
    s.perceptual_roughness = m.perceptual_roughness;
    glm::vec3 specular_color = m.specular_color;
    const scene::TextureRef& mr = m.metallic_roughness_texture;
    if (m.workflow == scene::Workflow::specular_glossiness) {
        float glossiness = 1.0f - m.perceptual_roughness;
        if (mr) {
            const glm::vec4 sg = textures_.read(mr, at.uv(mr), Transfer::srgb);
            specular_color *= glm::vec3(sg);
            glossiness *= sg.a;
        }
        s.metallic = 0.0f;
        s.perceptual_roughness = 1.0f - glossiness;
        s.base_color *= 1.0f - shading::max_component(specular_color);
        s.dielectric_f0 = specular_color;
        s.dielectric_f90 = glm::vec3(1.0f);
        return;
    }
    if (mr) {
        const glm::vec4 t = textures_.read(mr, at.uv(mr), Transfer::linear);
        s.perceptual_roughness *= t.g;
        s.metallic *= t.b;
    }
    float specular = m.specular;
    if (m.specular_texture) {
        specular *= textures_.read(m.specular_texture, at.uv(m.specular_texture), Transfer::linear).a;
    }
    if (m.specular_color_texture) {
        specular_color *= glm::vec3(
            textures_.read(m.specular_color_texture, at.uv(m.specular_color_texture), Transfer::srgb));
    }
    const float f0 = m.ior > 0.0f ? shading::f0_from_ior(m.ior) : 1.0f;
    s.dielectric_f0 = glm::min(f0 * specular_color, glm::vec3(1.0f)) * specular;
    s.dielectric_f90 = glm::vec3(specular);
}

void SurfaceReader::read_layers(const Corners& at, const scene::Material& m, SurfacePoint& out) const {
    shading::Surface& s = out.surface;
    const auto value = [&](const scene::TextureRef& ref, Transfer transfer) {
        return ref ? textures_.read(ref, at.uv(ref), transfer) : glm::vec4(1.0f);
    };
    s.coat = m.clearcoat.factor * value(m.clearcoat.texture, Transfer::linear).r;
    s.coat_perceptual_roughness =
        m.clearcoat.perceptual_roughness * value(m.clearcoat.roughness_texture, Transfer::linear).g;
    s.sheen_color = m.sheen.color * glm::vec3(value(m.sheen.color_texture, Transfer::srgb));
    s.sheen_perceptual_roughness =
        m.sheen.perceptual_roughness * value(m.sheen.roughness_texture, Transfer::linear).a;
    s.anisotropy = m.anisotropy.strength;
    if (s.anisotropy == 0.0f) return;
    glm::vec2 direction(1.0f, 0.0f);
    if (m.anisotropy.texture) {
        const glm::vec4 a = value(m.anisotropy.texture, Transfer::linear);
        direction = glm::vec2(a) * 2.0f - 1.0f;
        s.anisotropy *= a.b;
    }
    const float c = std::cos(m.anisotropy.rotation_rad);
    const float r = std::sin(m.anisotropy.rotation_rad);
    direction = {c * direction.x - r * direction.y, r * direction.x + c * direction.y};
    out.tangent = direction.x * out.tangent + direction.y * out.bitangent;
}

SurfacePoint SurfaceReader::read(const Ray& ray, const Hit& hit) const {
    const Part& part = geometry_->parts()[hit.part];
    const scene::Material& m = scene_->materials[part.material];
    const Corners at(part, hit.triangle, hit.u, hit.v);
    SurfacePoint out;
    const std::array<glm::vec3, 3> corners = at.positions();
    out.position = at.mix(corners);
    const glm::vec3 ng = unit_or(at.geometric_normal(corners), -ray.direction);
    out.front = glm::dot(ray.direction, ng) < 0.0f;
    const float facing = out.front ? 1.0f : -1.0f;
    out.geometric_normal = ng * facing;
    const glm::vec4 base = base_color(at, m);
    out.unlit = m.unlit;
    if (m.unlit) {
        out.unlit_color = glm::vec3(base);
        return out;
    }
    if (out.front || m.double_sided) out.emissive_nit = emissive_nit(hit.part, hit.triangle, hit.u, hit.v);
    out.layered = has_layers(m);
    const std::array<glm::vec3, 3> normals = at.normals();
    read_normals(at, normals, m, facing, out);
    read_base(at, m, base, out.surface);
    if (out.layered) read_layers(at, m, out);
    if (scene::is_fully_rough(m, fully_rough_)) {
        out.surface = shading::fully_rough_surface(out.surface);
        out.layered = false;
    }
    out.smooth_position =
        shading::smooth_surface(out.position, {1.0f - hit.u - hit.v, hit.u, hit.v}, corners[0], corners[1],
                                corners[2], normals[0] * facing, normals[1] * facing, normals[2] * facing);
    // Whatever tangents came with the mesh, lobes need a frame about the final normal.
    const glm::vec3 along = out.tangent - out.normal * glm::dot(out.normal, out.tangent);
    if (m.anisotropy.strength > 0.0f && glm::dot(along, along) > 1e-12f) {
        out.tangent = glm::normalize(along);
        out.bitangent = glm::cross(out.normal, out.tangent);
    } else {
        shading::orthonormal_basis(out.normal, out.tangent, out.bitangent);
    }
    return out;
}

}  // namespace candela::truth
