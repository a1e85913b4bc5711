#pragma once

#include <optional>
#include <string>
#include <vector>

#include "candela/measure/flip.hpp"
#include "candela/measure/image_metrics.hpp"

/// A picture held against its reference: every metric at once, with one rule for pixels without a value.
namespace candela::measure {

/// What the numbers of a pair of pictures are.
enum class PixelMeaning : std::uint8_t {
    luminance,  ///< linear Rec.709 in cd/m^2 (EXR, HDR)
    display     ///< sRGB code values in [0,1] (PNG)
};

struct ComparisonOptions {
    PixelMeaning meaning = PixelMeaning::luminance;
    float exposure = 1.0f;  ///< cd/m^2 to exposed values, 1 = saturation (shading/exposure.glsl); > 0
    int tone_curve = 3;     ///< of shading/tone_curves.glsl: how luminance becomes a display picture
    double pixels_per_degree = measure::pixels_per_degree();
    ProgressFunction progress;  ///< of HDR-FLIP, nearly all of the work on luminance
};

/// rmse, mae, max and bias are in cd/m^2 for luminance, in code values of [0,1] for display pictures.
/// docs/compare.md defines each.
struct Metrics {
    Errors errors;
    double rel_mse = 0.0;
    double psnr_db = 0.0;  ///< infinite for equal pictures
    double ssim = 1.0;
    double flip = 0.0;
    double flip_max = 0.0;
    std::optional<double> hdr_flip;  ///< of luminance only
    std::size_t nonfinite = 0;       ///< pixels that are NaN or infinite in either picture
};

struct Comparison {
    Metrics metrics;
    Mask mask;          ///< empty when every pixel is finite in both
    ErrorMap flip;      ///< NaN where a pixel is left out
    ErrorMap hdr_flip;  ///< the same; empty for display pictures
};

/// Pixels that are NaN or infinite in either picture are left out of every mean; for the metrics that look
/// around a pixel (SSIM, FLIP) both pictures get the reference's value there, or black where it has none.
/// Throws std::invalid_argument when the sizes differ.
[[nodiscard]] Comparison compare(const Picture& x, const Picture& r, const ComparisonOptions& options);

/// What a display shows, as code values in [0,1].
[[nodiscard]] Picture display_picture(const Picture& picture, const ComparisonOptions& options);

/// The automatic exposure of a picture in cd/m^2 (realtime/exposure_meter.hpp). Nothing for one without
/// positive, finite luminance.
[[nodiscard]] std::optional<float> metered_ev100(const Picture& luminance_nit);

/// The names that metric_value() knows: rmse, relmse, mae, max, psnr, ssim, flip, hdr-flip, bias (largest
/// |mean difference| of a channel), relative-bias (the same over the reference's mean) and nonfinite.
[[nodiscard]] const std::vector<std::string>& metric_names();

/// Nothing for a name that does not exist or does not apply.
[[nodiscard]] std::optional<double> metric_value(const Metrics& metrics, const std::string& name);

/// True for psnr and ssim.
[[nodiscard]] bool more_is_better(const std::string& metric);

}  // namespace candela::measure
