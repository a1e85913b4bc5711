#include "tests/shading/agreement.hpp"

#include "candela_shaders/bsdf_cases_comp.hpp"
#include "tests/shading/bsdf_cases.glsl"

namespace candela::shading {
namespace {

TEST(Agreement, MaterialModelInGlslIsTheOneInCpp) {
    const AgreementCase cases[] = {BSDF_CASES(AGREEMENT_ENTRY)};
    Agreement(shaders::bsdf_cases_comp).compare(cases);
}

}  // namespace
}  // namespace candela::shading
