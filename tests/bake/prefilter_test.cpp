#include <gtest/gtest.h>

#include <cstring>

#include "candela/bake/environment.hpp"
#include "environments.hpp"
#include "shading/specular_levels.glsl"

namespace candela {
namespace {

std::vector<glm::vec4> download(const gpu::Device& device, gpu::Commands& commands, gpu::Image& image,
                                std::uint32_t mip) {
    const std::size_t width = image.desc().width >> mip;
    const std::size_t height = image.desc().height >> mip;
    std::vector<glm::vec4> texels(width * height);
    gpu::Buffer buffer(device, texels.size() * sizeof(glm::vec4), VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                       gpu::MemoryKind::readback);
    commands.begin();
    commands.copy(image, buffer, mip);
    commands.submit_and_wait();
    std::memcpy(texels.data(), buffer.mapped(), texels.size() * sizeof(glm::vec4));
    return texels;
}

/// One of the two maps side by side on a mip.
std::vector<glm::vec4> level_texels(const std::vector<glm::vec4>& mip, std::size_t size, int level) {
    std::vector<glm::vec4> texels;
    for (std::size_t y = 0; y < size; ++y) {
        const auto row = mip.begin() + static_cast<std::ptrdiff_t>((2 * y + std::size_t(level % 2)) * size);
        texels.insert(texels.end(), row, row + static_cast<std::ptrdiff_t>(size));
    }
    return texels;
}

double relative_difference(const std::vector<glm::vec4>& a, const std::vector<glm::vec4>& b) {
    double difference = 0.0;
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            difference += std::pow(double(a[i][c]) - double(b[i][c]), 2);
            sum += std::pow(double(b[i][c]), 2);
        }
    }
    return std::sqrt(difference / sum);
}

TEST(SpecularLevels, ARoughnessOfALevelReadsThatLevelAlone) {
    for (int level = 0; level < shading::kSpecularLevels; ++level) {
        const float roughness = shading::specular_level_roughness(level);
        const float finer = shading::specular_finer_level(roughness);
        EXPECT_NEAR(finer + shading::specular_level_blend(roughness, finer), float(level), 1e-5f);
    }
}

TEST(SpecularLevels, TheBlendIsAsWideAsTheLobe) {
    // Between two levels the mean of their alphas is that of the lobe asked for.
    for (float roughness = 0.01f; roughness < 1.0f; roughness += 0.013f) {
        const float finer = shading::specular_finer_level(roughness);
        const float blend = shading::specular_level_blend(roughness, finer);
        const auto alpha = [](float level) {
            const float r = shading::specular_level_roughness(static_cast<int>(level));
            return r * r;
        };
        EXPECT_NEAR(glm::mix(alpha(finer), alpha(finer + 1.0f), blend), roughness * roughness, 1e-5f);
    }
}

TEST(Prefilter, DeviceAndProcessorAgree) {
    const gpu::Device device({});
    gpu::Commands commands(device);
    const scene::Environment e = tests::sky(256);
    bake::EnvironmentMaps a = prefilter_environment(device, commands, e, bake::Prefilter::device);
    bake::EnvironmentMaps b = prefilter_environment(device, commands, e, bake::Prefilter::processor);
    // The mirror's level differs: texels of the map as they are on one side, read bilinearly on the other.
    for (int level = 1; level < shading::kSpecularLevels; ++level) {
        const auto mip = static_cast<std::uint32_t>(level / 2);
        const auto size = static_cast<std::size_t>(shading::specular_level_size(level));
        const auto first = level_texels(download(device, commands, a.specular, mip), size, level);
        const auto second = level_texels(download(device, commands, b.specular, mip), size, level);
        EXPECT_LT(relative_difference(first, second), 0.03) << level;
    }
    const auto first = download(device, commands, a.irradiance, 0);
    const auto second = download(device, commands, b.irradiance, 0);
    for (std::size_t i = 0; i < first.size(); ++i) EXPECT_NEAR(first[i].y / second[i].y, 1.0f, 0.02f) << i;
}

}  // namespace
}  // namespace candela
