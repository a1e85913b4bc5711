// What a glossy surface sees of a prefiltered environment: reads of it, each with its own direction, width and weight, that
// together have the shape of the lobe D V cos. Seen at an angle that lobe is longer than wide (Frostbite section 4.9.2,
// figures 54 and 55), ends at the horizon and leans away from the mirror direction, while what a prefiltered map holds is round.
//
// Own work. Directions are made of half-vectors, whose slopes scale with alpha, in the plane of incidence; tilts, widths and
// weights are polynomials fitted to the lobe by `candela bake lobes` (bake/lobe_fit.hpp says by which measure), which prints
// them as they stand below.
#ifndef CANDELA_STRETCHED_REFLECTION_GLSL
#define CANDELA_STRETCHED_REFLECTION_GLSL

#include "microfacet.glsl"

CANDELA_SHADING_BEGIN

// One read of an environment that is prefiltered as Frostbite equation 53 says (n = v = r, weighted by n.l). The weights of
// all reads of a lobe add up to 1.
struct LobeRead {
    vec3 direction;  // unit
    float perceptual_roughness;
    float weight;
};

// What the polynomials are in: NoV (c), perceptual roughness (r), and the cosine of the view stretched by 1 / alpha (z), in
// which masking has its scale.
struct LobeBasis {
    vec4 low;   // 1, z, c, r
    vec4 high;  // z z, c z, r z, r c
    vec4 fresnel;  // s, s z, s c, s r
};

FN LobeBasis lobe_basis(float NoV, float perceptual_roughness, float alpha, float fresnel_share) {
    float z = NoV / smith_ggx_root(NoV, alpha);
    return LobeBasis(vec4(1.0f, z, NoV, perceptual_roughness),
                     vec4(z * z, NoV * z, perceptual_roughness * z, perceptual_roughness * NoV),
                     fresnel_share * vec4(1.0f, z, NoV, perceptual_roughness));
}

FN float lobe_polynomial(LobeBasis basis, vec4 low, vec4 high, vec4 fresnel) {
    return dot(basis.low, low) + dot(basis.high, high) + dot(basis.fresnel, fresnel);
}

// The read whose half-vector has the slope alpha tilt sin(theta_v) against the normal, away from the viewer where tilt is
// positive; at normal incidence every tilt is the mirror direction. width: of its roughness over the surface's.
FN LobeRead lobe_read(vec3 n, vec3 v, float NoV, float perceptual_roughness, float alpha, float tilt, float width,
                      float weight) {
    vec3 h = normalize(n + (alpha * tilt) * (NoV * n - v));
    vec3 l = 2.0f * dot(v, h) * h - v;
    // Only where f0 is below all that was fitted (0.04; from 0.02 on none is): the lobe ends at the horizon.
    float NoL = dot(n, l);
    if (NoL < 0.0f) l = normalize(l - NoL * n);
    return LobeRead(l, saturate(width * perceptual_roughness), weight);
}

// Share of a surface's reflected light that the rise of Fresnel's reflectance gives; ab: scale of f0 and bias (dfg.glsl).
FN float fresnel_share(float f0, float f90, vec2 ab) {
    return f90 * ab.y / max(f0 * ab.x + f90 * ab.y, 1.0e-6f);
}

// One read at the place and as wide as serves best. Error of the lobe's shape 0.062 on average over roughness, angle, metal and
// dielectric, where the mirror direction has 0.183 and listing 22 has 0.113 (lobe_errors()). fresnel_share: of the reflected
// light that is due to the rise of Fresnel's reflectance (fresnel_share()); it draws the lobe outwards.
FN LobeRead fitted_reflection(vec3 n, vec3 v, float NoV, float perceptual_roughness, float fresnel_share) {
    float alpha = alpha_from_perceptual_roughness(perceptual_roughness);
    LobeBasis basis = lobe_basis(NoV, perceptual_roughness, alpha, fresnel_share);
    float tilt = lobe_polynomial(basis, vec4(-1.5581f, 0.2652f, 1.9243f, 0.5135f),
                                        vec4(1.0848f, -1.4525f, -0.8559f, -0.4774f),
                                        vec4(0.5349f, -0.6605f, 1.0588f, 0.7416f));
    float width = lobe_polynomial(basis, vec4(0.9460f, 0.1585f, -0.1421f, 0.5265f),
                                         vec4(-0.3004f, 0.2776f, -0.8121f, 0.6377f),
                                         vec4(-0.3538f, 0.3852f, 0.2764f, -0.7521f));
    return lobe_read(n, v, NoV, perceptual_roughness, alpha, tilt, width, 1.0f);
}

