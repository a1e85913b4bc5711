// Light in all directions as nine numbers: real spherical harmonics of bands 0 to 2 in the order l (l + 1) + m, without the
// Condon-Shortley phase. Ramamoorthi & Hanrahan 2001, "An Efficient Representation for Irradiance Environment Maps".
#ifndef CANDELA_SPHERICAL_HARMONICS_GLSL
#define CANDELA_SPHERICAL_HARMONICS_GLSL

#include "language.glsl"

CANDELA_SHADING_BEGIN

CONSTANT int kShCoefficients = 9;

// What the polynomial below is multiplied by so that the basis is orthonormal over the sphere: Ramamoorthi & Hanrahan 2001,
// equation 3, from its roots instead of rounded to six digits.
FN float sh_scale(int index) {
    if (index == 0) return 0.28209479177387814f;                // sqrt(1 / (4 pi))
    if (index < 4) return 0.48860251190291992f;                 // sqrt(3 / (4 pi))
    if (index == 6) return 0.31539156525252005f;                // sqrt(5 / (16 pi))
    return index == 8 ? 0.54627421529603953f : 1.0925484305920790f;  // sqrt(15 / (16 pi)), sqrt(15 / (4 pi))
}

// d: unit. Ramamoorthi & Hanrahan 2001, equation 3: the part of the basis that depends on the direction.
FN float sh_polynomial(int index, vec3 d) {
    if (index == 0) return 1.0f;
    if (index == 1) return d.y;
    if (index == 2) return d.z;
    if (index == 3) return d.x;
    if (index == 4) return d.x * d.y;
    if (index == 5) return d.y * d.z;
    if (index == 6) return 3.0f * d.z * d.z - 1.0f;
    if (index == 7) return d.x * d.z;
    return d.x * d.x - d.y * d.y;
}

FN float sh_basis(int index, vec3 d) {
    return sh_scale(index) * sh_polynomial(index, d);
}

// What convolution with the clamped cosine, over pi, leaves of the coefficients of a band: Ramamoorthi & Hanrahan 2001, equation 8
// (pi, 2 pi / 3, pi / 4), over pi.
FN float sh_cosine_over_pi(int index) {
    return index == 0 ? 1.0f : index < 4 ? 2.0f / 3.0f : 0.25f;
}

// Factor of the coefficient of this index, of degree l, that lowers the mean square of the Laplacian, l (l + 1), the more the larger
// lambda is, so that a sum rings less: Sloan 2008, "Stupid Spherical Harmonics (SH) Tricks", windowing. lambda 0: not at all.
FN float sh_window(int index, float lambda) {
    float laplacian = index == 0 ? 0.0f : (index < 4 ? 2.0f : 6.0f);
    return 1.0f / (1.0f + lambda * laplacian * laplacian);
}

CANDELA_SHADING_END

#endif
