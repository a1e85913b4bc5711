#include "candela/measure/image_metrics.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace candela::measure {
namespace {

void check(const Picture& x, const Picture& r, const Mask& mask) {
    const std::size_t count = std::size_t{r.width} * r.height;
    if (x.width != r.width || x.height != r.height || x.pixels.size() != count || r.pixels.size() != count ||
        (!mask.empty() && mask.size() != count)) {
        throw std::invalid_argument("image metrics: the pictures are not of one size");
    }
}

/// Calls body(x, r) for each pixel that counts and returns how many there were.
template <class Body>
std::size_t for_pixels(const Picture& x, const Picture& r, const Mask& mask, const Body& body) {
    check(x, r, mask);
    std::size_t count = 0;
    for (std::size_t i = 0; i < r.pixels.size(); ++i) {
        if (!mask.empty() && mask[i] == 0) continue;
        body(x.pixels[i], r.pixels[i]);
        ++count;
    }
    return count;
}

}  // namespace

Errors errors(const Picture& x, const Picture& r, const Mask& mask) {
    Errors out;
    double squares = 0.0, magnitudes = 0.0;
    const std::size_t count = for_pixels(x, r, mask, [&](const glm::vec3& a, const glm::vec3& b) {
        for (int c = 0; c < 3; ++c) {
            const double d = double(a[c]) - double(b[c]);
            squares += d * d;
            magnitudes += std::abs(d);
            out.max = std::max(out.max, std::abs(d));
            out.bias[c] += d;
            out.mean_reference[c] += double(b[c]);
        }
    });
    if (count == 0) return out;
    const double pixels = static_cast<double>(count);
    out.rmse = std::sqrt(squares / (3.0 * pixels));
    out.mae = magnitudes / (3.0 * pixels);
    for (int c = 0; c < 3; ++c) {
        out.bias[c] /= pixels;
        out.mean_reference[c] /= pixels;
    }
    return out;
}

double rel_mse(const Picture& x, const Picture& r, float scale, const Mask& mask) {
    constexpr double black_guard = 0.01;
    double sum = 0.0;
    const std::size_t count = for_pixels(x, r, mask, [&](const glm::vec3& a, const glm::vec3& b) {
        for (int c = 0; c < 3; ++c) {
            const double reference = double(b[c]) * double(scale);
            const double difference = double(a[c]) * double(scale) - reference;
            sum += difference * difference / (reference * reference + black_guard);
        }
    });
    return count == 0 ? 0.0 : sum / (3.0 * static_cast<double>(count));
}

double psnr_db(const Picture& x, const Picture& r, const Mask& mask) {
    return -20.0 * std::log10(errors(x, r, mask).rmse);
}

}  // namespace candela::measure
