// One source, two languages: every file of shading/ compiles as GLSL 4.6 (glslc, #include) and as C++20 (GLM).
//
// Rules that make this work: parameters that return a value are OUT(type) or INOUT(type); every function is FN;
// literals carry an `f`; swizzles are read, never assigned, and only .x .y .z .w single components are portable
// (build vectors with constructors); no global mutable state; arrays are passed by INOUT or indexed locally.
#ifndef CANDELA_LANGUAGE_GLSL
#define CANDELA_LANGUAGE_GLSL

#ifdef __cplusplus

#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/integer.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/packing.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <glm/vector_relational.hpp>

#define FN inline
#define OUT(type) type&
#define INOUT(type) type&
#define CONSTANT constexpr
#define CANDELA_SHADING_BEGIN namespace candela::shading {
#define CANDELA_SHADING_END }

namespace candela::shading {
using uint = std::uint32_t;
using glm::bvec2;
using glm::bvec3;
using glm::bvec4;
using glm::ivec2;
using glm::ivec3;
using glm::ivec4;
using glm::mat2;
using glm::mat3;
using glm::mat4;
using glm::uvec2;
using glm::uvec3;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;

using glm::abs;
using glm::acos;
using glm::all;
using glm::any;
using glm::asin;
using glm::ceil;
using glm::clamp;
using glm::cos;
using glm::cross;
using glm::distance;
using glm::dot;
using glm::equal;
using glm::exp;
using glm::exp2;
using glm::floatBitsToUint;
using glm::floor;
using glm::fract;
using glm::greaterThan;
using glm::greaterThanEqual;
using glm::inversesqrt;
using glm::isinf;
using glm::isnan;
using glm::length;
using glm::lessThan;
using glm::lessThanEqual;
using glm::log;
using glm::log2;
using glm::max;
using glm::min;
using glm::mix;
using glm::mod;
using glm::normalize;
using glm::packSnorm2x16;
using glm::packUnorm2x16;
using glm::packUnorm4x8;
using glm::pow;
using glm::reflect;
using glm::round;
using glm::sign;
using glm::sin;
using glm::smoothstep;
using glm::sqrt;
using glm::step;
using glm::tan;
using glm::transpose;
using glm::uintBitsToFloat;
using glm::unpackSnorm2x16;
using glm::unpackUnorm2x16;
using glm::unpackUnorm4x8;
FN float atan(float y, float x) { return std::atan2(y, x); }
FN float atan(float x) { return std::atan(x); }
FN uint bitfieldReverse(uint x) {
    // Pairs within nibbles within bytes, then the bytes: glm's own takes three times as long.
    x = ((x >> 1u) & 0x55555555u) | ((x & 0x55555555u) << 1u);
    x = ((x >> 2u) & 0x33333333u) | ((x & 0x33333333u) << 2u);
    x = ((x >> 4u) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4u);
    return __builtin_bswap32(x);
}
}  // namespace candela::shading

#else

#define FN
#define OUT(type) out type
#define INOUT(type) inout type
#define CONSTANT const
#define CANDELA_SHADING_BEGIN
#define CANDELA_SHADING_END

#endif

CANDELA_SHADING_BEGIN

CONSTANT float PI = 3.14159265358979324f;
CONSTANT float TWO_PI = 6.28318530717958648f;
CONSTANT float INV_PI = 0.31830988618379067f;

FN float saturate(float x) { return clamp(x, 0.0f, 1.0f); }
FN vec3 saturate(vec3 x) { return clamp(x, vec3(0.0f), vec3(1.0f)); }
FN float square(float x) { return x * x; }
FN float pow5(float x) {
    float x2 = x * x;
    return x2 * x2 * x;
}
FN float max_component(vec3 v) { return max(v.x, max(v.y, v.z)); }

// Luminance of linear Rec.709 (ITU-R BT.709-6, section 3.2; the Y row of its primaries with white D65).
#define LUMINANCE_OF_REC709 0.2126, 0.7152, 0.0722
FN float luminance(vec3 rec709) { return dot(rec709, vec3(LUMINANCE_OF_REC709)); }
#ifdef __cplusplus
inline double luminance(const glm::dvec3& rec709) { return glm::dot(rec709, glm::dvec3(LUMINANCE_OF_REC709)); }
#endif

CANDELA_SHADING_END

#endif
