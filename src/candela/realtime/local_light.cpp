#include "candela/realtime/local_light.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <glm/matrix.hpp>

#include "candela/scene/half_range.hpp"
#include "shading/probes/volume.glsl"

namespace candela::realtime {
namespace {

constexpr std::uint32_t kHeaderQuads = 2;
constexpr std::uint32_t kProbeQuads = 15;
constexpr std::uint32_t kVolumeQuads = 6;

/// Quads of four words, written in the order in which the shader finds them.
class Quads {
  public:
    void numbers(const glm::vec4& v) { quads_.push_back(glm::floatBitsToUint(v)); }
    void words(const glm::uvec4& v) { quads_.push_back(v); }
    void to_local(const glm::mat4& world) {
        const glm::mat4 inverse = glm::inverse(world);
        for (int row = 0; row < 3; ++row)
            numbers({inverse[0][row], inverse[1][row], inverse[2][row], inverse[3][row]});
    }
    [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(quads_.size()); }
    [[nodiscard]] glm::uvec4& operator[](std::size_t i) { return quads_[i]; }
    [[nodiscard]] std::span<const std::byte> bytes() const { return std::as_bytes(std::span(quads_)); }

  private:
    std::vector<glm::uvec4> quads_;
};

float peak_of(const scene::ProbeCapture& capture) {
    float peak = 0.0f;
    for (const auto& level : capture.levels) {
        for (const glm::vec4& t : level) peak = std::max(peak, std::max(t.x, std::max(t.y, t.z)));
    }
    return peak;
}

float peak_of(const scene::IrradianceVolume& volume) {
    float peak = 0.0f;
    for (const scene::IrradianceProbe& probe : volume.probes) {
        for (const glm::vec3& c : probe.irradiance_sh)
            peak = std::max({peak, std::abs(c.x), std::abs(c.y), std::abs(c.z)});
    }
    return peak;
}

/// Two coefficients of one channel a word, five words a channel, then whether the probe counts.
void write_harmonics(const scene::IrradianceProbe& probe, float unit, Quads& out) {
    std::uint32_t words[16];
    for (int channel = 0; channel < 3; ++channel) {
        for (std::size_t pair = 0; pair < 5; ++pair) {
            const float a = probe.irradiance_sh[2 * pair][channel] / unit;
            const float b = pair < 4 ? probe.irradiance_sh[2 * pair + 1][channel] / unit : 0.0f;
            words[std::size_t(channel) * 5 + pair] = glm::packHalf2x16({a, b});
        }
    }
    words[15] = glm::packHalf2x16({probe.valid ? 1.0f : 0.0f, 0.0f});
    for (int quad = 0; quad < 4; ++quad)
        out.words({words[4 * quad], words[4 * quad + 1], words[4 * quad + 2], words[4 * quad + 3]});
}

void write_distances(const scene::IrradianceProbe& probe, Quads& out) {
    const auto packed = [&](std::size_t i) {
        const glm::vec2 d = probe.distances[i];
        return glm::packHalf2x16({d.x, std::sqrt(std::max(d.y - d.x * d.x, 0.0f))});
    };
    for (std::size_t i = 0; i < probe.distances.size(); i += 4)
        out.words({packed(i), packed(i + 1), packed(i + 2), packed(i + 3)});
}

struct AtlasShape {
    std::uint32_t columns = 1;
    std::uint32_t rows = 1;
    std::uint32_t size = 0;  ///< of a tile; 0: no maps
    std::uint32_t levels = 1;
};

AtlasShape atlas_shape(const std::vector<const scene::ReflectionProbe*>& probes) {
    AtlasShape a;
    if (probes.empty() || probes.front()->capture.levels.empty()) return a;
    a.size = probes.front()->capture.size;
    a.levels = static_cast<std::uint32_t>(probes.front()->capture.levels.size());
    a.columns = static_cast<std::uint32_t>(std::ceil(std::sqrt(double(probes.size()))));
    a.rows = (static_cast<std::uint32_t>(probes.size()) + a.columns - 1) / a.columns;
    return a;
}

std::uint64_t half4(const glm::vec4& v) {
    return glm::packHalf4x16(v);
}

void copy_tile(const scene::ReflectionProbe& probe, std::uint32_t level, std::uint32_t size,
               std::size_t stride, std::uint64_t* to) {
    const float per_unit = 1.0f / scene::unit_for_half(peak_of(probe.capture));
    const std::vector<glm::vec4>& from = probe.capture.levels[level];
    for (std::uint32_t y = 0; y < size; ++y) {
        for (std::uint32_t x = 0; x < size; ++x) {
            const glm::vec4& t = from[std::size_t{y} * size + x];
            to[y * stride + x] = half4({glm::vec3(t) * per_unit, t.w});
        }
    }
}

gpu::Image upload_atlas(const gpu::Device& device, gpu::Commands& commands,
                        const std::vector<const scene::ReflectionProbe*>& probes, const AtlasShape& shape) {
    if (shape.size == 0) {
        gpu::Image none(device, {1, 1, VK_FORMAT_R16G16B16A16_SFLOAT, VK_IMAGE_USAGE_SAMPLED_BIT});
        return none;
    }
    const std::uint32_t width = shape.columns * shape.size;
    const std::uint32_t height = shape.rows * shape.size;
    gpu::Image atlas(
        device, {width, height, VK_FORMAT_R16G16B16A16_SFLOAT, VK_IMAGE_USAGE_SAMPLED_BIT, shape.levels});
    gpu::Buffer staging(device, std::size_t{width} * height * sizeof(std::uint64_t),
                        VK_BUFFER_USAGE_TRANSFER_SRC_BIT, gpu::MemoryKind::upload);
    for (std::uint32_t level = 0; level < shape.levels; ++level) {
        const std::uint32_t size = shape.size >> level;
        const std::size_t stride = width >> level;
        auto texels = staging.mapped_as<std::uint64_t>();
        std::fill(texels.begin(), texels.end(), 0);
        for (std::size_t i = 0; i < probes.size(); ++i) {
            const std::size_t row = i / shape.columns * size;
            copy_tile(*probes[i], level, size, stride,
                      texels.data() + row * stride + i % shape.columns * size);
        }
        commands.begin();
        commands.copy(staging, atlas, level);
        commands.use(atlas, gpu::Use::sampled);
        commands.submit_and_wait();
    }
    return atlas;
}

void write_probe(const scene::ReflectionProbe& probe, std::size_t index, const AtlasShape& shape,
                 Quads& out) {
    out.to_local(probe.world);
    out.numbers({probe.half_size_m, static_cast<float>(probe.shape)});
    out.numbers({probe.capture_offset_m, probe.fade_m});
    out.numbers({static_cast<float>(index % shape.columns), static_cast<float>(index / shape.columns),
                 probe.margin_m, scene::unit_for_half(peak_of(probe.capture))});
    for (const glm::vec4& c : probe.capture.irradiance_sh) out.numbers(c);
}

}  // namespace

std::uint32_t local_light_bits(const scene::Scene& scene, bool capture) {
    std::uint32_t bits = capture ? local_capture : 0u;
    for (const scene::ReflectionProbe& probe : scene.reflection_probes) {
        if (capture || !probe.capture.empty()) bits |= local_probes;
    }
    for (const scene::IrradianceVolume& volume : scene.irradiance_volumes) {
        if (!volume.probes.empty()) bits |= local_volumes;
    }
    return bits;
}

void upload_local_light(const gpu::Device& device, gpu::Commands& commands,
                        std::span<const scene::ReflectionProbe> probes,
                        std::span<const scene::IrradianceVolume> volumes, LocalLight& out) {
    const bool capture = (out.bits & local_capture) != 0;
    std::vector<const scene::ReflectionProbe*> taken;
    for (const scene::ReflectionProbe& probe : probes) {
        if (capture || !probe.capture.empty()) taken.push_back(&probe);
    }
    // The order of composition (Frostbite 4.9.5), whatever order the scene has.
    std::stable_sort(taken.begin(), taken.end(),
                     [](const auto* a, const auto* b) { return a->volume_m3() < b->volume_m3(); });
    std::vector<const scene::IrradianceVolume*> baked;
    for (const scene::IrradianceVolume& volume : volumes) {
        if (!volume.probes.empty()) baked.push_back(&volume);
    }
    // Here too the smaller one wins, whatever order the scene has.
    std::stable_sort(baked.begin(), baked.end(), [](const auto* a, const auto* b) {
        const auto size = [](const glm::vec3& half) { return half.x * half.y * half.z; };
        return size(a->half_size_m) < size(b->half_size_m);
    });
    const AtlasShape shape = capture ? AtlasShape{} : atlas_shape(taken);
    Quads quads;
    const auto probe_count = static_cast<std::uint32_t>(taken.size());
    const std::uint32_t first_volume = kHeaderQuads + probe_count * kProbeQuads;
    quads.words({probe_count, kHeaderQuads, static_cast<std::uint32_t>(baked.size()), first_volume});
    quads.numbers({shape.columns, shape.rows, shape.size, shape.levels});
    for (std::size_t i = 0; i < taken.size(); ++i) write_probe(*taken[i], i, shape, quads);
    for (const scene::IrradianceVolume* volume : baked) {
        quads.to_local(volume->world);
        quads.numbers({volume->half_size_m, volume->fade_m});
        quads.words({glm::uvec3(volume->cells), 0u});
        quads.words(glm::uvec4(0u));
    }
    for (std::size_t i = 0; i < baked.size(); ++i) {
        const float unit = scene::unit_for_half(peak_of(*baked[i]));
        glm::uvec4& places = quads[first_volume + i * kVolumeQuads + 5];
        places.x = quads.size();
        places.z = glm::floatBitsToUint(unit);
        for (const scene::IrradianceProbe& probe : baked[i]->probes) write_harmonics(probe, unit, quads);
        quads[first_volume + i * kVolumeQuads + 5].y = 4 * quads.size();
        for (const scene::IrradianceProbe& probe : baked[i]->probes) write_distances(probe, quads);
    }
    out.buffer = gpu::upload_buffer(device, commands, quads.bytes(), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    out.atlas = upload_atlas(device, commands, taken, shape);
}

}  // namespace candela::realtime
