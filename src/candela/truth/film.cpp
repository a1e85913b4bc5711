#include "candela/truth/film.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shading/language.glsl"

namespace candela::truth {
namespace {

void add3(const glm::vec3& value, float* to) {
    to[0] += value.x;
    to[1] += value.y;
    to[2] += value.z;
}

double luminance(const double* rgb) {
    return shading::luminance(glm::dvec3(rgb[0], rgb[1], rgb[2]));
}

}  // namespace

void FilmLayout::add(const PathResult& path, float* pixel) const {
    add3(path.luminance_nit, pixel + luminance);
    pixel[squared] += shading::square(shading::luminance(path.luminance_nit));
    add3(path.unlit, pixel + unlit);
    pixel[unlit + 3] += path.sees_unlit ? 1.0f : 0.0f;
    if (!aovs) return;
    add3(path.direct_diffuse, pixel + lobes);
    add3(path.direct_specular, pixel + lobes + 3);
    add3(path.indirect_diffuse, pixel + lobes + 6);
    add3(path.indirect_specular, pixel + lobes + 9);
    add3(path.emissive, pixel + lobes + 12);
    add3(path.albedo, pixel + albedo);
    add3(path.normal, pixel + normal);
    pixel[distance] += path.distance_m;
    add3(path.environment, pixel + environment);
}

Film::Film(std::uint32_t width, std::uint32_t height, const FilmLayout& layout)
    : width_(width), height_(height), tiles_x_((width + tile_size - 1) / tile_size), layout_(layout) {
    tiles.resize(std::size_t{tiles_x_} * ((height + tile_size - 1) / tile_size));
    sums.resize(std::size_t{width} * height * layout.channels());
    ids.resize(std::size_t{width} * height, glm::uvec2(0u));
}

Film::Rect Film::rect(std::uint32_t tile) const {
    const glm::uvec2 begin(tile % tiles_x_ * tile_size, tile / tiles_x_ * tile_size);
    return {begin, {std::min(begin.x + tile_size, width_), std::min(begin.y + tile_size, height_)}};
}

const Film::Tile& Film::tile_of(std::uint32_t x, std::uint32_t y) const {
    return tiles[std::size_t{y / tile_size} * tiles_x_ + x / tile_size];
}

void Film::commit(std::uint32_t tile, std::span<const float> block, std::uint32_t samples) {
    const Rect r = rect(tile);
    const std::size_t row = std::size_t{r.end.x - r.begin.x} * layout_.channels();
    const float* from = block.data();
    for (std::uint32_t y = r.begin.y; y < r.end.y; ++y) {
        double* to = sums.data() + (std::size_t{y} * width_ + r.begin.x) * layout_.channels();
        for (std::size_t i = 0; i < row; ++i) to[i] += static_cast<double>(*from++);
    }
    ++tiles[tile].blocks;
    tiles[tile].samples += samples;
}

double Film::squared_error(std::uint32_t tile, double floor_nit) const {
    const double n = tiles[tile].samples;
    if (n < 2.0) return std::numeric_limits<double>::infinity();
    const Rect r = rect(tile);
    double sum = 0.0;
    for (std::uint32_t y = r.begin.y; y < r.end.y; ++y) {
        for (std::uint32_t x = r.begin.x; x < r.end.x; ++x) {
            const double* p = pixel(x, y);
            const double mean = luminance(p) / n;
            const double variance = std::max(p[FilmLayout::squared] / n - mean * mean, 0.0) / (n - 1.0);
            // Black without noise is right, whatever the floor.
            if (variance > 0.0) sum += variance / (mean * mean + floor_nit * floor_nit);
        }
    }
    return sum;
}

double Film::tile_error(std::uint32_t tile, double floor_nit) const {
    return std::sqrt(squared_error(tile, floor_nit) / static_cast<double>(rect(tile).pixels()));
}

double Film::picture_error(double floor_nit) const {
    double sum = 0.0;
    for (std::uint32_t t = 0; t < tile_count(); ++t) sum += squared_error(t, floor_nit);
    return std::sqrt(sum / (static_cast<double>(width_) * height_));
}

double Film::median_luminance_nit() const {
    std::vector<double> lit;
    for (std::uint32_t y = 0; y < height_; ++y) {
        for (std::uint32_t x = 0; x < width_; ++x) {
            const std::uint32_t n = tile_of(x, y).samples;
            const double nit = n > 0 ? luminance(pixel(x, y)) / n : 0.0;
            if (nit > 0.0) lit.push_back(nit);
        }
    }
    if (lit.empty()) return 0.0;
    const auto middle = lit.begin() + static_cast<std::ptrdiff_t>(lit.size() / 2);
    std::nth_element(lit.begin(), middle, lit.end());
    return *middle;
}

}  // namespace candela::truth
