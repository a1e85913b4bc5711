// How local probes and the distant light become one reflection.
#ifndef CANDELA_PROBES_COMPOSITION_GLSL
#define CANDELA_PROBES_COMPOSITION_GLSL

#include "../language.glsl"

CANDELA_SHADING_BEGIN

// What has been gathered: light, and how much of the lobe it answers for.
struct ProbeSum {
    vec3 luminance_nit;
    float alpha;
};

FN ProbeSum empty_probe_sum() {
    ProbeSum sum;
    sum.luminance_nit = vec3(0.0f);
    sum.alpha = 0.0f;
    return sum;
}

// Adds the next larger probe: only what it sees beyond all before it counts, for probes that overlap are taken to see the
// same part of the lobe. Lagarde & de Rousiers 2014, section 4.9.5, the corrected algorithm of version 2.0. luminance_nit: of
// what the probe sees, not yet weighted by visibility.
FN void add_probe(INOUT(ProbeSum) sum, vec3 luminance_nit, float visibility) {
    float share = saturate(visibility - sum.alpha);
    sum.luminance_nit += luminance_nit * share;
    sum.alpha = saturate(sum.alpha + share);
}

// The distant light has the rest (the same).
FN vec3 add_distant(ProbeSum sum, vec3 distant_nit) {
    return sum.luminance_nit + distant_nit * (1.0f - sum.alpha);
}

CANDELA_SHADING_END

#endif
