#include <gtest/gtest.h>

#include <cstring>

#include "candela/bake/environment.hpp"
#include "environments.hpp"

namespace candela {
namespace {

std::vector<glm::vec4> download(const gpu::Device& device, gpu::Commands& commands, gpu::Image& image,
                                std::uint32_t level, std::uint32_t size) {
    std::vector<glm::vec4> texels(std::size_t{size} * size);
    gpu::Buffer buffer(device, texels.size() * sizeof(glm::vec4), VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                       gpu::MemoryKind::readback);
    commands.begin();
    commands.copy(image, buffer, level);
    commands.submit_and_wait();
    std::memcpy(texels.data(), buffer.mapped(), texels.size() * sizeof(glm::vec4));
    return texels;
}

TEST(Prefilter, DeviceAndProcessorAgree) {
    const gpu::Device device({});
    gpu::Commands commands(device);
    const scene::Environment e = tests::sky(256);
    bake::EnvironmentMaps a = prefilter_environment(device, commands, e, bake::Prefilter::device);
    bake::EnvironmentMaps b = prefilter_environment(device, commands, e, bake::Prefilter::processor);
    ASSERT_EQ(a.specular_levels, b.specular_levels);
    // The mirror's level differs: texels of the map as they are on one side, read bilinearly on the other.
    for (std::uint32_t level = 1; level < a.specular_levels; ++level) {
        const auto first = download(device, commands, a.specular, level, 512u >> level);
        const auto second = download(device, commands, b.specular, level, 512u >> level);
        double difference = 0.0;
        double sum = 0.0;
        for (std::size_t i = 0; i < first.size(); ++i) {
            for (int c = 0; c < 3; ++c) {
                difference += std::pow(double(first[i][c]) - double(second[i][c]), 2);
                sum += std::pow(double(second[i][c]), 2);
            }
        }
        EXPECT_LT(std::sqrt(difference / sum), 0.03) << level;
    }
    const auto first = download(device, commands, a.irradiance, 0, 32);
    const auto second = download(device, commands, b.irradiance, 0, 32);
    for (std::size_t i = 0; i < first.size(); ++i) EXPECT_NEAR(first[i].y / second[i].y, 1.0f, 0.02f) << i;
}

}  // namespace
}  // namespace candela
