#include "tests/shading/agreement.hpp"

#include "candela/bake/ltc_table.hpp"
#include "candela_shaders/ltc_cases_comp.hpp"
#include "tests/ltc/ltc_cases.glsl"

namespace candela::shading {
namespace {

TEST(Agreement, TransformedCosinesAndRepresentativePointsInGlslAreTheOnesInCpp) {
    const AgreementCase cases[] = {LTC_CASES(AGREEMENT_ENTRY)};
    Agreement(shaders::ltc_cases_comp).compare(cases);
}

TEST(LtcTable, TheDeviceGetsTheTexelsOfTheLibrary) {
    gpu::DeviceOptions options;
    options.select = "cpu";
    options.validation = true;
    gpu::Device device(options);
    gpu::Commands commands(device);
    gpu::Image image = bake::create_ltc_table(device, commands);
    const std::vector<glm::vec4>& texels = bake::ltc_table().texels;
    gpu::Buffer readback(device, texels.size() * sizeof(glm::vec4), VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                         gpu::MemoryKind::readback);
    commands.begin();
    commands.copy(image, readback);
    commands.submit_and_wait();
    const auto there = readback.mapped_as<glm::vec4>();
    for (std::size_t i = 0; i < texels.size(); ++i) ASSERT_EQ(texels[i], there[i]) << "texel " << i;
    EXPECT_TRUE(device.validation_messages().empty()) << device.validation_messages().front();
}

}  // namespace
}  // namespace candela::shading
