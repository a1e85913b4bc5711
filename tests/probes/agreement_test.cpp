#include "tests/shading/agreement.hpp"

#include "candela_shaders/probe_cases_comp.hpp"
#include "tests/probes/probe_cases.glsl"

namespace candela::shading {
namespace {

const AgreementCase kCases[] = {PROBE_CASES(AGREEMENT_ENTRY)};

}  // namespace

TEST(Agreement, TheDeviceComputesProbesAsTheProcessor) {
    Agreement(shaders::probe_cases_comp).compare(kCases);
}

}  // namespace candela::shading
