// Light in all directions as nine numbers: real spherical harmonics of bands 0 to 2 in the order l (l + 1) + m, without the
// Condon-Shortley phase. Ramamoorthi & Hanrahan 2001, "An Efficient Representation for Irradiance Environment Maps".
#ifndef CANDELA_PROBES_HARMONICS_GLSL
#define CANDELA_PROBES_HARMONICS_GLSL

#include "../language.glsl"

CANDELA_SHADING_BEGIN

CONSTANT int kHarmonics = 9;

// The basis function of this index in the unit direction d.
FN float harmonic(int index, vec3 d) {
    if (index == 0) return 0.282094792f;
    if (index == 1) return 0.488602512f * d.y;
    if (index == 2) return 0.488602512f * d.z;
    if (index == 3) return 0.488602512f * d.x;
    if (index == 4) return 1.092548431f * d.x * d.y;
    if (index == 5) return 1.092548431f * d.y * d.z;
    if (index == 6) return 0.315391565f * (3.0f * d.z * d.z - 1.0f);
    if (index == 7) return 1.092548431f * d.x * d.z;
    return 0.546274215f * (d.x * d.x - d.y * d.y);
}

FN int harmonic_band(int index) { return index == 0 ? 0 : index < 4 ? 1 : 2; }

// What turns the coefficients of radiance into those of irradiance / pi (Ramamoorthi & Hanrahan 2001, equation 8, over pi).
FN float cosine_lobe(int band) { return band == 0 ? 1.0f : band == 1 ? 2.0f / 3.0f : 0.25f; }

// Weakens the higher bands so that a sum rings less: Sloan 2008, "Stupid Spherical Harmonics Tricks", the window that
// minimises the Laplacian squared. lambda 0: not at all.
FN float harmonic_window(int band, float lambda) {
    float l = float(band);
    return 1.0f / (1.0f + lambda * square(l * (l + 1.0f)));
}

CANDELA_SHADING_END

#endif
