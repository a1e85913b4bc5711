#include "tests/shading/agreement.hpp"

#include "candela_shaders/sky_cases_comp.hpp"
#include "tests/sky/sky_cases.glsl"

namespace candela::shading {
namespace {

TEST(Agreement, SkyInGlslIsTheOneInCpp) {
    const AgreementCase cases[] = {SKY_CASES(AGREEMENT_ENTRY)};
    Agreement(shaders::sky_cases_comp).compare(cases);
}

}  // namespace
}  // namespace candela::shading
