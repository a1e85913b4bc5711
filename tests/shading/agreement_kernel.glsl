// Runs one case of a list over numbers in [0,1) on the device. A suite's kernel is four lines:
//   #version 460
//   #extension GL_GOOGLE_include_directive : require
//   #include "..._cases.glsl"            the functions and their list, also included from C++
//   #define AGREEMENT_CASES(X) ..._CASES(X)
//   #include "(../shading/)agreement_kernel.glsl"
layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) readonly buffer Numbers { float numbers[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Results { vec4 results[]; };
layout(push_constant) uniform Push {
    uint count;
    int selected;
};

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    float u[kAgreementNumbers];
    for (int k = 0; k < kAgreementNumbers; ++k) u[k] = numbers[i * uint(kAgreementNumbers) + uint(k)];
    vec4 result = vec4(0.0);
    int next = 0;
#define AGREEMENT_RUN(function, tolerance) \
    if (selected == next++) result = function(u);
    AGREEMENT_CASES(AGREEMENT_RUN)
    results[i] = result;
}
