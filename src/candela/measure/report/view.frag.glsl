// One pane of the report. The tone curves and the sRGB transfer are those of the renderer: their files come first.
uniform sampler2D picture_a;  // scaled luminance, or code values of display pictures
uniform sampler2D picture_b;
uniform sampler2D error_map;  // 0 to 254 for [0,1], 255 for no value
uniform sampler2D color_map;
uniform int kind;             // 0 picture A, 1 A left of the split and B right of it, 2 difference, 3 error map
uniform vec2 pane_corner;     // bottom left, in screen pixels
uniform vec2 pane_size;
uniform vec2 offset;          // of the picture's top left corner from the pane's
uniform float zoom;           // screen pixels a picture pixel
uniform float split;          // screen pixels from the pane's left edge
uniform float exposure;       // to be multiplied with what the textures hold
uniform int tone;
uniform bool code_values;     // the textures hold sRGB code values
out vec4 shown;

vec3 exposed(vec3 stored) {
    return (code_values ? linear_from_srgb(stored) : stored) * exposure;
}

bool has_value(vec3 v) {
    return all(lessThan(abs(v), vec3(3.0e38)));  // false for NaN and for infinities
}

vec3 color_at(ivec2 texel, bool right) {
    if (kind == 3) {
        int index = int(texelFetch(error_map, texel, 0).x * 255.0 + 0.5);
        return texelFetch(color_map, ivec2(index, 0), 0).xyz;
    }
    vec3 a = right ? texelFetch(picture_b, texel, 0).xyz : texelFetch(picture_a, texel, 0).xyz;
    if (!has_value(a)) return vec3(1.0, 0.0, 1.0);
    if (kind != 2) return srgb_from_linear(display_from_exposed(tone, exposed(a)));
    vec3 b = texelFetch(picture_b, texel, 0).xyz;
    if (!has_value(b)) return vec3(1.0, 0.0, 1.0);
    return srgb_from_linear(saturate(abs(exposed(a) - exposed(b))));
}

void main() {
    vec2 at = vec2(gl_FragCoord.x - pane_corner.x, pane_size.y - (gl_FragCoord.y - pane_corner.y));
    vec2 point = (at - offset) / zoom;
    ivec2 size = textureSize(picture_a, 0);
    if (any(lessThan(point, vec2(0.0))) || any(greaterThanEqual(point, vec2(size)))) {
        shown = vec4(vec3(0.106), 1.0);
        return;
    }
    bool right = kind == 1 && at.x >= split;
    // Smaller than life: the mean of the pixels that fall into one.
    int taps = clamp(int(ceil(1.0 / zoom)), 1, 8);
    vec3 sum = vec3(0.0);
    for (int y = 0; y < taps; ++y) {
        for (int x = 0; x < taps; ++x) {
            vec2 shift = zoom < 1.0 ? ((vec2(x, y) + 0.5) / float(taps) - 0.5) / zoom : vec2(0.0);
            sum += color_at(clamp(ivec2(floor(point + shift)), ivec2(0), size - 1), right);
        }
    }
    shown = vec4(sum / float(taps * taps), 1.0);
}
