#include "candela/io/probe_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/packing.hpp>

#include "candela/scene/half_range.hpp"
#include "shading/probes/volume.glsl"

namespace candela::io {
namespace {

constexpr std::uint32_t kVersion = 1;
constexpr std::uint32_t kIrradianceMagic = 0x56524943;  // "CIRV"
constexpr std::uint32_t kCaptureMagic = 0x42525043;     // "CPRB"
constexpr std::uint32_t kLargestMap = 4096;
constexpr auto kDistanceTexels = static_cast<std::uint32_t>(shading::kDistanceSize * shading::kDistanceSize);

class Writer {
  public:
    template <class T>
    void raw(const T& value) {
        bytes_.append(reinterpret_cast<const char*>(&value), sizeof(T));
    }
    void half(float x) { raw(glm::packHalf1x16(x)); }
    [[nodiscard]] std::string take() { return std::move(bytes_); }

  private:
    std::string bytes_;
};

/// Reads zeros after the end, and remembers.
class Reader {
  public:
    explicit Reader(const std::string& bytes) : bytes_(bytes) {}
    template <class T>
    T raw() {
        T value{};
        if (bytes_.size() - at_ < sizeof(T)) {
            good_ = false;
            return value;
        }
        std::memcpy(&value, bytes_.data() + at_, sizeof(T));
        at_ += sizeof(T);
        return value;
    }
    float half() { return glm::unpackHalf1x16(raw<std::uint16_t>()); }
    [[nodiscard]] bool good() const { return good_; }
    [[nodiscard]] bool ended() const { return good_ && at_ == bytes_.size(); }

  private:
    const std::string& bytes_;
    std::size_t at_ = 0;
    bool good_ = true;
};

void write_head(Writer& out, std::uint32_t magic, std::uint64_t key, std::size_t count) {
    out.raw(magic);
    out.raw(kVersion);
    out.raw(key);
    out.raw(static_cast<std::uint32_t>(count));
}

bool read_head(Reader& in, std::uint32_t magic, std::uint64_t key, std::size_t count) {
    const bool same = in.raw<std::uint32_t>() == magic && in.raw<std::uint32_t>() == kVersion;
    return same && in.raw<std::uint64_t>() == key && in.raw<std::uint32_t>() == count && in.good();
}

void write_volume(Writer& out, const scene::IrradianceVolume& v) {
    float peak = 0.0f;
    for (const auto& probe : v.probes) {
        for (const glm::vec3& c : probe.irradiance_sh)
            peak = std::max({peak, std::abs(c.x), std::abs(c.y), std::abs(c.z)});
    }
    const float unit = scene::unit_for_half(peak);
    out.raw(v.cells);
    out.raw(unit);
    for (const auto& probe : v.probes) {
        out.raw(static_cast<std::uint8_t>(probe.valid));
        for (const glm::vec3& c : probe.irradiance_sh)
            out.half(c.x / unit), out.half(c.y / unit), out.half(c.z / unit);
        out.raw(static_cast<std::uint32_t>(probe.distances.size()));
        for (const glm::vec2& d : probe.distances) {
            out.half(d.x);
            out.half(std::sqrt(std::max(d.y - d.x * d.x, 0.0f)));
        }
    }
}

bool read_volume(Reader& in, scene::IrradianceVolume& v) {
    if (in.raw<glm::ivec3>() != v.cells) return false;
    const float unit = in.raw<float>();
    v.probes.assign(v.probe_count(), {});
    for (auto& probe : v.probes) {
        probe.valid = in.raw<std::uint8_t>() != 0;
        for (glm::vec3& c : probe.irradiance_sh) {
            for (int channel = 0; channel < 3; ++channel) c[channel] = in.half() * unit;
        }
        const auto distances = in.raw<std::uint32_t>();
        if (!in.good() || distances != kDistanceTexels) return false;
        probe.distances.resize(distances);
        for (glm::vec2& d : probe.distances) {
            d.x = in.half();
            const float deviation = in.half();
            d.y = d.x * d.x + deviation * deviation;
        }
    }
    return in.good();
}

void write_capture(Writer& out, const scene::ProbeCapture& c) {
    float peak = 0.0f;
    for (const auto& level : c.levels) {
        for (const glm::vec4& t : level) peak = std::max({peak, t.x, t.y, t.z});
    }
    const float unit = scene::unit_for_half(peak);
    out.raw(c.size);
    out.raw(static_cast<std::uint32_t>(c.levels.size()));
    out.raw(unit);
    for (const glm::vec4& h : c.irradiance_sh) out.raw(h);
    for (const auto& level : c.levels) {
        for (const glm::vec4& t : level) out.raw(glm::packHalf4x16({glm::vec3(t) / unit, t.w}));
    }
}

bool read_capture(Reader& in, scene::ProbeCapture& c) {
    c.size = in.raw<std::uint32_t>();
    const auto levels = in.raw<std::uint32_t>();
    const float unit = in.raw<float>();
    if (!in.good() || c.size == 0 || c.size > kLargestMap || levels < 2 || levels > 12) return false;
    for (glm::vec4& h : c.irradiance_sh) h = in.raw<glm::vec4>();
    c.levels.resize(levels);
    for (std::uint32_t level = 0; level < levels; ++level) {
        const std::size_t size = std::max(1u, c.size >> level);
        c.levels[level].resize(size * size);
        for (glm::vec4& t : c.levels[level]) {
            t = glm::unpackHalf4x16(in.raw<std::uint64_t>());
            t = glm::vec4(glm::vec3(t) * unit, t.w);
        }
        if (!in.good()) return false;
    }
    return true;
}

}  // namespace

std::string encode_irradiance(const std::vector<scene::IrradianceVolume>& volumes, std::uint64_t key) {
    Writer out;
    write_head(out, kIrradianceMagic, key, volumes.size());
    for (const auto& v : volumes) write_volume(out, v);
    return out.take();
}

bool decode_irradiance(const std::string& bytes, std::uint64_t key,
                       std::vector<scene::IrradianceVolume>& volumes) {
    Reader in(bytes);
    std::vector<scene::IrradianceVolume> read = volumes;
    if (!read_head(in, kIrradianceMagic, key, volumes.size())) return false;
    for (auto& v : read) {
        if (!read_volume(in, v)) return false;
    }
    if (!in.ended()) return false;
    volumes = std::move(read);
    return true;
}

std::string encode_captures(const std::vector<scene::ReflectionProbe>& probes, std::uint64_t key) {
    Writer out;
    write_head(out, kCaptureMagic, key, probes.size());
    for (const auto& p : probes) write_capture(out, p.capture);
    return out.take();
}

bool decode_captures(const std::string& bytes, std::uint64_t key,
                     std::vector<scene::ReflectionProbe>& probes) {
    Reader in(bytes);
    std::vector<scene::ReflectionProbe> read = probes;
    if (!read_head(in, kCaptureMagic, key, probes.size())) return false;
    for (auto& p : read) {
        if (!read_capture(in, p.capture)) return false;
        // The frame puts them into one atlas of equal tiles.
        if (p.capture.size != read.front().capture.size ||
            p.capture.levels.size() != read.front().capture.levels.size())
            return false;
    }
    if (!in.ended()) return false;
    probes = std::move(read);
    return true;
}

}  // namespace candela::io
