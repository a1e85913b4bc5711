#include "candela/realtime/still.hpp"

#include "shading/tone_curves.glsl"

namespace candela::realtime {

void add_unlit(Still& still) {
    PicturePass::Planes& planes = still.planes;
    for (std::size_t i = 0; i < planes.unlit.size(); ++i)
        planes.light_nit[i] += glm::vec4(glm::vec3(planes.unlit[i]) / still.exposure, 0.0f);
}

std::vector<glm::vec4> lit_nit(const Still& still) {
    std::vector<glm::vec4> lit = still.planes.light_nit;
    for (std::size_t i = 0; i < still.planes.unlit.size(); ++i) {
        const glm::vec3 rest = glm::vec3(lit[i]) - glm::vec3(still.planes.unlit[i]) / still.exposure;
        lit[i] = glm::vec4(glm::max(rest, glm::vec3(0.0f)), lit[i].a);
    }
    return lit;
}

std::vector<glm::vec3> display_linear(const Still& still, std::uint32_t tone_curve) {
    const int curve = static_cast<int>(tone_curve);
    const std::vector<glm::vec4> lit = lit_nit(still);
    std::vector<glm::vec3> out(lit.size());
    for (std::size_t i = 0; i < lit.size(); ++i) {
        const glm::vec4 exposed(glm::vec3(lit[i]) * still.exposure, lit[i].a);
        out[i] = still.planes.unlit.empty()
                     ? shading::saturate(shading::display_from_exposed(curve, glm::vec3(exposed)))
                     : shading::display_with_unlit(curve, exposed, glm::vec3(still.planes.unlit[i]));
    }
    return out;
}

}  // namespace candela::realtime
