#pragma once

#include <array>
#include <functional>
#include <vector>

#include "shading/stretched_reflection.glsl"

/// The fit behind shading/stretched_reflection.glsl: a few reads of a prefiltered environment that look most
/// like the lobe D V cos of height-correlated GGX with Schlick's Fresnel, over its albedo, for metals (f0 =
/// 1) and for dielectrics (f0 = 0.04).
///
/// Measure: what reads and lobe see of bumps of light, exp((c.l - 1) / s^2), of all widths s from 1/256 to 1
/// rad in octaves, on a grid about the mirror direction as fine as they are wide. Bumps of each octave weigh
/// the same, as the contents of pictures do whose power falls with the square of the frequency. The error is
/// the root of the sum of squared differences over that of the lobe's own values.
namespace candela::bake {

/// Reads of the lobe of a surface with normal n, seen from v.
using LobeReads = std::function<std::vector<shading::LobeRead>(
    const glm::vec3& n, const glm::vec3& v, float perceptual_roughness, float fresnel_share)>;

struct LobeErrors {
    double mean = 0.0;
    double largest = 0.0;
};

/// Over perceptual roughness 0.1 to 1, 16 angles from 2.8 to 87.2 degrees and both f0.
[[nodiscard]] LobeErrors lobe_errors(const LobeReads& reads);

/// Error for one view; NoV in (0,1].
[[nodiscard]] double lobe_error(const LobeReads& reads, float NoV, float perceptual_roughness, float f0);

/// The reads of shading/stretched_reflection.glsl, 1 to 3 of them, as they are.
[[nodiscard]] std::vector<shading::LobeRead> committed_lobe_reads(int reads, const glm::vec3& n,
                                                                  const glm::vec3& v, float NoV,
                                                                  float perceptual_roughness,
                                                                  float fresnel_share);
[[nodiscard]] LobeErrors committed_lobe_errors(int reads);

/// Coefficients of lobe_polynomial, in the order of its vectors, by what they are of: tilt and width of each
/// read in turn, then the logarithms of the weights of all but the last read over that of the last.
using LobeCoefficients = std::vector<std::array<double, 12>>;

struct LobeFit {
    LobeCoefficients coefficients;
    LobeErrors errors;
};

/// Levenberg and Marquardt's method; deterministic. reads: 1 to 3.
[[nodiscard]] LobeFit fit_lobe_reads(int reads);

}  // namespace candela::bake
