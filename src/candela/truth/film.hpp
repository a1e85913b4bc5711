#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "candela/truth/path_integrator.hpp"

namespace candela::truth {

/// What a pixel sums up over its paths.
struct FilmLayout {
    bool aovs = false;

    static constexpr std::size_t luminance = 0;  ///< 3: cd/m^2
    static constexpr std::size_t squared = 3;    ///< 1: squared luminance of each path
    static constexpr std::size_t unlit = 4;      ///< 4: display-referred colour, number of paths that saw it
    static constexpr std::size_t lobes = 8;    ///< 5 x 3: direct and indirect diffuse and specular, emissive
    static constexpr std::size_t albedo = 23;  ///< 3
    static constexpr std::size_t normal = 26;  ///< 3
    static constexpr std::size_t distance = 29;     ///< 1
    static constexpr std::size_t environment = 30;  ///< 3: straight to the first surface
    [[nodiscard]] std::size_t channels() const noexcept { return aovs ? 33 : 8; }
    /// Adds one path to the sums of its pixel.
    void add(const PathResult& path, float* pixel) const;
};

/// Sums of a picture in progress, tile by tile: tiles may have different numbers of samples. Samples come in
/// blocks whose sums are added in the order of the blocks, so that the picture does not depend on who
/// computed them or when.
class Film {
  public:
    static constexpr std::uint32_t tile_size = 32;
    static constexpr std::uint32_t block_samples = 4;

    struct Tile {
        std::uint32_t blocks = 0;   ///< committed
        std::uint32_t samples = 0;  ///< of each pixel
        bool active = true;         ///< wants more
    };
    struct Rect {
        glm::uvec2 begin;
        glm::uvec2 end;
        [[nodiscard]] std::size_t pixels() const { return std::size_t{end.x - begin.x} * (end.y - begin.y); }
    };

    Film(std::uint32_t width, std::uint32_t height, const FilmLayout& layout);

    [[nodiscard]] std::uint32_t width() const noexcept { return width_; }
    [[nodiscard]] std::uint32_t height() const noexcept { return height_; }
    [[nodiscard]] const FilmLayout& layout() const noexcept { return layout_; }
    [[nodiscard]] std::uint32_t tile_count() const noexcept {
        return static_cast<std::uint32_t>(tiles.size());
    }
    [[nodiscard]] Rect rect(std::uint32_t tile) const;

    /// Adds the sums of one block (rect(tile).pixels() * channels numbers, row by row) of `samples` paths a
    /// pixel.
    void commit(std::uint32_t tile, std::span<const float> sums, std::uint32_t samples);

    [[nodiscard]] const double* pixel(std::uint32_t x, std::uint32_t y) const {
        return sums.data() + (std::size_t{y} * width_ + x) * layout_.channels();
    }
    [[nodiscard]] const Tile& tile_of(std::uint32_t x, std::uint32_t y) const;

    /// Estimated relative error of a tile's pixels: root of the mean of variance / (luminance^2 +
    /// floor_nit^2). Infinite below two samples.
    [[nodiscard]] double tile_error(std::uint32_t tile, double floor_nit) const;
    /// The same over the whole picture.
    [[nodiscard]] double picture_error(double floor_nit) const;
    /// Median of the pixels that are not black, 0 when all are: a lamp in view does not pull it.
    [[nodiscard]] double median_luminance_nit() const;

    std::vector<Tile> tiles;
    std::vector<double> sums;
    std::vector<glm::uvec2> ids;  ///< object and material of each pixel's first path

  private:
    [[nodiscard]] double squared_error(std::uint32_t tile, double floor_nit) const;

    std::uint32_t width_;
    std::uint32_t height_;
    std::uint32_t tiles_x_;
    FilmLayout layout_;
};

}  // namespace candela::truth
