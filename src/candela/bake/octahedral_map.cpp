#include "candela/bake/octahedral_map.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <thread>

#include "shading/environment.glsl"
#include "shading/octahedral.glsl"

namespace candela::bake {
namespace {

/// Collects light that falls into texels; gutters are filled at the end.
class Splatter {
  public:
    explicit Splatter(std::uint32_t size)
        : size_(size),
          radiance_(std::size_t{size} * size),
          moment_(radiance_.size()),
          solid_angle_(radiance_.size()) {}

    void add(const glm::vec3& direction, const glm::vec3& moment_direction, const glm::vec3& radiance,
             float solid_angle) {
        const std::size_t texel = texel_of(direction);
        radiance_[texel] += glm::dvec3(radiance) * static_cast<double>(solid_angle);
        moment_[texel] += glm::dvec3(moment_direction) *
                          static_cast<double>(solid_angle * (shading::luminance(radiance) + 1e-20f));
        solid_angle_[texel] += solid_angle;
    }

    [[nodiscard]] OctahedralMap finish() const {
        OctahedralMap map;
        map.size = size_;
        map.texels.resize(radiance_.size(), glm::vec4(0.0f));
        map.solid_angle.resize(radiance_.size(), 0.0f);
        map.luminance_center.resize(radiance_.size(), glm::vec3(0.0f, 1.0f, 0.0f));
        for (std::uint32_t y = 1; y + 1 < size_; ++y) {
            for (std::uint32_t x = 1; x + 1 < size_; ++x) {
                const std::size_t i = std::size_t{y} * size_ + x;
                if (solid_angle_[i] > 0.0) {
                    map.texels[i] = glm::vec4(glm::vec3(radiance_[i] / solid_angle_[i]), 1.0f);
                    map.solid_angle[i] = static_cast<float>(solid_angle_[i]);
                }
                const double length = glm::length(moment_[i]);
                map.luminance_center[i] = length > 0.0 ? glm::vec3(moment_[i] / length) : map.direction(x, y);
            }
        }
        fill_gutters(map);
        return map;
    }

  private:
    [[nodiscard]] std::size_t texel_of(const glm::vec3& direction) const {
        const glm::vec2 e = shading::octahedral_encode(direction) * 0.5f + 0.5f;
        const auto last = static_cast<int>(size_) - 3;
        const int x = std::clamp(static_cast<int>(e.x * static_cast<float>(size_ - 2)), 0, last) + 1;
        const int y = std::clamp(static_cast<int>(e.y * static_cast<float>(size_ - 2)), 0, last) + 1;
        return static_cast<std::size_t>(y) * size_ + static_cast<std::size_t>(x);
    }

    std::uint32_t size_;
    std::vector<glm::dvec3> radiance_;
    std::vector<glm::dvec3> moment_;
    std::vector<double> solid_angle_;
};

}  // namespace

void fill_gutters(OctahedralMap& map) {
    const auto size = static_cast<int>(map.size);
    const auto at = [&](int x, int y) -> glm::vec4& {
        return map.texels[static_cast<std::size_t>(y) * map.size + static_cast<std::size_t>(x)];
    };
    const auto fill = [&](int x, int y) {
        const glm::ivec2 from = shading::octahedral_fold({x - 1, y - 1}, size - 2);
        at(x, y) = at(from.x + 1, from.y + 1);
    };
    for (int i = 0; i < size; ++i) {
        fill(i, 0);
        fill(i, size - 1);
        fill(0, i);
        fill(size - 1, i);
    }
}

glm::vec3 OctahedralMap::direction(std::uint32_t x, std::uint32_t y) const {
    const glm::vec2 center = (glm::vec2(x, y) - 0.5f) / static_cast<float>(interior());
    return shading::octahedral_decode(center * 2.0f - 1.0f);
}

OctahedralMap from_equirect(const scene::Environment& e, float scale, std::uint32_t size) {
    Splatter splatter(size);
    // Parts of a source texel that are smaller than a target texel leave no holes and no moire.
    const float source_rad = shading::PI / static_cast<float>(e.height);
    const float target_rad = 0.7f / static_cast<float>(size - 2);
    const auto parts =
        static_cast<std::uint32_t>(std::clamp(std::ceil(source_rad / target_rad), 1.0f, 64.0f));
    const float step = 1.0f / static_cast<float>(parts);
    for (std::uint32_t y = 0; y < e.height; ++y) {
        for (std::uint32_t sub_y = 0; sub_y < parts; ++sub_y) {
            const std::uint32_t row = y * parts + sub_y;
            const float solid_angle =
                shading::equirect_texel_solid_angle(row, e.width * parts, e.height * parts);
            const float v = (static_cast<float>(row) + 0.5f) / static_cast<float>(e.height * parts);
            for (std::uint32_t x = 0; x < e.width; ++x) {
                const glm::vec3 radiance = e.luminance_nit[std::size_t{y} * e.width + x] * scale;
                for (std::uint32_t sub_x = 0; sub_x < parts; ++sub_x) {
                    const float u = (static_cast<float>(x) + (static_cast<float>(sub_x) + 0.5f) * step) /
                                    static_cast<float>(e.width);
                    const glm::vec3 direction = shading::equirect_direction(glm::vec2(u, v));
                    splatter.add(direction, direction, radiance, solid_angle);
                }
            }
        }
    }
    return splatter.finish();
}

OctahedralMap halve(const OctahedralMap& from) {
    Splatter splatter(from.size / 2);
    for (std::uint32_t y = 1; y + 1 < from.size; ++y) {
        for (std::uint32_t x = 1; x + 1 < from.size; ++x) {
            const std::size_t i = std::size_t{y} * from.size + x;
            splatter.add(from.direction(x, y), from.luminance_center[i], glm::vec3(from.texels[i]),
                         from.solid_angle[i]);
        }
    }
    return splatter.finish();
}

OctahedralMap irradiance_over_pi(const OctahedralMap& source, std::uint32_t size) {
    struct Beam {
        glm::vec3 direction;
        glm::vec3 light;  // radiance * solid angle / pi
    };
    std::vector<Beam> beams;
    for (std::size_t i = 0; i < source.texels.size(); ++i) {
        if (source.solid_angle[i] <= 0.0f) continue;
        beams.push_back({source.luminance_center[i],
                         glm::vec3(source.texels[i]) * (source.solid_angle[i] * shading::INV_PI)});
    }
    OctahedralMap map;
    map.size = size;
    map.texels.resize(std::size_t{size} * size, glm::vec4(0.0f));
    map.solid_angle.resize(map.texels.size(), 0.0f);
    const auto rows = [&](std::uint32_t first, std::uint32_t step) {
        for (std::uint32_t y = 1 + first; y + 1 < size; y += step) {
            for (std::uint32_t x = 1; x + 1 < size; ++x) {
                const glm::vec3 n = map.direction(x, y);
                glm::vec3 sum(0.0f);
                for (const Beam& beam : beams)
                    sum += beam.light * std::max(glm::dot(n, beam.direction), 0.0f);
                map.texels[std::size_t{y} * size + x] = glm::vec4(sum, 1.0f);
            }
        }
    };
    {
        std::jthread other(rows, 1u, 2u);
        rows(0, 2);
    }
    fill_gutters(map);
    return map;
}

}  // namespace candela::bake
