// Photometric webs: luminous intensity as a function of direction, from a table over two angles.
// Sources: ANSI/IESNA LM-63-02, section 3 (photometric zero and horizontal; counter-clockwise type C, clockwise
// types A and B); CIE 121-1996 (C, gamma); EXT_lights_ies, "Coordinate System Mapping"; Lagarde & de Rousiers 2014
// ("Frostbite"), section 4.5 and listing 5.
//
// The luminaire's frame is that of its glTF node: type C's vertical angle gamma = 0 (nadir, the aim) is -Z; the
// half-plane C0 holds +X, C90 holds +Y, so that seen from behind the luminaire (from +Z) C runs counter-clockwise.
//
// The table is regular: `width` columns at C = 2 pi x / width, of which the one after the last is the first again,
// and `height` rows at gamma = pi y / (height - 1), both poles included. Between its nodes the intensity is bilinear
// in the angles, as scene::intensity_cd interpolates the file's own grid. Frostbite's table is regular in cos(gamma)
// instead: its rows are coarsest at the poles, just where the beam is (20 degrees to the second of 32 rows), and do not
// meet the file's angles; regular in gamma, they do, and the web is that of the file exactly, lumens included
// (scene::fitting_grid).
#ifndef CANDELA_LIGHTS_PHOTOMETRIC_GLSL
#define CANDELA_LIGHTS_PHOTOMETRIC_GLSL

#include "../language.glsl"

CANDELA_SHADING_BEGIN

// (C in [0, 2 pi], gamma in [0, pi]) in rad of a direction away from the luminaire in its own frame; any length but
// zero. Both by atan of two arguments: near the aim, where beams are, acos(-z) keeps no digits.
FN vec2 photometric_angles(vec3 direction) {
    float across = sqrt(direction.x * direction.x + direction.y * direction.y);
    float c = across > 0.0f ? atan(direction.y, direction.x) : 0.0f;
    return vec2(c < 0.0f ? c + TWO_PI : c, atan(across, -direction.z));
}

// The direction of a pair of type C angles: the inverse of photometric_angles, unit length.
FN vec3 photometric_direction(float c_rad, float gamma_rad) {
    return vec3(sin(gamma_rad) * cos(c_rad), sin(gamma_rad) * sin(c_rad), -cos(gamma_rad));
}

// Type B (planes share a horizontal axis, here Y; vertical angle: of the plane, from nadir towards the photometric
// horizontal +X; horizontal angle: within the plane, clockwise, hence towards -Y).
FN vec3 photometric_direction_type_b(float horizontal_rad, float vertical_rad) {
    return vec3(cos(horizontal_rad) * sin(vertical_rad), -sin(horizontal_rad),
                -cos(horizontal_rad) * cos(vertical_rad));
}

// (horizontal in [-pi/2, pi/2], vertical in [-pi, pi]) in rad of a direction: the inverse of the above. Closer to the
// axis than rounding can tell, the plane is the first.
FN vec2 photometric_angles_type_b(vec3 direction) {
    float around = sqrt(direction.x * direction.x + direction.z * direction.z);
    float vertical = around > 1.0e-6f * abs(direction.y) ? atan(direction.x, -direction.z) : 0.0f;
    return vec2(atan(-direction.y, around), vertical);
}

// Type A (planes share the vertical axis of a luminaire that is aimed horizontally: horizontal angle: of the plane,
// clockwise seen from above; vertical angle: within the plane, from -90 straight down to 90 straight up). The aim
// (0, 0) is mapped to -Z as EXT_lights_ies has it, "above" to +X.
FN vec3 photometric_direction_type_a(float horizontal_rad, float vertical_rad) {
    return vec3(sin(vertical_rad), -cos(vertical_rad) * sin(horizontal_rad),
                -cos(vertical_rad) * cos(horizontal_rad));
}

// (horizontal in [-pi, pi], vertical in [-pi/2, pi/2]) in rad of a direction: the inverse of the above.
FN vec2 photometric_angles_type_a(vec3 direction) {
    float around = sqrt(direction.y * direction.y + direction.z * direction.z);
    float horizontal = around > 1.0e-6f * abs(direction.x) ? atan(-direction.y, -direction.z) : 0.0f;
    return vec2(horizontal, atan(direction.x, around));
}

// Where the four nodes around a direction are in the table (index = y * width + x) and what each counts for; the
// weights sum to 1. The intensity is the sum of weight times entry.
struct PhotometricTaps {
    ivec4 index;
    vec4 weight;
};

// width >= 1 (1: the same in all half-planes), height >= 2.
FN PhotometricTaps photometric_taps(vec3 direction, int width, int height) {
    vec2 angles = photometric_angles(direction);
    float x = angles.x / TWO_PI * float(width);
    float y = min(angles.y / PI, 1.0f) * float(height - 1);
    int column = min(int(x), width - 1);
    int row = min(int(y), height - 2);
    int next_column = column + 1 < width ? column + 1 : 0;
    float s = saturate(x - float(column));
    float t = saturate(y - float(row));
    PhotometricTaps taps;
    taps.index = ivec4(row * width + column, row * width + next_column, (row + 1) * width + column,
                       (row + 1) * width + next_column);
    taps.weight = vec4((1.0f - s) * (1.0f - t), s * (1.0f - t), (1.0f - s) * t, s * t);
    return taps;
}

// The same place for a sampler that repeats in u, clamps in v and filters linearly; its weights are good to 1/256 on
// most hardware.
FN vec2 photometric_uv(vec3 direction, int width, int height) {
    vec2 angles = photometric_angles(direction);
    return vec2(angles.x / TWO_PI + 0.5f / float(width),
                (angles.y / PI * float(height - 1) + 0.5f) / float(height));
}

CANDELA_SHADING_END

#endif
