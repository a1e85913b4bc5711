#include "tests/shading/agreement.hpp"

#include "candela_shaders/photometry_cases_comp.hpp"
#include "tests/photometry/photometry_cases.glsl"

namespace candela::shading {
namespace {

TEST(Agreement, PhotometryAndColourInGlslAreTheOnesInCpp) {
    const AgreementCase cases[] = {PHOTOMETRY_CASES(AGREEMENT_ENTRY)};
    Agreement(shaders::photometry_cases_comp).compare(cases);
}

}  // namespace
}  // namespace candela::shading