// Two narrower reads along the lobe. Error of the lobe's shape 0.032.
FN void stretched_reflection_2(vec3 n, vec3 v, float NoV, float perceptual_roughness, float fresnel_share,
                               OUT(LobeRead) a, OUT(LobeRead) b) {
    float alpha = alpha_from_perceptual_roughness(perceptual_roughness);
    LobeBasis basis = lobe_basis(NoV, perceptual_roughness, alpha, fresnel_share);
    float tilt_a = lobe_polynomial(basis, vec4(-3.5518f, 1.8799f, 1.4066f, 1.8557f),
                                          vec4(0.9185f, -2.0196f, -2.3508f, 1.0554f),
                                          vec4(2.5101f, -2.6133f, 3.1864f, -1.6814f));
    float width_a = lobe_polynomial(basis, vec4(0.7293f, 1.2948f, -2.4446f, 1.4305f),
                                           vec4(-1.2005f, 2.4043f, -1.5882f, 1.2681f),
                                           vec4(-1.1158f, 0.7101f, -0.2130f, 0.4747f));
    float tilt_b = lobe_polynomial(basis, vec4(-1.2714f, 1.3921f, -0.0571f, 0.8881f),
                                          vec4(0.3762f, -0.0980f, -2.3085f, 1.2322f),
                                          vec4(0.6690f, -1.0045f, 2.5526f, -0.3400f));
    float width_b = lobe_polynomial(basis, vec4(0.2915f, 0.4949f, -0.3348f, 0.6824f),
                                           vec4(-0.2702f, 0.8394f, -0.9744f, 0.2833f),
                                           vec4(0.2645f, -0.1081f, 0.4976f, -0.9941f));
    float weight_a = exp(lobe_polynomial(basis, vec4(-0.3355f, 3.1338f, -5.4443f, 0.8820f),
                                                vec4(-1.9057f, 2.1734f, -2.8986f, 5.5047f),
                                                vec4(0.5126f, -1.7731f, 4.5838f, -2.9139f)));
    float total = 1.0f + weight_a;
    a = lobe_read(n, v, NoV, perceptual_roughness, alpha, tilt_a, width_a, weight_a / total);
    b = lobe_read(n, v, NoV, perceptual_roughness, alpha, tilt_b, width_b, 1.0f / total);
}

// Three. Error of the lobe's shape 0.022.
FN void stretched_reflection_3(vec3 n, vec3 v, float NoV, float perceptual_roughness, float fresnel_share,
                               OUT(LobeRead) a, OUT(LobeRead) b, OUT(LobeRead) c) {
    float alpha = alpha_from_perceptual_roughness(perceptual_roughness);
    LobeBasis basis = lobe_basis(NoV, perceptual_roughness, alpha, fresnel_share);
    float tilt_a = lobe_polynomial(basis, vec4(-3.3882f, -2.2297f, 6.2298f, -0.4488f),
                                          vec4(3.4183f, -6.5578f, 2.5615f, -0.3356f),
                                          vec4(3.6813f, -3.0733f, 1.9443f, -2.0372f));
    float width_a = lobe_polynomial(basis, vec4(1.7084f, -0.2286f, 1.3094f, 0.0308f),
                                           vec4(-0.7837f, 0.1057f, -0.1297f, -0.5170f),
                                           vec4(-2.1145f, 1.6620f, -1.9707f, 2.1970f));
    float tilt_b = lobe_polynomial(basis, vec4(-1.4588f, -0.1972f, 2.6404f, 0.3257f),
                                          vec4(1.2289f, -2.4190f, -0.1798f, -0.8198f),
                                          vec4(0.9042f, -0.9279f, 1.2621f, -0.6168f));
    float width_b = lobe_polynomial(basis, vec4(-0.0021f, 1.0558f, 0.9031f, 1.3748f),
                                           vec4(-0.5269f, -0.4451f, -1.8969f, 0.5797f),
                                           vec4(-0.3947f, -0.2962f, 0.9095f, 0.1406f));
    float tilt_c = lobe_polynomial(basis, vec4(-1.0254f, 2.0536f, 0.4349f, 0.7429f),
                                          vec4(-0.1450f, 0.1153f, -2.9776f, 0.8510f),
                                          vec4(0.4685f, -0.8346f, 1.9168f, -0.3143f));
    float width_c = lobe_polynomial(basis, vec4(0.1272f, 0.6379f, -0.7595f, 0.6589f),
                                           vec4(-0.2412f, 1.1907f, -1.5543f, 1.0795f),
                                           vec4(0.3018f, -0.1658f, 0.7487f, -0.7167f));
    float weight_a = exp(lobe_polynomial(basis, vec4(1.2654f, -0.3024f, -5.3666f, -1.2681f),
                                                vec4(-1.2049f, 2.9577f, 3.9515f, 0.7913f),
                                                vec4(0.4766f, -0.9957f, 1.7968f, -4.5815f)));
    float weight_b = exp(lobe_polynomial(basis, vec4(-0.8897f, 2.5287f, 6.7988f, 1.9481f),
                                                vec4(-1.5270f, -5.1231f, -1.8988f, -3.5261f),
                                                vec4(1.1027f, -0.9274f, -0.4675f, -4.5739f)));
    float total = 1.0f + weight_a + weight_b;
    a = lobe_read(n, v, NoV, perceptual_roughness, alpha, tilt_a, width_a, weight_a / total);
    b = lobe_read(n, v, NoV, perceptual_roughness, alpha, tilt_b, width_b, weight_b / total);
    c = lobe_read(n, v, NoV, perceptual_roughness, alpha, tilt_c, width_c, 1.0f / total);
}

CANDELA_SHADING_END

#endif
