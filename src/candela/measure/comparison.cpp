#include "candela/measure/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "candela/measure/parallel_rows.hpp"
#include "candela/realtime/exposure_meter.hpp"
#include "shading/tone_curves.glsl"
#include "shading/transfer.glsl"

namespace candela::measure {
namespace {

bool is_finite(const glm::vec3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

/// Each pixel through `f`.
template <class F>
Picture map_pixels(const Picture& in, const F& f) {
    Picture out{in.width, in.height, std::vector<glm::vec3>(in.pixels.size())};
    for_row_bands(in.height, [&](std::uint32_t first, std::uint32_t end) {
        for (std::size_t i = std::size_t{first} * in.width; i < std::size_t{end} * in.width; ++i)
            out.pixels[i] = f(in.pixels[i]);
    });
    return out;
}

Picture display_linear(const Picture& picture, const ComparisonOptions& options) {
    if (options.meaning == PixelMeaning::display)
        return map_pixels(picture, [](const glm::vec3& p) { return shading::linear_from_srgb(p); });
    return map_pixels(picture, [&](const glm::vec3& p) {
        return shading::saturate(shading::display_from_exposed(options.tone_curve, p * options.exposure));
    });
}

Picture encoded(const Picture& linear) {
    return map_pixels(linear, [](const glm::vec3& p) { return shading::srgb_from_linear(p); });
}

/// The pair with a value everywhere, and which pixels those are that had one.
struct Cleaned {
    Picture x, r;
    Mask mask;
    std::size_t nonfinite = 0;
};

Cleaned clean(const Picture& x, const Picture& r) {
    Cleaned out{x, r, {}, 0};
    for (std::size_t i = 0; i < std::min(x.pixels.size(), r.pixels.size()); ++i) {
        if (is_finite(x.pixels[i]) && is_finite(r.pixels[i])) continue;
        if (out.mask.empty()) out.mask.assign(r.pixels.size(), 1);
        out.mask[i] = 0;
        ++out.nonfinite;
        out.r.pixels[i] = is_finite(r.pixels[i]) ? r.pixels[i] : glm::vec3(0.0f);
        out.x.pixels[i] = out.r.pixels[i];
    }
    return out;
}

void leave_out(ErrorMap& map, const Mask& mask) {
    for (std::size_t i = 0; i < mask.size(); ++i)
        if (mask[i] == 0) map.values[i] = std::numeric_limits<float>::quiet_NaN();
}

}  // namespace

Comparison compare(const Picture& x, const Picture& r, const ComparisonOptions& options) {
    const Cleaned pair = clean(x, r);
    Comparison out;
    out.mask = pair.mask;
    Metrics& m = out.metrics;
    m.nonfinite = pair.nonfinite;
    m.errors = errors(pair.x, pair.r, pair.mask);
    const Picture linear_x = display_linear(pair.x, options), linear_r = display_linear(pair.r, options);
    const bool luminance = options.meaning == PixelMeaning::luminance;
    m.rel_mse = luminance ? rel_mse(pair.x, pair.r, options.exposure, pair.mask)
                          : rel_mse(linear_x, linear_r, 1.0f, pair.mask);
    {
        const Picture display_x = encoded(linear_x), display_r = encoded(linear_r);
        m.psnr_db = psnr_db(display_x, display_r, pair.mask);
        m.ssim = ssim(display_x, display_r, pair.mask);
    }
    out.flip = flip(linear_x, linear_r, options.pixels_per_degree);
    m.flip = mean(out.flip, pair.mask);
    for (std::size_t i = 0; i < out.flip.values.size(); ++i)
        if (pair.mask.empty() || pair.mask[i] != 0)
            m.flip_max = std::max(m.flip_max, double(out.flip.values[i]));
    if (luminance) {
        out.hdr_flip =
            hdr_flip(pair.x, pair.r, options.pixels_per_degree, hdr_flip_exposures(pair.r), options.progress);
        m.hdr_flip = mean(out.hdr_flip, pair.mask);
        leave_out(out.hdr_flip, pair.mask);
    }
    leave_out(out.flip, pair.mask);
    return out;
}

Picture display_picture(const Picture& picture, const ComparisonOptions& options) {
    if (options.meaning == PixelMeaning::display) return picture;
    return encoded(display_linear(picture, options));
}

std::optional<float> metered_ev100(const Picture& luminance_nit) {
    return realtime::metered_ev100(std::span<const glm::vec3>(luminance_nit.pixels));
}

const std::vector<std::string>& metric_names() {
    static const std::vector<std::string> names{"rmse", "relmse",        "mae",      "max",
                                                "psnr", "ssim",          "flip",     "hdr-flip",
                                                "bias", "relative-bias", "nonfinite"};
    return names;
}

std::optional<double> metric_value(const Metrics& m, const std::string& name) {
    if (name == "rmse") return m.errors.rmse;
    if (name == "relmse") return m.rel_mse;
    if (name == "mae") return m.errors.mae;
    if (name == "max") return m.errors.max;
    if (name == "psnr") return m.psnr_db;
    if (name == "ssim") return m.ssim;
    if (name == "flip") return m.flip;
    if (name == "hdr-flip") return m.hdr_flip;
    if (name == "nonfinite") return static_cast<double>(m.nonfinite);
    if (name != "bias" && name != "relative-bias") return std::nullopt;
    double largest = 0.0;
    for (int c = 0; c < 3; ++c) {
        const double bias = std::abs(m.errors.bias[c]);
        if (bias == 0.0) continue;
        largest = std::max(largest, name == "bias" ? bias : bias / std::abs(m.errors.mean_reference[c]));
    }
    return largest;
}

bool more_is_better(const std::string& metric) {
    return metric == "psnr" || metric == "ssim";
}

}  // namespace candela::measure
