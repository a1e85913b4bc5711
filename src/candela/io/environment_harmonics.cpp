#include "candela/io/environment_harmonics.hpp"

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "shading/spherical_harmonics.glsl"

namespace candela::io::detail {
namespace {

/// Coefficients of sh_polynomial in cd/m^2.
glm::vec3 polynomial(const scene::FilteredEnvironment& e, int index) {
    return e.irradiance_sh[static_cast<std::size_t>(index)] * (shading::sh_scale(index) * e.nit_per_unit);
}

std::string triple(const glm::vec3& v) {
    return digits(v.x) + "f, " + digits(v.y) + "f, " + digits(v.z) + "f";
}

constexpr const char* kWhat =
    "Irradiance over pi in cd/m^2 (linear Rec.709): what a white Lambert surface shows whose normal is n.\n";
constexpr const char* kSpace = "World: right-handed, +Y up, as glTF; n is unit.\n";

}  // namespace

std::string digits(float value) {
    char text[64];
    const auto [end, error] = std::to_chars(text, text + sizeof(text), value, std::chars_format::scientific);
    (void)error;  // 64 characters hold every float
    return {text, end};
}

std::string harmonics_json(const scene::FilteredEnvironment& e) {
    nlohmann::json coefficients = nlohmann::json::array(), polynomials = nlohmann::json::array();
    for (int i = 0; i < 9; ++i) {
        const glm::vec3 c = e.irradiance_sh[static_cast<std::size_t>(i)] * e.nit_per_unit;
        const glm::vec3 p = polynomial(e, i);
        coefficients.push_back({c.x, c.y, c.z});
        polynomials.push_back({p.x, p.y, p.z});
    }
    const nlohmann::json out{
        {"quantity", "irradiance over pi in cd/m^2, linear Rec.709"},
        {"order", "l (l + 1) + m"},
        {"basis", "real, orthonormal over the sphere, without the Condon-Shortley phase"},
        {"world", "right-handed, +Y up"},
        {"coefficients", coefficients},
        {"terms", {"1", "y", "z", "x", "x y", "y z", "3 z^2 - 1", "x z", "x^2 - y^2"}},
        {"coefficients_of_terms", polynomials}};
    return out.dump(2) + "\n";
}

std::string harmonics_c(const scene::FilteredEnvironment& e) {
    std::string out = std::string("/* ") + kWhat + "   " + kSpace +
                      "*/\n#ifndef ENVIRONMENT_SH_H\n#define ENVIRONMENT_SH_H\n\n";
    out += "static const float environment_sh[9][3] = {\n";
    for (int i = 0; i < 9; ++i) out += "    {" + triple(polynomial(e, i)) + "},\n";
    out +=
        "};\n\n"
        "static inline void environment_irradiance_over_pi(float x, float y, float z, float rgb[3]) {\n"
        "    const float terms[9] = {1.0f, y, z, x, x * y, y * z, 3.0f * z * z - 1.0f, x * z, x * x - y * "
        "y};\n"
        "    for (int c = 0; c < 3; ++c) {\n"
        "        rgb[c] = 0.0f;\n"
        "        for (int i = 0; i < 9; ++i) rgb[c] += environment_sh[i][c] * terms[i];\n"
        "        if (rgb[c] < 0.0f) rgb[c] = 0.0f;\n"
        "    }\n"
        "}\n\n#endif\n";
    return out;
}

std::string harmonics_glsl(const scene::FilteredEnvironment& e) {
    std::string out =
        std::string("// ") + kWhat + "// " + kSpace + "const vec3 environment_sh[9] = vec3[9](\n";
    for (int i = 0; i < 9; ++i) out += "    vec3(" + triple(polynomial(e, i)) + (i < 8 ? "),\n" : "));\n\n");
    out +=
        "vec3 environment_irradiance_over_pi(vec3 n) {\n"
        "    return max(environment_sh[0] + environment_sh[1] * n.y + environment_sh[2] * n.z + "
        "environment_sh[3] * n.x +\n"
        "                   environment_sh[4] * (n.x * n.y) + environment_sh[5] * (n.y * n.z) +\n"
        "                   environment_sh[6] * (3.0 * n.z * n.z - 1.0) + environment_sh[7] * (n.x * n.z) +\n"
        "                   environment_sh[8] * (n.x * n.x - n.y * n.y),\n"
        "               vec3(0.0));\n"
        "}\n";
    return out;
}

}  // namespace candela::io::detail
