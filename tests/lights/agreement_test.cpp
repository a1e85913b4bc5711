#include "tests/shading/agreement.hpp"

#include "candela_shaders/light_cases_comp.hpp"
#include "tests/lights/light_cases.glsl"

namespace candela::shading {
namespace {

TEST(Agreement, AreaLightsInGlslAreTheOnesInCpp) {
    const AgreementCase cases[] = {LIGHT_CASES(AGREEMENT_ENTRY)};
    Agreement(shaders::light_cases_comp).compare(cases);
}

}  // namespace
}  // namespace candela::shading
