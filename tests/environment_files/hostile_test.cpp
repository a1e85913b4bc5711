#include <gtest/gtest.h>

#include "candela/scene/error.hpp"
#include "reading.hpp"

namespace candela::test {
namespace {

void expect_refused(const Text& bytes, const std::string& what) {
    try {
        (void)read_bytes(bytes);
        ADD_FAILURE() << what << " was read";
    } catch (const Error& error) {
        EXPECT_EQ(error.fault(), Fault::input) << what;
        EXPECT_EQ(error.line().find('\n'), std::string::npos);
    }
}

TEST(ReadHostile, EveryTruncationIsAnError) {
    Ktx2 ktx = ktx_cube(colorful_ahead);
    ktx.width = ktx.height = 4;
    ktx.data = pixels(faces_of(colorful_ahead, 4), 97);
    Dds dds;
    dds.width = dds.height = 4;
    dds.four_cc = 0x30315844;
    dds.data = ktx.data;
    for (const Text& whole : {ktx.bytes(), dds.bytes()}) {
        (void)read_bytes(whole);
        for (std::size_t length = 0; length < whole.size(); length += length < 160 ? 1 : 37)
            expect_refused(whole.substr(0, length), "the first " + std::to_string(length) + " bytes");
    }
}

TEST(ReadHostile, SizesBeyondTheDataAreRefusedBeforeMemoryIsTaken) {
    const auto with = [](auto change) {
        Ktx2 file;
        file.width = file.height = 4;
        file.data = pixels(std::vector<glm::vec3>(6 * 16, glm::vec3(1.0f)), 97);
        change(file);
        return file.bytes();
    };
    expect_refused(with([](Ktx2& f) { f.width = f.height = 16384; }), "a large cube");
    expect_refused(with([](Ktx2& f) { f.width = f.height = 0x80000000u; }), "an overflowing cube");
    expect_refused(with([](Ktx2& f) { f.width = 8; }), "faces that are not square");
    expect_refused(with([](Ktx2& f) { f.width = f.height = 0; }), "no faces");
    expect_refused(with([](Ktx2& f) { f.faces = 5; }), "five faces");
    expect_refused(with([](Ktx2& f) { f.layers = 2; }), "layers");
    expect_refused(with([](Ktx2& f) { f.depth = 4; }), "depth");
    expect_refused(with([](Ktx2& f) { f.format = 37; }), "eight bits a channel");
    expect_refused(with([](Ktx2& f) { f.packing = 1; }), "BasisLZ");
    expect_refused(with([](Ktx2& f) { f.packing = 3; }), "what is no deflate stream");
    expect_refused(with([](Ktx2& f) { f.packing = 2; }), "what is no Zstandard frame");
    expect_refused(with([](Ktx2& f) { f.keys = Text("\xff\xff\xff\x7f", 4); }), "a key that leaves the file");
    expect_refused(with([](Ktx2& f) { f.keys = ktx_key("candela.nitPerUnit", "nan"); }),
                   "a unit that is no number");
    expect_refused(with([](Ktx2& f) { f.keys = ktx_key("candela.nitPerUnit", "-1"); }), "a negative unit");
    Dds dds;
    dds.width = dds.height = 16384;
    dds.data = Text(64, '\0');
    expect_refused(dds.bytes(), "a large DDS");
    dds.width = dds.height = 2;
    dds.levels = 0xffffffffu;
    expect_refused(dds.bytes(), "a DDS of four thousand million levels");
    dds.levels = 1;
    dds.four_cc = 0x31545844;
    expect_refused(dds.bytes(), "DXT1");
}

TEST(ReadHostile, WhatIsNoLuminanceIsRepairedWithAWarning) {
    Ktx2 file;
    file.width = file.height = 1;
    for (const std::uint32_t red :
         {0x7e00u, 0xbc00u, 0x7c00u, 0x4000u, 0x4000u, 0x4000u}) {  // NaN, -1, infinity, 2
        put(file.data, red, 2);
        for (int c = 0; c < 3; ++c) put(file.data, 0x3c00u, 2);
    }
    const TemporaryFolder folder;
    spit(folder / "a.ktx2", file.bytes());
    Diagnostics diagnostics;
    const scene::Environment e = io::read_environment(folder / "a.ktx2", diagnostics);
    ASSERT_EQ(diagnostics.warnings().size(), 3u);
    EXPECT_EQ(
        diagnostics.warnings()[0].text.find("a.ktx2: negative luminance became 0, in 1 of 6 texels, the "
                                            "least -1; the up-facing illuminance "),
        0u)
        << diagnostics.warnings()[0].text;
    EXPECT_NE(diagnostics.warnings()[1].text.find("not a number became 0, in 1 of 6"), std::string::npos);
    EXPECT_NE(diagnostics.warnings()[2].text.find("infinite luminance"), std::string::npos);
    for (const glm::vec3& t : e.luminance_nit) EXPECT_TRUE(t.x >= 0.0f && t.x <= 2.01f) << t.x;
}

}  // namespace
}  // namespace candela::test
