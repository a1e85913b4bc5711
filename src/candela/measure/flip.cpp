#include "candela/measure/flip.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "candela/measure/flip_color.hpp"
#include "candela/measure/parallel_rows.hpp"

namespace candela::measure {
namespace {

using Plane = std::vector<float>;
using Kernel = std::vector<float>;  ///< 2 * radius + 1 weights

struct Size {
    int width = 0;
    int height = 0;
    [[nodiscard]] std::size_t count() const { return std::size_t(width) * std::size_t(height); }
};

int radius_of(const Kernel& kernel) {
    return static_cast<int>(kernel.size() / 2);
}

/// exp(-scale x^2) for x in pixels, sum 1.
Kernel gaussian(double scale, int radius) {
    Kernel kernel;
    double sum = 0.0;
    for (int i = -radius; i <= radius; ++i) sum += std::exp(-scale * i * i);
    for (int i = -radius; i <= radius; ++i)
        kernel.push_back(static_cast<float>(std::exp(-scale * i * i) / sum));
    return kernel;
}

/// One row through a kernel, borders replicated.
void filter_row(const float* in, float* out, int width, const Kernel& kernel, std::vector<float>& padded) {
    const int radius = radius_of(kernel);
    padded.resize(std::size_t(width) + kernel.size());
    std::fill_n(padded.begin(), radius, in[0]);
    std::copy_n(in, width, padded.begin() + radius);
    std::fill_n(padded.begin() + radius + width, radius, in[width - 1]);
    std::fill_n(out, width, 0.0f);
    for (std::size_t k = 0; k < kernel.size(); ++k) {
        const float weight = kernel[k];
        const float* shifted = padded.data() + k;
        for (int x = 0; x < width; ++x) out[x] += weight * shifted[x];
    }
}

/// Row y of the columns' filter, borders replicated, times `scale`, added to out.
void filter_column(const Plane& in, float* out, Size size, int y, const Kernel& kernel, float scale) {
    const int radius = radius_of(kernel);
    for (std::size_t k = 0; k < kernel.size(); ++k) {
        const int row = std::clamp(y + int(k) - radius, 0, size.height - 1);
        const float* line = in.data() + std::size_t(row) * std::size_t(size.width);
        const float weight = kernel[k] * scale;
        for (int x = 0; x < size.width; ++x) out[x] += weight * line[x];
    }
}

/// The contrast sensitivity filters (Andersson et al. 2020, section 4.1.1 and table 1): each a sum of
/// Gaussians sqrt(pi / b) exp(-pi^2 d^2 / b), d in degrees. Kernels are of sum 1, `weight` is the share of
/// each.
struct ContrastFilter {
    Kernel kernel;
    float weight = 1.0f;
};
struct ContrastFilters {
    ContrastFilter achromatic, red_green, blue_yellow_wide, blue_yellow_narrow;
};

ContrastFilters contrast_filters(double ppd) {
    constexpr double pi = 3.14159265358979324;
    constexpr double widest_b = 0.04;
    const int radius = static_cast<int>(std::ceil(3.0 * std::sqrt(widest_b / (2.0 * pi * pi)) * ppd));
    const auto scale = [&](double b) { return pi * pi / (b * ppd * ppd); };
    const auto volume = [&](double a, double b) {
        double line = 0.0;
        for (int i = -radius; i <= radius; ++i) line += std::exp(-scale(b) * i * i);
        return a * std::sqrt(pi / b) * line * line;
    };
    const double wide = volume(34.1, 0.04), narrow = volume(13.5, 0.025);
    ContrastFilters out;
    out.achromatic = {gaussian(scale(0.0047), radius), 1.0f};
    out.red_green = {gaussian(scale(0.0053), radius), 1.0f};
    out.blue_yellow_wide = {gaussian(scale(0.04), radius), float(wide / (wide + narrow))};
    out.blue_yellow_narrow = {gaussian(scale(0.025), radius), float(narrow / (wide + narrow))};
    return out;
}

/// The detectors of edges and points (section 4.2): derivatives of a Gaussian whose standard deviation is
/// half of 0.082 degrees, positive weights of sum 1 and negative ones of sum -1.
struct FeatureFilters {
    Kernel smooth, first, second;
};

void balance(Kernel& kernel) {
    double positive = 0.0, negative = 0.0;
    for (const float w : kernel) (w > 0.0f ? positive : negative) += double(w);
    for (float& w : kernel) w = static_cast<float>(double(w) / (w > 0.0f ? positive : -negative));
}

FeatureFilters feature_filters(double ppd) {
    const double sigma = 0.5 * 0.082 * ppd;
    const int radius = static_cast<int>(std::ceil(3.0 * sigma));
    FeatureFilters out;
    out.smooth = gaussian(0.5 / (sigma * sigma), radius);
    for (int i = -radius; i <= radius; ++i) {
        const double g = std::exp(-0.5 * i * i / (sigma * sigma));
        out.first.push_back(static_cast<float>(-i * g));
        out.second.push_back(static_cast<float>((i * i / (sigma * sigma) - 1.0) * g));
    }
    balance(out.first);
    balance(out.second);
    return out;
}

/// What one picture of the pair becomes: its colours as they are seen, and how much of an edge and of a point
/// each pixel is.
struct Perceived {
    std::vector<glm::vec3> hunt_lab;
    Plane edge, point;
};

struct Filters {
    ContrastFilters contrast;
    FeatureFilters feature;
    glm::mat3 xyz_from_rec709 = detail::white_relative_xyz_from_rec709();
    glm::mat3 rec709_from_xyz = glm::inverse(xyz_from_rec709);
};

/// The picture after every horizontal filter.
struct Rows {
    Plane achromatic, red_green, blue_yellow_wide, blue_yellow_narrow;  ///< Y, Cx and Cz
    Plane smooth, first, second;                                        ///< of Y scaled to [0,1]
};

Rows filter_rows(const Picture& picture, Size size, const Filters& filters) {
    Rows rows;
    for (Plane* plane : {&rows.achromatic, &rows.red_green, &rows.blue_yellow_wide, &rows.blue_yellow_narrow,
                         &rows.smooth, &rows.first, &rows.second}) {
        plane->resize(size.count());
    }
    for_row_bands(picture.height, [&](std::uint32_t first, std::uint32_t end) {
        const std::size_t width = picture.width;
        std::vector<float> y(width), cx(width), cz(width), grey(width), padded;
        for (std::size_t row = first; row < end; ++row) {
            const std::size_t start = row * width;
            for (std::size_t x = 0; x < width; ++x) {
                const glm::vec3 rgb = glm::clamp(picture.pixels[start + x], 0.0f, 1.0f);
                const glm::vec3 xyz = filters.xyz_from_rec709 * rgb;
                const glm::vec3 opponent = detail::ycxcz_from_xyz(xyz);
                y[x] = opponent.x;
                cx[x] = opponent.y;
                cz[x] = opponent.z;
                grey[x] = xyz.y;
            }
            const auto pass = [&](const std::vector<float>& in, Plane& out, const Kernel& kernel) {
                filter_row(in.data(), out.data() + start, size.width, kernel, padded);
            };
            pass(y, rows.achromatic, filters.contrast.achromatic.kernel);
            pass(cx, rows.red_green, filters.contrast.red_green.kernel);
            pass(cz, rows.blue_yellow_wide, filters.contrast.blue_yellow_wide.kernel);
            pass(cz, rows.blue_yellow_narrow, filters.contrast.blue_yellow_narrow.kernel);
            pass(grey, rows.smooth, filters.feature.smooth);
            pass(grey, rows.first, filters.feature.first);
            pass(grey, rows.second, filters.feature.second);
        }
    });
    return rows;
}

Perceived perceive(const Picture& picture, Size size, const Filters& filters) {
    const Rows rows = filter_rows(picture, size, filters);
    Perceived out;
    out.hunt_lab.resize(size.count());
    out.edge.resize(size.count());
    out.point.resize(size.count());
    for_row_bands(picture.height, [&](std::uint32_t first, std::uint32_t end) {
        const std::size_t width = picture.width;
        enum { y, cx, cz, edge_x, edge_y, point_x, point_y, lines };
        std::vector<std::vector<float>> line(lines, std::vector<float>(width));
        for (std::size_t row = first; row < end; ++row) {
            for (auto& l : line) std::fill(l.begin(), l.end(), 0.0f);
            const auto pass = [&](const Plane& in, int to, const Kernel& kernel, float scale = 1.0f) {
                filter_column(in, line[std::size_t(to)].data(), size, int(row), kernel, scale);
            };
            const ContrastFilters& c = filters.contrast;
            pass(rows.achromatic, y, c.achromatic.kernel);
            pass(rows.red_green, cx, c.red_green.kernel);
            pass(rows.blue_yellow_wide, cz, c.blue_yellow_wide.kernel, c.blue_yellow_wide.weight);
            pass(rows.blue_yellow_narrow, cz, c.blue_yellow_narrow.kernel, c.blue_yellow_narrow.weight);
            pass(rows.first, edge_x, filters.feature.smooth);
            pass(rows.smooth, edge_y, filters.feature.first);
            pass(rows.second, point_x, filters.feature.smooth);
            pass(rows.smooth, point_y, filters.feature.second);
            for (std::size_t x = 0; x < width; ++x) {
                const glm::vec3 xyz = detail::xyz_from_ycxcz({line[y][x], line[cx][x], line[cz][x]});
                // Filtered colours can leave the display's gamut (section 4.1.1 clamps them).
                const glm::vec3 seen = glm::clamp(filters.rec709_from_xyz * xyz, 0.0f, 1.0f);
                const std::size_t i = row * width + x;
                out.hunt_lab[i] = detail::hunt_lab_from_xyz(filters.xyz_from_rec709 * seen);
                out.edge[i] = std::hypot(line[edge_x][x], line[edge_y][x]);
                out.point[i] = std::hypot(line[point_x][x], line[point_y][x]);
            }
        }
    });
    return out;
}

/// Colour error from a HyAB distance: compressed (section 4.1.3, exponent 0.7), then the lower 40 % of the
/// range spread over 95 % of [0,1].
float color_error(float distance, float most) {
    constexpr float exponent = 0.7f, knee_in = 0.4f, knee_out = 0.95f;
    if (distance <= 0.0f) return 0.0f;
    const float d = std::pow(distance, exponent);
    const float knee = knee_in * most;
    if (d < knee) return knee_out / knee * d;
    return std::min(knee_out + (d - knee) / (most - knee) * (1.0f - knee_out), 1.0f);
}

/// Section 4.3: features that appear or vanish raise the colour error towards 1.
void combine(const Perceived& x, const Perceived& r, std::uint32_t width, float most, std::uint32_t first,
             std::uint32_t end, std::vector<float>& out) {
    for (std::size_t i = std::size_t{first} * width; i < std::size_t{end} * width; ++i) {
        const float color = color_error(detail::hyab(x.hunt_lab[i], r.hunt_lab[i]), most);
        const float change = std::max(std::abs(x.edge[i] - r.edge[i]), std::abs(x.point[i] - r.point[i]));
        const float feature = std::sqrt(std::min(change * 0.70710678f, 1.0f));
        const float error = color > 0.0f ? std::pow(color, 1.0f - feature) : 0.0f;
        out[i] = std::max(out[i], error);
    }
}

/// The largest compressed distance of two display colours: green against blue (section 4.1.3).
float largest_distance(const Filters& filters) {
    const glm::vec3 green = detail::hunt_lab_from_xyz(filters.xyz_from_rec709 * glm::vec3(0, 1, 0));
    const glm::vec3 blue = detail::hunt_lab_from_xyz(filters.xyz_from_rec709 * glm::vec3(0, 0, 1));
    return std::pow(detail::hyab(green, blue), 0.7f);
}

void check(const Picture& x, const Picture& r, double ppd) {
    const std::size_t count = std::size_t{r.width} * r.height;
    if (x.width != r.width || x.height != r.height || count == 0 || x.pixels.size() != count ||
        r.pixels.size() != count) {
        throw std::invalid_argument("flip: the pictures are not of one size");
    }
    if (!(ppd > 0.0) || ppd > 1000.0) throw std::invalid_argument("flip: pixels per degree");
}

Filters make_filters(double ppd) {
    Filters filters;
    filters.contrast = contrast_filters(ppd);
    filters.feature = feature_filters(ppd);
    return filters;
}

/// Raises `map` to the LDR-FLIP of the pair where that is larger.
void accumulate_flip(const Picture& x, const Picture& r, const Filters& filters, ErrorMap& map) {
    const Size size{int(r.width), int(r.height)};
    const Perceived of_x = perceive(x, size, filters), of_r = perceive(r, size, filters);
    const float most = largest_distance(filters);
    for_row_bands(r.height, [&](std::uint32_t first, std::uint32_t end) {
        combine(of_x, of_r, r.width, most, first, end, map.values);
    });
}

/// Narkowicz's fit of the ACES curve without its exposure gain (Andersson et al. 2021, section 4).
constexpr double curve_a = 0.6 * 0.6 * 2.51, curve_b = 0.6 * 0.03, curve_c = 0.6 * 0.6 * 2.43,
                 curve_d = 0.6 * 0.59, curve_e = 0.14;

float tone_mapped(float v) {
    // The curve is flat long before; the bound keeps its squares finite.
    const float x = std::clamp(v, 0.0f, 1e6f);
    return std::min(x * (float(curve_a) * x + float(curve_b)) /
                        (x * (float(curve_c) * x + float(curve_d)) + float(curve_e)),
                    1.0f);
}

Picture exposed(const Picture& picture, double stops) {
    Picture out = picture;
    const float scale = static_cast<float>(std::exp2(stops));
    for_row_bands(picture.height, [&](std::uint32_t first, std::uint32_t end) {
        for (std::size_t i = std::size_t{first} * picture.width; i < std::size_t{end} * picture.width; ++i)
            for (int c = 0; c < 3; ++c) out.pixels[i][c] = tone_mapped(picture.pixels[i][c] * scale);
    });
    return out;
}

}  // namespace

double pixels_per_degree(double distance_m, double monitor_width_m, double monitor_width_pixels) {
    return distance_m * monitor_width_pixels / monitor_width_m * (3.14159265358979324 / 180.0);
}

ErrorMap flip(const Picture& x, const Picture& r, double ppd) {
    check(x, r, ppd);
    ErrorMap map{r.width, r.height, std::vector<float>(r.pixels.size(), 0.0f)};
    accumulate_flip(x, r, make_filters(ppd), map);
    return map;
}

ExposureRange hdr_flip_exposures(const Picture& reference) {
    constexpr double bright = 0.85;  // where the curve is nearly white: section 4
    constexpr double most_stops = 40.0;
    std::vector<float> luminance;
    for (const glm::vec3& p : reference.pixels) luminance.push_back(std::max(shading::luminance(p), 0.0f));
    const auto median = [](std::vector<float>& v) {
        const auto middle = v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2);
        std::nth_element(v.begin(), middle, v.end());
        return *middle;
    };
    if (luminance.empty()) return {0.0, 0.0, 1};
    const float brightest = *std::max_element(luminance.begin(), luminance.end());
    if (!(brightest > 0.0f) || !std::isfinite(brightest)) return {0.0, 0.0, 1};
    float middle = median(luminance);
    if (!(middle > 0.0f)) {
        std::erase_if(luminance, [](float v) { return !(v > 0.0f); });
        middle = median(luminance);
    }
    // The positive root of curve(x) = bright.
    const double q = curve_a - bright * curve_c, p = curve_b - bright * curve_d, c = -bright * curve_e;
    const double white = (-p + std::sqrt(p * p - 4.0 * q * c)) / (2.0 * q);
    ExposureRange range;
    range.stop = std::log2(white / double(middle));
    range.start = std::max(std::log2(white / double(brightest)), range.stop - most_stops);
    range.count = std::max(2, static_cast<int>(std::ceil(range.stop - range.start)));
    return range;
}

ErrorMap hdr_flip(const Picture& x, const Picture& r, double ppd, const ExposureRange& range,
                  const ProgressFunction& progress) {
    check(x, r, ppd);
    const Filters filters = make_filters(ppd);
    ErrorMap map{r.width, r.height, std::vector<float>(r.pixels.size(), 0.0f)};
    for (int i = 0; i < range.count; ++i) {
        const double stops = range.start + i * (range.stop - range.start) / std::max(range.count - 1, 1);
        accumulate_flip(exposed(x, stops), exposed(r, stops), filters, map);
        if (progress) progress((i + 1.0) / range.count);
    }
    return map;
}

double mean(const ErrorMap& map, const Mask& mask) {
    double sum = 0.0;
    std::size_t used = 0;
    for (std::size_t i = 0; i < map.values.size(); ++i) {
        if (!mask.empty() && mask[i] == 0) continue;
        sum += double(map.values[i]);
        ++used;
    }
    return used == 0 ? 0.0 : sum / static_cast<double>(used);
}

}  // namespace candela::measure
