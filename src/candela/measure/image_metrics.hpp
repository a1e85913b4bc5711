#pragma once

#include "candela/measure/picture.hpp"

/// Numbers for the difference of a picture x from its reference r. Pictures of a pair have the same size
/// (std::invalid_argument otherwise); a mask leaves pixels out of every mean. With no pixel left a mean is 0.
namespace candela::measure {

/// Errors in the unit of the pictures, over pixels and channels.
struct Errors {
    double rmse = 0.0;                     ///< sqrt(mean((x - r)^2))
    double mae = 0.0;                      ///< mean(|x - r|)
    double max = 0.0;                      ///< largest |x - r|
    double bias[3] = {0, 0, 0};            ///< mean(x - r) of R, G and B
    double mean_reference[3] = {0, 0, 0};  ///< mean(r) of R, G and B
};
[[nodiscard]] Errors errors(const Picture& x, const Picture& r, const Mask& mask = {});

/// relMSE: the mean over pixels and channels of (x - r)^2 / (r^2 + 0.01), on values scaled by `scale`. The
/// 0.01 keeps black pixels from ruling the mean (Rousselle, Knaus & Zwicker 2011, "Adaptive Sampling and
/// Reconstruction using Greedy Error Minimization"); it only means something next
/// to values of order 1, so luminance is scaled by the exposure (1 = the sensor's saturation).
[[nodiscard]] double rel_mse(const Picture& x, const Picture& r, float scale = 1.0f, const Mask& mask = {});

/// Peak signal to noise ratio in dB, 20 log10(1 / RMSE), of display values in [0,1]. Infinite for equal
/// pictures.
[[nodiscard]] double psnr_db(const Picture& x, const Picture& r, const Mask& mask = {});

/// Structural similarity (Wang, Bovik, Sheikh & Simoncelli 2004, "Image Quality Assessment: From Error
/// Visibility to Structural Similarity", equation 13) of the luma of display values in [0,1]: 0.2126 R' +
/// 0.7152 G' + 0.0722 B'. Gaussian window of 11 x 11, sigma 1.5, K1 = 0.01, K2 = 0.03, L = 1. The mean is
/// over pixels whose window lies inside the picture, as the authors do; in pictures smaller than the window
/// it is over all pixels, with windows cut at the border. In [-1, 1], 1 for equal pictures.
[[nodiscard]] double ssim(const Picture& x, const Picture& r, const Mask& mask = {});

}  // namespace candela::measure
