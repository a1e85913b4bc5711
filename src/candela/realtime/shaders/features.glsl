// What this variant of a mesh pipeline has to do. C++: Feature in gpu_scene.hpp.
#ifndef CANDELA_FEATURES_GLSL
#define CANDELA_FEATURES_GLSL

layout(constant_id = 0) const uint kFeatures = 0u;
layout(constant_id = 1) const int kSpecularAa = 0;
layout(constant_id = 14) const bool kForward = false;

const uint kBaseColorTexture = 1u << 0;
const uint kMetallicRoughnessTexture = 1u << 1;
const uint kNormalTexture = 1u << 2;
const uint kOcclusionTexture = 1u << 3;
const uint kEmissiveTexture = 1u << 4;
const uint kSpecularTexture = 1u << 5;
const uint kSpecularColorTexture = 1u << 6;
const uint kClearcoatTexture = 1u << 7;
const uint kClearcoatRoughnessTexture = 1u << 8;
const uint kClearcoatNormalTexture = 1u << 9;
const uint kSheenColorTexture = 1u << 10;
const uint kSheenRoughnessTexture = 1u << 11;
const uint kAnisotropyTexture = 1u << 12;
const uint kAnyTexture = (1u << 13) - 1u;
const uint kAlphaMask = 1u << 13;
const uint kLayered = 1u << 14;
const uint kEmissive = 1u << 15;
const uint kUnlit = 1u << 16;
const uint kSpecularGlossiness = 1u << 17;
const uint kVertexColor = 1u << 18;
const uint kDoubleSided = 1u << 19;
const uint kUv1 = 1u << 20;
const uint kFullyRough = 1u << 21;

bool has(uint feature) { return (kFeatures & feature) != 0u; }

#endif
