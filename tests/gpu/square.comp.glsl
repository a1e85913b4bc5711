#version 460
layout(local_size_x = 64) in;
layout(constant_id = 0) const int kOffset = 0;
layout(set = 0, binding = 0) readonly buffer In { float values[]; };
layout(set = 0, binding = 1) writeonly buffer Out { float squares[]; };
layout(push_constant) uniform Push { uint count; };
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < count) squares[i] = values[i] * values[i] + float(kOffset);
}
