// Where lookups of shadows go to on a light.
#ifndef CANDELA_SHADOW_POINTS_GLSL
#define CANDELA_SHADOW_POINTS_GLSL

// C++: ShadowShape.
const int kShapePoint = 0;
const int kShapeFacingDisc = 1;
const int kShapeDisc = 2;
const int kShapeRectangle = 3;
const int kShapeTube = 4;

// Fractions of multiples of these are spread evenly: the golden ratio's, and the plastic ratio's, which keeps step with no
// multiple of the first (Roberts 2018, "The Unreasonable Effectiveness of Quasirandom Sequences").
const float kSpreadAround = 0.6180339887;
const float kSpreadAlong = 0.7548776662;

// Points of the light in units of its extent, one after the other: of a Fibonacci spiral on round shapes, of a Fibonacci
// lattice on others, each turned by the pixel's own numbers. The four pixels of a square share one set and take every
// fourth. The spiral turns by a rotation: sines in every lookup would cost more than the lookup.
struct LightPoints {
    vec2 around;  // unit; others than round: x in [0,1)
    float along;  // in [0,1)
    float step;
};
const uint kAlone = 1u;
const uint kInSquare = 4u;
bool is_round(int shape) { return shape == kShapeFacingDisc || shape == kShapeDisc; }
// Unit vector of a turn in [0,1), spread a little unevenly: parabolas for sine and cosine, which a software device calls one
// lane after the other.
vec2 turned(float turn) {
    vec2 x = fract(vec2(turn + 0.25, turn)) * 2.0 - 1.0;
    vec2 v = x * (1.0 - abs(x));
    return v * inversesqrt(dot(v, v));
}
LightPoints light_points(int shape, uint first, uint stride, uint count, vec2 turn) {
    float around = fract(float(first) * kSpreadAround + turn.x);
    LightPoints p;
    p.around = is_round(shape) ? turned(around) : vec2(around, 0.0);
    p.step = 1.0 / float(count);
    p.along = fract(float(first) / float(stride) + turn.y) * p.step;
    return p;
}
vec2 next_point(int shape, uint stride, inout LightPoints p) {
    vec2 point = is_round(shape) ? sqrt(p.along) * p.around : vec2(p.around.x, p.along) * 2.0 - 1.0;
    // Cosine and sine of one turn and of four by the golden ratio.
    vec2 golden = stride == kAlone ? vec2(-0.7373688781, -0.6754902943) : vec2(-0.9847134853, 0.1741819504);
    p.around = is_round(shape) ? vec2(p.around.x * golden.x - p.around.y * golden.y,
                                      p.around.x * golden.y + p.around.y * golden.x)
                               : vec2(fract(p.around.x + float(stride) * kSpreadAround), 0.0);
    p.along += p.step;
    return point;
}

#endif
