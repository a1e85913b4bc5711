// Depth of display pictures as environments, and the memory that environments may take.
#include <ImfRgbaFile.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "candela/io/environment_read.hpp"
#include "candela/scene/error.hpp"
#include "encoders.hpp"
#include "image_files.hpp"

using namespace candela;
using namespace candela::tests;

namespace {

constexpr int kWidth = 8, kHeight = 4;

}  // namespace

TEST(DisplayPictures, SixteenBitsAChannelAreKept) {
    const Folder folder;
    for (const int color_type : {0, 2, 4, 6}) {
        for (const bool interlaced : {false, true}) {
            PngKind png;
            png.width = kWidth;
            png.height = kHeight;
            png.bits = 16;
            png.color_type = color_type;
            png.interlaced = interlaced;
            const int channels = color_type == 0 ? 1 : color_type == 2 ? 3 : color_type == 4 ? 2 : 4;
            // A ramp whose steps are far below one of 8 bits; alpha is full.
            std::vector<std::uint8_t> rows;
            const auto value = [](int i) { return 1000 + 3 * i; };
            for (int i = 0; i < kWidth * kHeight; ++i) {
                for (int c = 0; c < channels; ++c) {
                    const int v = channels % 2 == 0 && c == channels - 1 ? 65535 : value(i);
                    rows.push_back(static_cast<std::uint8_t>(v >> 8));
                    rows.push_back(static_cast<std::uint8_t>(v & 255));
                }
            }
            save(folder / "a.png", encode_png(png, rows));
            Diagnostics diagnostics;
            const io::ReadEnvironment e = io::read_environment(folder / "a.png", diagnostics);
            ASSERT_EQ(e.luminance_nit.size(), std::size_t(kWidth * kHeight));
            for (int i = 0; i < kWidth * kHeight; ++i) {
                const float s = static_cast<float>(value(i)) / 65535.0f;
                const float linear = s <= 0.04045f ? s / 12.92f : std::pow((s + 0.055f) / 1.055f, 2.4f);
                for (int c = 0; c < 3; ++c)
                    ASSERT_NEAR(e.luminance_nit[std::size_t(i)][c], linear, 1e-5f * linear)
                        << "colour type " << color_type << ", texel " << i;
            }
            EXPECT_NE(diagnostics.warnings()[0].text.find("16 bits"), std::string::npos);
        }
    }
    // One that is cut off is one error.
    PngKind png;
    png.width = kWidth;
    png.height = kHeight;
    png.bits = 16;
    png.color_type = 2;
    std::vector<std::byte> bytes = encode_png(png, std::vector<std::uint8_t>(6 * kWidth * kHeight, 77));
    bytes.resize(bytes.size() / 2);
    save(folder / "cut.png", bytes);
    Diagnostics diagnostics;
    EXPECT_THROW((void)io::read_environment(folder / "cut.png", diagnostics), Error);
}

// Before the picture is decoded, in every format.
TEST(EnvironmentMemory, APictureBeyondTheBudgetIsRefusedByItsHeader) {
    const Folder folder;
    PngKind png;
    png.width = 1024;
    png.height = 512;
    png.color_type = 2;
    save(folder / "a.png", encode_png(png, std::vector<std::uint8_t>(3 * 1024 * 512, 100)));
    std::string hdr = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 512 +X 1024\n";
    for (int i = 0; i < 1024 * 512; ++i) hdr += std::string("\x80\x80\x80\x81", 4);
    std::vector<std::byte> bytes(hdr.size());
    std::transform(hdr.begin(), hdr.end(), bytes.begin(), [](char c) { return static_cast<std::byte>(c); });
    save(folder / "a.hdr", bytes);
    {
        Imf::RgbaOutputFile out((folder / "a.exr").c_str(), 1024, 512, Imf::WRITE_RGB);
        const std::vector<Imf::Rgba> texels(std::size_t{1024} * 512, Imf::Rgba(1.0f, 1.0f, 1.0f));
        out.setFrameBuffer(texels.data(), 1, 1024);
        out.writePixels(512);
    }
    for (const char* name : {"a.png", "a.hdr", "a.exr"}) {
        Diagnostics diagnostics;
        io::EnvironmentOptions options;
        options.memory = scene::MemoryBudget{std::uint64_t{20} * 1024 * 512, true};
        EXPECT_EQ(io::read_environment(folder / name, diagnostics, options).width, 1024u) << name;
        options.memory->bytes -= 1;
        try {
            (void)io::read_environment(folder / name, diagnostics, options);
            ADD_FAILURE() << name;
        } catch (const Error& error) {
            EXPECT_EQ(error.fault(), Fault::machine) << name;
            EXPECT_NE(error.line().find("--memory allows"), std::string::npos) << error.line();
        }
    }
}
