#include "fingerprint.hpp"

#include <cstring>
#include <span>

#include "candela/realtime/material_block.hpp"
#include "candela/version.hpp"

namespace candela::app {
namespace {

/// FNV-1a over 8-byte words.
class Digest {
  public:
    void add(std::span<const std::byte> bytes) {
        word(bytes.size());
        for (std::size_t i = 0; i < bytes.size(); i += 8) {
            std::uint64_t w = 0;
            std::memcpy(&w, bytes.data() + i, std::min<std::size_t>(8, bytes.size() - i));
            word(w);
        }
    }
    void add(const std::string& text) { add(std::as_bytes(std::span(text))); }
    template <class T>
    void add(const std::vector<T>& values) {
        add(std::as_bytes(std::span(values)));
    }
    /// Of types without padding.
    template <class... T>
    void numbers(const T&... values) {
        (add(std::as_bytes(std::span(&values, 1))), ...);
    }
    [[nodiscard]] std::uint64_t value() const { return hash_; }

  private:
    void word(std::uint64_t w) { hash_ = (hash_ ^ w) * 0x100000001b3u; }
    std::uint64_t hash_ = 0xcbf29ce484222325u;
};

void add_materials(const scene::Scene& scene, Digest& digest) {
    for (const scene::Material& m : scene.materials) {
        digest.numbers(realtime::material_block(m),
                       realtime::material_features(m, scene::FullyRoughRule::flagged), m.alpha_mode,
                       m.double_sided, m.unlit);
        for (const scene::TextureRef* ref : realtime::texture_refs(m)) digest.numbers(ref->texture);
    }
    for (const scene::Texture& t : scene.textures) {
        digest.numbers(t.image, t.sampler.wrap_s, t.sampler.wrap_t, t.sampler.magnify, t.sampler.minify,
                       t.sampler.mip);
    }
    for (const scene::Image& image : scene.images) {
        digest.numbers(image.width, image.height);
        digest.add(image.rgba);
    }
}

void add_geometry(const scene::Scene& scene, Digest& digest) {
    for (const scene::Mesh& mesh : scene.meshes) {
        for (const scene::Primitive& p : mesh.primitives) {
            digest.add(p.positions);
            digest.add(p.normals);
            digest.add(p.tangents);
            digest.add(p.uv[0]);
            digest.add(p.uv[1]);
            digest.add(p.colors);
            digest.add(p.indices);
            digest.numbers(p.material);
        }
    }
    for (const scene::Instance& i : scene.instances) digest.numbers(i.mesh, i.world);
}

void add_light(const scene::Scene& scene, Digest& digest) {
    for (const scene::Light& l : scene.lights) {
        digest.numbers(l.type, l.position, l.direction, l.right, l.color, l.intensity, l.range_m,
                       l.inner_cone_rad, l.outer_cone_rad, l.cone, l.horizontal_angle_rad,
                       l.vertical_angle_rad, l.angular_diameter_rad, l.limb_darkening, l.radius_m,
                       l.half_width_m, l.half_height_m, l.two_sided, l.visible, l.casts_shadow, l.profile,
                       l.image);
    }
    for (const scene::PhotometricProfile& p : scene.profiles) {
        digest.add(p.vertical_deg);
        digest.add(p.horizontal_deg);
        digest.add(p.candela);
    }
    if (!scene.environment) return;
    const scene::Environment& e = *scene.environment;
    digest.numbers(e.width, e.height, e.scale, e.rotation_rad, e.visible);
    digest.add(e.luminance_nit);
}

void add_probes(const scene::Scene& scene, Digest& digest) {
    for (const scene::ReflectionProbe& p : scene.reflection_probes)
        digest.numbers(p.shape, p.world, p.half_size_m, p.capture_offset_m, p.margin_m, p.fade_m);
    for (const scene::IrradianceVolume& v : scene.irradiance_volumes)
        digest.numbers(v.world, v.half_size_m, v.cells, v.fade_m);
}

}  // namespace

std::uint64_t scene_fingerprint(const scene::Scene& scene, const std::string& settings) {
    Digest digest;
    digest.add(std::string(version()));
    digest.add(settings);
    add_geometry(scene, digest);
    add_materials(scene, digest);
    add_light(scene, digest);
    add_probes(scene, digest);
    return digest.value();
}

std::uint64_t fingerprint(const Job& job, const std::string& settings) {
    Digest digest;
    digest.add(std::string(version()));
    digest.add(settings);
    digest.add(realtime::describe(job.profile));
    digest.numbers(job.width, job.height);
    const scene::Camera& c = job.camera;
    digest.numbers(c.world, c.projection, c.yfov_rad, c.ymag_m, c.znear_m, c.zfar_m);
    add_geometry(job.scene, digest);
    add_materials(job.scene, digest);
    add_light(job.scene, digest);
    return digest.value();
}

}  // namespace candela::app
