#include <gtest/gtest.h>

#include "candela/io/environment_read.hpp"
#include "candela/io/image_write.hpp"
#include "candela/scene/environment_negative.hpp"
#include "candela/scene/environment_sources.hpp"
#include "common/files.hpp"
#include "sky_of_directions.hpp"

namespace candela::test {
namespace {

/// A lamp overhead with the dark ring that a sharpening filter leaves about it.
scene::Environment ringing() {
    scene::Environment e;
    e.width = 128;
    e.height = 64;
    e.luminance_nit.assign(128 * 64, glm::vec3(0.1f));
    for (std::uint32_t y = 10; y < 16; ++y) {
        for (std::uint32_t x = 60; x < 66; ++x) {
            const bool lamp = y >= 12 && y < 14 && x >= 62 && x < 64;
            e.luminance_nit[y * 128 + x] =
                lamp ? glm::vec3(90.0f, 80.0f, 70.0f) : glm::vec3(-1.0f, -1.5f, 0.1f);
        }
    }
    return e;
}

void write(const std::string& file, const scene::Environment& e,
           const std::map<std::string, io::ExrAttribute>& attributes = {}) {
    std::array<std::vector<float>, 3> planes;
    for (std::size_t c = 0; c < 3; ++c) {
        for (const glm::vec3& t : e.luminance_nit) planes[c].push_back(t[int(c)]);
    }
    io::write_exr(file, e.width, e.height,
                  {{"R", io::PixelType::float32, std::span<const float>(planes[0])},
                   {"G", io::PixelType::float32, std::span<const float>(planes[1])},
                   {"B", io::PixelType::float32, std::span<const float>(planes[2])}},
                  attributes);
}

std::string warning_of(const std::string& file, io::NegativeTexels how, io::ReadEnvironment& out) {
    Diagnostics diagnostics;
    io::EnvironmentOptions options;
    options.negative = how;
    out = io::read_environment(file, diagnostics, options);
    EXPECT_EQ(diagnostics.warnings().size(), 1u);
    return diagnostics.warnings().empty() ? "" : diagnostics.warnings()[0].text;
}

TEST(NegativeTexels, ClampingSaysByHowMuchTheLightGrows) {
    const TemporaryFolder folder;
    const scene::Environment source = ringing();
    write(folder / "a.exr", source);
    io::ReadEnvironment e;
    const std::string text = warning_of(folder / "a.exr", io::NegativeTexels::clamp, e);
    const double percent =
        100.0 * (scene::upward_illuminance_lx(e) / scene::upward_illuminance_lx(source) - 1.0);
    EXPECT_GT(percent, 5.0);
    char expected[64];
    std::snprintf(expected, sizeof(expected), "the up-facing illuminance is %.3g %% higher", percent);
    EXPECT_NE(text.find(expected), std::string::npos) << text << " / " << expected;
    EXPECT_NE(text.find("--env-negative spread"), std::string::npos) << text;
    EXPECT_EQ(text.find("cd/m2"), std::string::npos) << "the file has no unit: " << text;
    write(folder / "b.exr", source, {{"whiteLuminance", 10.0f}});
    EXPECT_NE(warning_of(folder / "b.exr", io::NegativeTexels::clamp, e).find("the least -15 cd/m2"),
              std::string::npos);
    EXPECT_TRUE(e.absolute);
}

TEST(NegativeTexels, SpreadingKeepsTheLightAndWhatIsFarAway) {
    const TemporaryFolder folder;
    const scene::Environment source = ringing();
    write(folder / "a.exr", source);
    io::ReadEnvironment e;
    const std::string text = warning_of(folder / "a.exr", io::NegativeTexels::spread, e);
    const glm::dvec3 before = light_of(source), after = light_of(e);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(after[c] / before[c], 1.0, 1e-5) << c;
    EXPECT_NEAR(scene::upward_illuminance_lx(e) / scene::upward_illuminance_lx(source), 1.0, 1e-2) << text;
    for (const glm::vec3& t : e.luminance_nit) EXPECT_TRUE(t.x >= 0.0f && t.y >= 0.0f);
    EXPECT_EQ(e.luminance_nit[40 * 128 + 10], source.luminance_nit[40 * 128 + 10]);
    EXPECT_EQ(e.luminance_nit[12 * 128 + 62].z, 70.0f) << "a channel without negative values stays";
    EXPECT_EQ(text.find("--env-negative"), std::string::npos) << text;
}

TEST(NegativeTexels, AChannelWithoutLightBecomesBlack) {
    scene::Environment e;
    e.width = 5;
    e.height = 3;
    for (int i = 0; i < 15; ++i)
        e.luminance_nit.emplace_back(i == 7 ? 3.0f : -1.0f, 1.0f, i == 7 ? -1.0f : 4.0f);
    const glm::dvec3 before = light_of(e);
    scene::spread_negative(e);
    for (const glm::vec3& t : e.luminance_nit) EXPECT_EQ(t.x, 0.0f);
    for (const glm::vec3& t : e.luminance_nit) EXPECT_EQ(t.y, 1.0f);
    EXPECT_NEAR(light_of(e).z / before.z, 1.0, 1e-6);
    EXPECT_EQ(e.luminance_nit[7].z, 0.0f);
}

}  // namespace
}  // namespace candela::test
