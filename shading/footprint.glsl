// Roughness that stands for the normals that a pixel or a texel averages over.
#ifndef CANDELA_FOOTPRINT_GLSL
#define CANDELA_FOOTPRINT_GLSL

#include "language.glsl"

CANDELA_SHADING_BEGIN

// Variance of the pixel's reconstruction filter in pixels^2, and the most that alpha^2 may grow by: Tokuyoshi
// & Kaplanyan 2019, "Improved Geometric Specular Antialiasing", section 4.
CONSTANT float kPixelFilterVariance = 0.25f;
CONSTANT float kMaxFootprintAlpha2 = 0.18f;

// alpha widened by the change of the normal across the pixel; dndx, dndy: derivatives of the unit normal per
// pixel. Tokuyoshi & Kaplanyan 2019, their isotropic form for deferred shading: slope variance adds to
// alpha^2 / 2.
FN float alpha_filtered(float alpha, vec3 dndx, vec3 dndy) {
    float variance = kPixelFilterVariance * (dot(dndx, dndx) + dot(dndy, dndy));
    return sqrt(saturate(alpha * alpha + min(2.0f * variance, kMaxFootprintAlpha2)));
}

// What the spread of the normals behind a mip-mapped normal map's texel adds to alpha^2, from the length of their average in
// (0,1]: Frostbite section 5.3, listing 32 (von Mises-Fisher concentration from the length, Banerjee et al. 2005; variance
// 1 / (2 kappa)). 0 at a length of 1 or more; at 0 the normals are all over the sphere.
FN float variance_from_average_normal(float average_length) {
    float length2 = average_length * average_length;
    float one_minus = max((1.0f - average_length) * (1.0f + average_length), 0.0f);
    return average_length > 0.0f ? one_minus / (2.0f * average_length * (3.0f - length2)) : 1.0e6f;
}
FN float alpha_from_average_normal(float alpha, float average_length) {
    return sqrt(saturate(alpha * alpha + variance_from_average_normal(average_length)));
}

// The same as the convolution of both lobes asks for: normals of concentration kappa have the slope variance 1 / kappa in each
// direction, which is a spherical Gaussian of half-vectors of sharpness kappa; GGX of alpha has the sharpness 2 / alpha^2 at its
// peak, and the inverse sharpnesses of a convolution add (Wang et al. 2009, "All-Frequency Rendering of Dynamic,
// Spatially-Varying Reflectance"). 2 / kappa: four times listing 32's.
CONSTANT float kConvolvedOverListing32 = 4.0f;
FN float convolved_variance_from_average_normal(float average_length) {
    return kConvolvedOverListing32 * variance_from_average_normal(average_length);
}

CONSTANT int kNormalMapFilterConvolved = 0;
CONSTANT int kNormalMapFilterAverageLength = 1;

// How a normal map's scale, which multiplies the slopes, changes the variance of its normals about their mean, whose z is
// normal_z before scaling. A slope m turns the normal by dm / (1 + m^2) along its tilt and by dm / sqrt(1 + m^2) across it;
// the mean of both squares. scale^2 on a flat map (Han et al. 2007 and Toksvig 2005 scale no maps; from the geometry).
FN float scaled_normal_variance(float normal_z, float scale) {
    float scale2 = scale * scale;
    float ratio = 1.0f / max(mix(scale2, 1.0f, normal_z * normal_z), 1.0e-6f);
    return 0.5f * scale2 * (ratio * ratio + ratio);
}

// The average length is kept in 8 bits, finest near 1, where a smooth surface shows the least roughness. texel in [0,1].
FN float average_normal_length(float texel) {
    return 1.0f - (1.0f - texel) * (1.0f - texel);
}
FN float average_normal_texel(float average_length) {
    return 1.0f - sqrt(saturate(1.0f - average_length));
}

// Length of the average normal behind a filtered read of several texels of levels, from what the levels lost (stored_length) and
// from the length of the sum of their unit vectors, which is what this read lost: anisotropic reads average texels of a fine level.
// Not where the map is magnified: what is interpolated there is a surface of its own. texels_per_pixel: along the pixel's longer
// side. kNormalTexelError: what rounding to 8 bits may take from a length.
CONSTANT float kNormalTexelError = 0.007f;
FN float filtered_normal_length(float stored_length, float filtered_length, float texels_per_pixel) {
    float minified = saturate(log2(max(texels_per_pixel, 1.0e-6f)));
    return stored_length * mix(1.0f, min(filtered_length + kNormalTexelError, 1.0f), minified);
}

// Perceptual roughness under a normal map: average_length and normal_z of the map itself, before `scale`. filter_technique: one
// of kNormalMapFilter*.
FN float perceptual_roughness_under_map(float perceptual_roughness, float average_length, float normal_z, float scale,
                                        int filter_technique) {
    float alpha = perceptual_roughness * perceptual_roughness;
    float variance = filter_technique == kNormalMapFilterConvolved ? convolved_variance_from_average_normal(average_length)
                                                                   : variance_from_average_normal(average_length);
    variance *= scaled_normal_variance(normal_z, scale);
    return sqrt(sqrt(saturate(alpha * alpha + variance)));
}

FN float perceptual_roughness_from_average_normal(float perceptual_roughness, float average_length) {
    return sqrt(alpha_from_average_normal(perceptual_roughness * perceptual_roughness, average_length));
}

CANDELA_SHADING_END

#endif
