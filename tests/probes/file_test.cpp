#include <gtest/gtest.h>

#include "candela/io/probe_file.hpp"

using namespace candela;

namespace {

std::vector<scene::IrradianceVolume> volumes() {
    scene::IrradianceVolume v;
    v.cells = {2, 1, 1};
    v.probes.resize(2);
    for (auto& probe : v.probes) {
        probe.valid = &probe == v.probes.data();
        for (std::size_t k = 0; k < 9; ++k)
            probe.irradiance_sh[k] = glm::vec3(0.5f * float(k) - 1.0f, 1e5f, 0.25f);
        probe.distances.assign(256, {2.0f, 4.0f});
        probe.distances[0] = {1.0f, 1.25f};
    }
    return {v};
}

}  // namespace

TEST(ProbeFile, IrradianceComesBackToHalfPrecisionAndThenToTheBit) {
    const auto before = volumes();
    auto after = before;
    after[0].probes.clear();
    ASSERT_TRUE(io::decode_irradiance(io::encode_irradiance(before, 7), 7, after));
    EXPECT_TRUE(after[0].probes[0].valid);
    EXPECT_FALSE(after[0].probes[1].valid);
    EXPECT_NEAR(after[0].probes[0].irradiance_sh[3].y, 1e5f, 100.0f);
    EXPECT_NEAR(after[0].probes[0].irradiance_sh[8].x, 3.0f, 0.003f);
    EXPECT_NEAR(after[0].probes[1].distances[0].y, 1.25f, 0.002f);
}

TEST(ProbeFile, AnythingButAWholeFileOfThisKeyIsRefusedAndChangesNothing) {
    auto read = volumes();
    const std::string bytes = io::encode_irradiance(read, 7);
    read[0].probes.clear();
    EXPECT_FALSE(io::decode_irradiance(bytes, 8, read));
    EXPECT_FALSE(io::decode_irradiance(bytes + "x", 7, read));
    for (std::size_t cut = 0; cut < bytes.size(); ++cut)
        EXPECT_FALSE(io::decode_irradiance(bytes.substr(0, cut), 7, read));
    EXPECT_TRUE(read[0].probes.empty());
    read[0].cells = {1, 2, 1};
    EXPECT_FALSE(io::decode_irradiance(bytes, 7, read));
}

TEST(ProbeFile, CapturesComeBack) {
    scene::ReflectionProbe p;
    p.capture.size = 4;
    p.capture.levels = {std::vector<glm::vec4>(16, {1.0f, 2.0f, 1e6f, 0.5f}),
                        std::vector<glm::vec4>(4, glm::vec4(0.25f))};
    p.capture.irradiance_sh[2] = glm::vec4(3.0f);
    const std::string bytes = io::encode_captures({p}, 9);
    std::vector<scene::ReflectionProbe> read(1);
    for (std::size_t cut = 0; cut < bytes.size(); cut += 3)
        EXPECT_FALSE(io::decode_captures(bytes.substr(0, cut), 9, read));
    EXPECT_TRUE(read[0].capture.empty());
    ASSERT_TRUE(io::decode_captures(bytes, 9, read));
    EXPECT_NEAR(read[0].capture.levels[0][5].z, 1e6f, 1e3f);
    EXPECT_NEAR(read[0].capture.levels[0][5].x, 1.0f, 0.01f);
    EXPECT_EQ(read[0].capture.levels[1][3].w, 0.25f);
    EXPECT_EQ(read[0].capture.irradiance_sh[2].y, 3.0f);
}
