#pragma once

#include "candela/measure/picture.hpp"
#include "candela/scene/progress.hpp"

/// FLIP: the difference that a person sees when two pictures alternate in the same place. A map in [0,1].
///
/// Sources: Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom & Fairchild 2020, "FLIP: A Difference
/// Evaluator for Alternating Images" (LDR-FLIP); Andersson, Nilsson, Shirley & Akenine-Moller 2021,
/// "Visualizing Errors in Rendered High Dynamic Range Images" (HDR-FLIP).
namespace candela::measure {

/// How large a pixel is seen. 67.02 pixels a degree: 3840 pixels on 0.7 m, from 0.7 m away.
[[nodiscard]] double pixels_per_degree(double distance_m = 0.7, double monitor_width_m = 0.7,
                                       double monitor_width_pixels = 3840.0);

/// LDR-FLIP of display-linear Rec.709 in [0,1] (values outside are clamped). Throws std::invalid_argument
/// when the sizes differ or pixels_per_degree is not positive.
[[nodiscard]] ErrorMap flip(const Picture& x, const Picture& r, double pixels_per_degree);

/// The exposures, in stops, between which HDR-FLIP looks.
struct ExposureRange {
    double start = 0.0;
    double stop = 0.0;
    int count = 2;
};

/// From the reference's brightest and median luminance (Andersson et al. 2021, section 4). Two changes: a
/// median of 0 (a black background) is replaced by the median of what is not black, and at most 40 stops are
/// looked at, the brightest ones left out. A black reference gives {0, 0, 1}.
[[nodiscard]] ExposureRange hdr_flip_exposures(const Picture& reference);

/// HDR-FLIP of linear Rec.709 luminance (any scale; negative values count as 0): the largest LDR-FLIP of each
/// pixel over the range's exposures, tone mapped by Narkowicz's ACES curve.
[[nodiscard]] ErrorMap hdr_flip(const Picture& x, const Picture& r, double pixels_per_degree,
                                const ExposureRange& range, const ProgressFunction& progress = {});

/// Mean of a map over the pixels that count.
[[nodiscard]] double mean(const ErrorMap& map, const Mask& mask = {});

}  // namespace candela::measure
