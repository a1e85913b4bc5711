// Where the energy goes that a single-scattering microfacet model drops, and what a specular layer leaves for
// the diffuse one below it.
#ifndef CANDELA_ENERGY_GLSL
#define CANDELA_ENERGY_GLSL

#include "language.glsl"

CANDELA_SHADING_BEGIN

// Factor on a specular lobe that returns what was lost between the facets. single_albedo: directional albedo
// E(NoV) of the lobe for f0 = f90 = 1. Turquin 2019 ("Practical multiple scattering compensation for
// microfacet models"), equation 16; not reciprocal. The guard prevents a division by an unwritten table.
FN vec3 multiple_scattering_scale(vec3 f0, float single_albedo) {
    return vec3(1.0f) + f0 * (1.0f / clamp(single_albedo, 0.05f, 1.0f) - 1.0f);
}

// What reaches the diffuse layer from a viewer: all that the specular layer (with its multiple scattering)
// did not reflect. The largest channel for all three, as KHR_materials_specular does, so that a tinted f0
// does not tint the diffuse layer with its complement. Depends on the view alone: exact in a white furnace,
// not reciprocal.
FN float diffuse_transmittance(vec3 specular_albedo) {
    return 1.0f - saturate(max_component(specular_albedo));
}

CANDELA_SHADING_END

#endif
