#include "candela/scene/environment_resample.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "shading/cube.glsl"
#include "shading/environment.glsl"
#include "shading/octahedral.glsl"

namespace candela::scene {
namespace {

/// Samples a side of a texel of the result: several for the smallest texel of a source of equal resolution.
constexpr std::uint32_t kSamples = 4;

/// Runs visit(texel, direction, solid angle) over a grid of directions finer than the picture's texels.
template <class Visit>
void visit_directions(PictureSize size, Visit&& visit) {
    std::vector<glm::dvec2> azimuths(std::size_t{size.width} * kSamples);
    for (std::size_t x = 0; x < azimuths.size(); ++x) {
        const double a =
            2.0 * M_PI * ((static_cast<double>(x) + 0.5) / static_cast<double>(azimuths.size()) - 0.5);
        azimuths[x] = {std::sin(a), -std::cos(a)};
    }
    const double step = M_PI / (double{kSamples} * size.height);
    for (std::uint32_t row = 0; row < size.height * kSamples; ++row) {
        const double polar = (row + 0.5) * step;
        const double across = std::sin(polar), up = std::cos(polar);
        const auto solid_angle = static_cast<float>(2.0 * M_PI / static_cast<double>(azimuths.size()) * 2.0 *
                                                    across * std::sin(0.5 * step));
        for (std::size_t x = 0; x < azimuths.size(); ++x) {
            const glm::vec3 direction(across * azimuths[x].x, up, across * azimuths[x].y);
            visit(std::size_t{row / kSamples} * size.width + x / kSamples, direction, solid_angle);
        }
    }
}

/// A picture of directions to read from.
struct Source {
    const std::vector<glm::vec3>* texels;
    std::vector<float> solid_angles;
    std::vector<glm::vec3> excess;  ///< of a texel over the least of itself and its neighbours
};

/// Of a square of `side` texels that starts at `first`.
void find_excess(Source& source, std::size_t first, std::uint32_t side) {
    const auto at = [&](std::uint32_t x, std::uint32_t y) -> const glm::vec3& {
        return (*source.texels)[first + std::size_t{y} * side + x];
    };
    for (std::uint32_t y = 0; y < side; ++y) {
        for (std::uint32_t x = 0; x < side; ++x) {
            glm::vec3 least = at(x, y);
            for (std::uint32_t v = y > 0 ? y - 1 : 0; v <= std::min(y + 1, side - 1); ++v) {
                for (std::uint32_t u = x > 0 ? x - 1 : 0; u <= std::min(x + 1, side - 1); ++u)
                    least = glm::min(least, at(u, v));
            }
            source.excess[first + std::size_t{y} * side + x] = at(x, y) - least;
        }
    }
}

/// The mean over each texel of the result; the excess of a source texel is spread so that all of it arrives,
/// however few samples have met it.
template <class Lookup>
Environment gather(const Source& source, PictureSize size, Lookup&& lookup) {
    Environment out;
    out.width = size.width;
    out.height = size.height;
    std::vector<float> met(source.texels->size(), 0.0f);
    visit_directions(size, [&](std::size_t, const glm::vec3& direction, float solid_angle) {
        met[lookup(direction)] += solid_angle;
    });
    std::vector<glm::vec3> values(source.texels->size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        const float all_of_it = met[i] > 0.0f ? source.solid_angles[i] / met[i] : 1.0f;
        values[i] = (*source.texels)[i] + (all_of_it - 1.0f) * source.excess[i];
    }
    out.luminance_nit.assign(std::size_t{size.width} * size.height, glm::vec3(0.0f));
    visit_directions(size, [&](std::size_t texel, const glm::vec3& direction, float solid_angle) {
        out.luminance_nit[texel] += values[lookup(direction)] * solid_angle;
    });
    for (std::uint32_t y = 0; y < size.height; ++y) {
        const float texel = shading::equirect_texel_solid_angle(y, size.width, size.height);
        for (std::uint32_t x = 0; x < size.width; ++x)
            out.luminance_nit[std::size_t{y} * size.width + x] /= texel;
    }
    return out;
}

std::uint32_t texel_of(float uv, std::uint32_t side) {
    return std::min(static_cast<std::uint32_t>(std::max(uv, 0.0f) * static_cast<float>(side)), side - 1);
}

constexpr std::uint32_t kLargestWidth = 16384;

PictureSize picture_of_height(std::uint32_t height) {
    const std::uint32_t h = std::clamp(height, 1u, kLargestWidth / 2);
    return {2 * h, h};
}

/// Where on the square map of the ground a direction of the world is.
glm::vec3 on_the_map(const glm::vec3& direction) {
    return {direction.x, -direction.z, direction.y};
}

/// Solid angle in sr of texel (x, y) of a square [-1,1]^2 whose points stand for points(a, b) of planes on
/// which a step in a and b is one of the same size in two coordinates: there it is da db / |p|^3. In double,
/// because the difference of cube_corner_solid_angle loses the digits of a small texel.
template <class Points>
float texel_solid_angle(std::uint32_t x, std::uint32_t y, std::uint32_t side, Points&& points) {
    const int steps = side < 16 ? 32 : 4;
    const double step = 2.0 / (double(steps) * side), left = -1.0 + step * steps * x,
                 top = -1.0 + step * steps * y;
    double sum = 0.0;
    for (int v = 0; v < steps; ++v) {
        for (int u = 0; u < steps; ++u) {
            const glm::dvec3 p = points(left + (u + 0.5) * step, top + (v + 0.5) * step);
            sum += step * step / std::pow(p.x * p.x + p.y * p.y + p.z * p.z, 1.5);
        }
    }
    return static_cast<float>(sum);
}

/// On the octahedron of radius 1, but for signs and order.
glm::dvec3 octahedron_point(double x, double y) {
    const double a = std::abs(x), b = std::abs(y);
    const bool folded = a + b > 1.0;
    const double px = folded ? 1.0 - b : a, py = folded ? 1.0 - a : b;
    return {px, py, 1.0 - px - py};
}

/// Of the angle to the middle's direction, the distance from the middle of the circle of radius 1. Debevec
/// 1998, "Rendering Synthetic Objects into Real Scenes", and the notes to his light probes: phi = pi r for
/// angular maps. On a mirroring sphere the normal halves the angle.
double circle_radius(CircleProjection projection, double angle) {
    return projection == CircleProjection::angular ? angle / M_PI : std::sin(0.5 * angle);
}

/// Solid angle over area of the circle at this distance from its middle, none beyond it: sin(angle) d(angle)
/// / (r dr).
double circle_density(CircleProjection projection, double r) {
    if (r > 1.0) return 0.0;
    if (projection == CircleProjection::mirror_ball) return 4.0;
    return r > 1.0e-6 ? M_PI * std::sin(M_PI * r) / r : M_PI * M_PI;
}

float circle_texel_solid_angle(CircleProjection projection, std::uint32_t x, std::uint32_t y,
                               std::uint32_t side) {
    constexpr int steps = 8;
    const double step = 2.0 / (double{steps} * side);
    double sum = 0.0;
    for (int v = 0; v < steps; ++v) {
        for (int u = 0; u < steps; ++u) {
            const double a = -1.0 + step * (double(steps) * x + u + 0.5);
            const double b = -1.0 + step * (double(steps) * y + v + 0.5);
            sum += step * step * circle_density(projection, std::hypot(a, b));
        }
    }
    return static_cast<float>(sum);
}

}  // namespace

PictureSize equirect_size_of_cube(std::uint32_t face_size) noexcept {
    return picture_of_height(2 * std::min(face_size, kLargestWidth));
}

PictureSize equirect_size_of_octahedral(std::uint32_t size) noexcept {
    return picture_of_height(std::min(size, kLargestWidth) * 3 / 2);
}

Environment equirect_from_cube(const CubeMap& cube, CubeSpace space, PictureSize size) {
    Source source{&cube.texels, std::vector<float>(cube.texels.size()),
                  std::vector<glm::vec3>(cube.texels.size())};
    std::vector<float> one_face(std::size_t{cube.size} * cube.size);
    for (std::uint32_t i = 0; i < one_face.size(); ++i) {
        one_face[i] = texel_solid_angle(i % cube.size, i / cube.size, cube.size,
                                        [](double x, double y) { return glm::dvec3(x, y, 1.0); });
    }
    for (std::uint32_t face = 0; face < 6; ++face) {
        find_excess(source, cube.index(face, 0, 0), cube.size);
        for (std::uint32_t y = 0; y < cube.size; ++y) {
            for (std::uint32_t x = 0; x < cube.size; ++x)
                source.solid_angles[cube.index(face, x, y)] = one_face[std::size_t{y} * cube.size + x];
        }
    }
    const float ahead = space == CubeSpace::picture ? -1.0f : 1.0f;
    return gather(source, size, [&](const glm::vec3& d) {
        const glm::vec3 place = shading::cube_uv_face({d.x, d.y, ahead * d.z});
        return cube.index(static_cast<std::uint32_t>(place.z), texel_of(place.x, cube.size),
                          texel_of(place.y, cube.size));
    });
}

Environment equirect_from_octahedral(const std::vector<glm::vec3>& texels, std::uint32_t side,
                                     PictureSize size) {
    Source source{&texels, std::vector<float>(texels.size()), std::vector<glm::vec3>(texels.size())};
    find_excess(source, 0, side);
    for (std::uint32_t y = 0; y < side; ++y) {
        for (std::uint32_t x = 0; x < side; ++x)
            source.solid_angles[std::size_t{y} * side + x] = texel_solid_angle(x, y, side, octahedron_point);
    }
    return gather(source, size, [&](const glm::vec3& d) {
        const glm::vec2 e = shading::octahedral_encode(on_the_map(d));
        return std::size_t{texel_of(0.5f - 0.5f * e.y, side)} * side + texel_of(0.5f * e.x + 0.5f, side);
    });
}

PictureSize equirect_size_of_circle(CircleProjection projection, std::uint32_t size) noexcept {
    // Of the middle: size / 2 texels for half a turn; a mirror ball shows it 4 / pi times as large.
    const std::uint32_t side = std::min(size, kLargestWidth);
    return picture_of_height(projection == CircleProjection::angular ? side / 2 : side * 3 / 4);
}

Environment equirect_from_circle(const std::vector<glm::vec3>& texels, std::uint32_t side,
                                 CircleProjection projection, PictureSize size) {
    Source source{&texels, std::vector<float>(texels.size()), std::vector<glm::vec3>(texels.size())};
    find_excess(source, 0, side);
    for (std::uint32_t y = 0; y < side; ++y) {
        for (std::uint32_t x = 0; x < side; ++x)
            source.solid_angles[std::size_t{y} * side + x] = circle_texel_solid_angle(projection, x, y, side);
    }
    // A texel on the rim has its middle outside of the circle, where pictures are black.
    const double farthest = std::max(1.0 - 1.5 / side, 0.0);
    const double middle = projection == CircleProjection::angular ? -1.0 : 1.0;
    return gather(source, size, [&](const glm::vec3& d) {
        const double across = std::hypot(double{d.x}, double{d.y});
        const double angle = std::atan2(across, middle * double{d.z});
        const double r = std::min(circle_radius(projection, angle), farthest);
        const double k = across > 0.0 ? r / across : 0.0;
        const auto u = static_cast<float>(0.5 + 0.5 * k * double{d.x});
        const auto v = static_cast<float>(0.5 - 0.5 * k * double{d.y});
        return std::size_t{texel_of(v, side)} * side + texel_of(u, side);
    });
}

}  // namespace candela::scene
