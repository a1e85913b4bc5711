#include "candela/measure/image_light.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "shading/basis.glsl"
#include "shading/cube.glsl"
#include "shading/sampling.glsl"
#include "shading/sequence.glsl"

namespace candela::measure {
namespace {

using namespace shading;

constexpr std::uint32_t kSize = 128;
constexpr int kIrradianceSamples = 256;

scene::CubeMap halved(const scene::CubeMap& fine) {
    scene::CubeMap out{fine.size / 2, {}};
    for (std::uint32_t face = 0; face < 6; ++face)
        for (std::uint32_t y = 0; y < out.size; ++y)
            for (std::uint32_t x = 0; x < out.size; ++x) {
                vec3 sum(0.0f);
                float weights = 0.0f;
                for (std::uint32_t i = 0; i < 4; ++i) {
                    const std::uint32_t at_x = 2 * x + i % 2;
                    const std::uint32_t at_y = 2 * y + i / 2;
                    const float weight = cube_texel_solid_angle(at_x, at_y, fine.size);
                    sum += weight * fine.texels[fine.index(face, at_x, at_y)];
                    weights += weight;
                }
                out.texels.push_back(sum / weights);
            }
    return out;
}

vec3 bilinear(const scene::CubeMap& map, const vec3& uv_face) {
    const auto texel = [&map](float at) {
        return std::clamp(at * float(map.size) - 0.5f, 0.0f, float(map.size - 1));
    };
    const float x = texel(uv_face.x);
    const float y = texel(uv_face.y);
    const auto left = std::uint32_t(x);
    const auto top = std::uint32_t(y);
    const std::uint32_t right = std::min(left + 1, map.size - 1);
    const std::uint32_t bottom = std::min(top + 1, map.size - 1);
    const auto face = std::uint32_t(uv_face.z);
    const auto at = [&](std::uint32_t i, std::uint32_t j) { return map.texels[map.index(face, i, j)]; };
    return mix(mix(at(left, top), at(right, top), x - float(left)),
               mix(at(left, bottom), at(right, bottom), x - float(left)), y - float(top));
}

/// 1 within `inner` of the axis, 0 beyond `outer` (cosines).
float patch(const vec3& d, const vec3& axis, float outer, float inner) {
    return smoothstep(outer, inner, dot(d, normalize(axis)));
}

vec3 studio(const vec3& d) {
    vec3 light = mix(vec3(0.05f), vec3(0.16f), saturate(0.5f + 0.5f * d.y));
    const auto box = [&d](const vec3& axis, float half_width, float half_height) {
        vec3 t;
        vec3 b;
        const vec3 n = normalize(axis);
        orthonormal_basis(n, t, b);
        const float z = dot(d, n);
        if (z <= 0.0f) return 0.0f;
        return smoothstep(1.0f, 0.9f, std::abs(dot(d, t)) / (z * half_width)) *
               smoothstep(1.0f, 0.9f, std::abs(dot(d, b)) / (z * half_height));
    };
    light += vec3(6.0f, 5.6f, 5.0f) * box({-1.0f, 0.8f, 0.6f}, 0.5f, 0.25f);
    light += vec3(3.0f, 3.3f, 3.8f) * box({1.0f, 0.3f, 0.4f}, 0.15f, 0.7f);
    return light + vec3(4.0f) * box({0.1f, 1.0f, -0.3f}, 0.4f, 0.4f);
}

vec3 clear_sky(const vec3& d) {
    const vec3 sky = mix(vec3(1.0f, 1.05f, 1.1f), vec3(0.25f, 0.45f, 0.9f), sqrt(saturate(d.y)));
    vec3 light = mix(sky, vec3(0.22f, 0.18f, 0.13f), smoothstep(0.01f, -0.01f, d.y));
    const vec3 sun(0.5f, 0.6f, 0.62f);
    light += vec3(3.0f, 2.8f, 2.4f) * std::pow(saturate(dot(d, normalize(sun))), 60.0f);
    return light + vec3(3.0e4f, 2.8e4f, 2.5e4f) * patch(d, sun, 0.99993f, 0.99997f);
}

// Moon & Spencer's gradient over snow and earth.
vec3 overcast(const vec3& d) {
    if (d.y < 0.0f) return mix(vec3(0.12f, 0.1f, 0.08f), vec3(0.5f), smoothstep(-0.2f, 0.2f, d.x));
    return vec3((1.0f + 2.0f * d.y) / 3.0f);
}

vec3 two_tone(const vec3& d) {
    return d.x * 0.8f + d.z * 0.6f > 0.0f ? vec3(1.0f, 0.9f, 0.7f) : vec3(0.05f, 0.07f, 0.12f);
}

vec3 lamps_at_night(const vec3& d) {
    vec3 light = vec3(0.01f, 0.012f, 0.02f) * (1.5f + d.y);
    for (uint i = 0; i < 24; ++i) {
        const vec2 u = hammersley(i, 24);
        const float y = 1.1f * u.x - 0.3f;
        const float azimuth = TWO_PI * u.y;
        const float lower = std::sqrt(std::max(1.0f - y * y, 0.0f));
        const float size_rad = 0.02f + 0.05f * float(i % 5) / 4.0f;
        const float bright = 0.4f / square(size_rad) * (i % 3 == 0 ? 3.0f : 1.0f);
        light += bright * mix(vec3(1.0f, 0.6f, 0.25f), vec3(0.7f, 0.85f, 1.0f), float(i % 7) / 6.0f) *
                 patch(d, {lower * std::cos(azimuth), y, lower * std::sin(azimuth)},
                       std::cos(size_rad * 1.1f), std::cos(size_rad * 0.9f));
    }
    return light;
}

/// Discs of all sizes over one another: a power that falls with the square of the frequency, as in
/// photographs.
vec3 leaves(const vec3& d) {
    vec3 light = mix(vec3(0.5f, 0.7f, 1.1f), vec3(2.5f, 2.6f, 2.8f), saturate(d.y));
    for (uint i = 0; i < 400; ++i) {
        const vec2 u = sobol_owen(i, 77u);
        const vec2 w = sobol_owen(i, 78u);
        const vec3 axis = 2.0f * vec3(u.x, 0.0f, 0.0f) - vec3(1.0f, 0.0f, 0.0f);
        const float across = std::sqrt(std::max(1.0f - axis.x * axis.x, 0.0f));
        const vec3 centre(across * std::cos(TWO_PI * u.y), axis.x, across * std::sin(TWO_PI * u.y));
        // Radii by the inverse cube between 0.02 and 0.5 rad.
        const float radius_rad = 1.0f / std::sqrt(mix(2500.0f, 4.0f, w.x));
        if (dot(d, centre) < std::cos(radius_rad)) continue;
        light = mix(vec3(0.02f, 0.05f, 0.01f), vec3(0.35f, 0.4f, 0.1f), w.y);
    }
    return light;
}

}  // namespace

ImageLight::ImageLight(std::string name, const std::function<glm::vec3(const glm::vec3&)>& luminance)
    : name_(std::move(name)) {
    scene::CubeMap finest{kSize, {}};
    constexpr std::uint32_t across = 2;  // points a texel, to the square
    for (int face = 0; face < 6; ++face)
        for (std::uint32_t y = 0; y < kSize; ++y)
            for (std::uint32_t x = 0; x < kSize; ++x) {
                vec3 sum(0.0f);
                for (std::uint32_t i = 0; i < across * across; ++i) {
                    const vec2 uv = (vec2(float(x), float(y)) +
                                     (vec2(float(i % across), float(i / across)) + 0.5f) / float(across)) /
                                    float(kSize);
                    sum += luminance(normalize(cube_point(face, uv)));
                }
                finest.texels.push_back(sum / float(across * across));
            }
    levels_.push_back(std::move(finest));
    while (levels_.back().size > 1) levels_.push_back(halved(levels_.back()));
}

glm::vec3 ImageLight::around(const glm::vec3& direction, float solid_angle_sr) const {
    const float texel_sr = 4.0f * PI / float(6 * kSize * kSize);
    const float level =
        std::clamp(0.5f * std::log2(solid_angle_sr / texel_sr), 0.0f, float(levels_.size() - 1));
    const auto finer = std::min(std::size_t(level), levels_.size() - 2);
    const vec3 uv_face = cube_uv_face(direction);
    return mix(bilinear(levels_[finer], uv_face), bilinear(levels_[finer + 1], uv_face),
               level - float(finer));
}

glm::vec3 ImageLight::prefiltered(const glm::vec3& direction, float perceptual_roughness, int samples) const {
    const float alpha = alpha_from_perceptual_roughness(perceptual_roughness);
    const vec3 n = normalize(direction);
    vec3 t;
    vec3 b;
    orthonormal_basis(n, t, b);
    vec3 sum(0.0f);
    float weights = 0.0f;
    for (int i = 0; i < samples; ++i) {
        const vec3 h =
            sample_ggx_ndf(hammersley(uint(i), uint(samples)) + vec2(0.5f / float(samples)), alpha);
        const vec3 l = 2.0f * h.z * h - vec3(0.0f, 0.0f, 1.0f);
        if (l.z <= 0.0f) continue;
        const float pdf = pdf_reflected(pdf_ggx_ndf(h, alpha), h.z);
        sum += l.z * around(to_world(l, t, b, n), 1.0f / (pdf * float(samples)));
        weights += l.z;
    }
    return sum / weights;
}

glm::vec3 ImageLight::irradiance_over_pi(const glm::vec3& n) const {
    vec3 t;
    vec3 b;
    const vec3 unit = normalize(n);
    orthonormal_basis(unit, t, b);
    return integrate_light(
        *this, {t, b, unit, unit}, kIrradianceSamples,
        [](const vec2& u) {
            const vec3 l = sample_cosine_hemisphere(u);
            return DrawnDirection{l, pdf_cosine_hemisphere(l.z)};
        },
        [](const vec3& l) { return vec3(l.z * INV_PI); });
}

const std::vector<ImageLight>& image_lights() {
    static const std::vector<ImageLight> lights{
        {"studio", studio},     {"clear sky with sun", clear_sky},  {"overcast", overcast},
        {"two-tone", two_tone}, {"lamps at night", lamps_at_night}, {"leaves", leaves}};
    return lights;
}

ReceiverFrame receiver_frame(float NoV, int number, int count) {
    const vec2 u = hammersley(uint(number), uint(count)) + vec2(0.5f / float(count));
    ReceiverFrame out;
    const float y = 1.0f - 2.0f * u.x;
    const float across = std::sqrt(1.0f - y * y);
    out.n = vec3(across * std::cos(TWO_PI * u.y), y, across * std::sin(TWO_PI * u.y));
    vec3 t;
    vec3 b;
    orthonormal_basis(out.n, t, b);
    // Azimuths of the view by the golden angle, so that they are not in step with the normals.
    const float azimuth = 2.39996323f * float(number);
    out.t = std::cos(azimuth) * t + std::sin(azimuth) * b;
    out.b = cross(out.n, out.t);
    out.v = std::sqrt((1.0f - NoV) * (1.0f + NoV)) * out.t + NoV * out.n;
    return out;
}

glm::vec3 integrate_light(const ImageLight& light, const ReceiverFrame& frame, int samples,
                          const std::function<DrawnDirection(const glm::vec2&)>& draw,
                          const std::function<glm::vec3(const glm::vec3&)>& integrand) {
    vec3 sum(0.0f);
    for (int i = 0; i < samples; ++i) {
        const DrawnDirection d = draw(hammersley(uint(i), uint(samples)) + vec2(0.5f / float(samples)));
        if (!(d.pdf > 0.0f) || d.l.z <= 0.0f) continue;
        const vec3 seen =
            light.around(to_world(d.l, frame.t, frame.b, frame.n), 1.0f / (d.pdf * float(samples)));
        sum += seen * integrand(d.l) / d.pdf;
    }
    return sum / float(samples);
}

glm::vec3 integrate_light_ggx(const ImageLight& light, const ReceiverFrame& frame, const glm::vec2& alpha,
                              int samples, const std::function<glm::vec3(const glm::vec3&)>& integrand) {
    const vec3 v = to_local(frame.v, frame.t, frame.b, frame.n);
    return integrate_light(
        light, frame, samples,
        [&](const vec2& u) {
            const vec3 h = sample_ggx_vndf(u, v, alpha);
            const float VoH = dot(v, h);
            return DrawnDirection{2.0f * VoH * h - v, pdf_reflected(pdf_ggx_vndf(v, h, alpha), VoH)};
        },
        integrand);
}

}  // namespace candela::measure
