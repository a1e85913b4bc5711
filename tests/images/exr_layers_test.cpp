#include <ImfArray.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfRgbaFile.h>

#include <cmath>

#include "candela/io/environment_read.hpp"
#include "candela/io/luminance_read.hpp"
#include "encoders.hpp"
#include "image_files.hpp"
#include "source_folder.hpp"

using namespace candela;
using namespace candela::tests;

namespace {

constexpr int kWidth = 8, kHeight = 4;

/// A part: its name and channels, each of one value.
struct PartKind {
    std::string name;
    std::vector<std::pair<std::string, float>> channels;
};

Imf::Header header_of(const PartKind& part) {
    Imf::Header header(kWidth, kHeight);
    for (const auto& [name, value] : part.channels) header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    return header;
}

/// `planes` must live as long as the frame buffer.
Imf::FrameBuffer frame_of(const PartKind& part, std::vector<std::vector<float>>& planes) {
    Imf::FrameBuffer frame;
    planes.reserve(part.channels.size());
    for (const auto& [name, value] : part.channels) {
        planes.emplace_back(std::size_t(kWidth * kHeight), value);
        frame.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(planes.back().data()), 4,
                                      std::size_t{4} * kWidth));
    }
    return frame;
}

void write_layers(const std::filesystem::path& file, const PartKind& kind) {
    Imf::OutputFile out(file.c_str(), header_of(kind));
    std::vector<std::vector<float>> planes;
    out.setFrameBuffer(frame_of(kind, planes));
    out.writePixels(kHeight);
}

void write_parts(const std::filesystem::path& file, const std::vector<PartKind>& parts) {
    std::vector<Imf::Header> headers;
    for (const PartKind& part : parts) {
        headers.push_back(header_of(part));
        headers.back().setName(part.name);
        headers.back().setType(Imf::SCANLINEIMAGE);
    }
    Imf::MultiPartOutputFile out(file.c_str(), headers.data(), int(headers.size()));
    for (int i = 0; i < int(parts.size()); ++i) {
        Imf::OutputPart part(out, i);
        std::vector<std::vector<float>> planes;
        part.setFrameBuffer(frame_of(parts[std::size_t(i)], planes));
        part.writePixels(kHeight);
    }
}

io::ReadEnvironment read(const std::filesystem::path& file, Diagnostics& diagnostics,
                         const std::string& layer = {}) {
    io::EnvironmentOptions options;
    options.layer = layer;
    return io::read_environment(file, diagnostics, options);
}

glm::vec3 color_of(const PartKind& kind, const std::string& layer = {}) {
    const Folder folder;
    write_layers(folder / "a.exr", kind);
    Diagnostics diagnostics;
    const glm::vec3 color = read(folder / "a.exr", diagnostics, layer).luminance_nit[0];
    for (const auto& w : diagnostics.warnings()) ADD_FAILURE() << w.text;
    return color;
}

}  // namespace

TEST(ExrLayers, NamesThatProgramsGiveToRedGreenAndBlue) {
    const glm::vec3 rgb(1.0f, 2.0f, 3.0f);
    for (const auto& names : {std::array{"R", "G", "B"},
                              {"r", "g", "b"},
                              {"Red", "Green", "Blue"},
                              {"red", "green", "blue"},
                              {"ViewLayer.Combined.R", "ViewLayer.Combined.G", "ViewLayer.Combined.B"},
                              {"beauty.r", "beauty.g", "beauty.b"},
                              {"My Layer.R", "My Layer.G", "My Layer.B"},
                              {"a.b.c.d.R", "a.b.c.d.G", "a.b.c.d.B"}}) {
        PartKind kind;
        for (std::size_t c = 0; c < 3; ++c) kind.channels.emplace_back(names[c], rgb[int(c)]);
        kind.channels.emplace_back("ViewLayer.Depth.Z", 9.0f);
        kind.channels.emplace_back("N.X", 7.0f), kind.channels.emplace_back("N.Y", 7.0f);
        kind.channels.emplace_back("N.Z", 7.0f), kind.channels.emplace_back("A", 0.5f);
        EXPECT_EQ(color_of(kind), rgb) << names[0];
    }
    EXPECT_EQ(color_of({"", {{"ViewLayer.Combined.V", 4.0f}}}), glm::vec3(4.0f));
    EXPECT_EQ(color_of({"", {{"y", 5.0f}}}), glm::vec3(5.0f));
}

TEST(ExrLayers, TheFinishedPictureIsTakenBeforeOtherPasses) {
    PartKind kind;
    for (const auto& [layer, value] :
         {std::pair{"ViewLayer.AO", 1.0f}, {"ViewLayer.Combined", 2.0f}, {"ViewLayer.DiffCol", 3.0f}}) {
        for (const char* c : {"R", "G", "B"}) kind.channels.emplace_back(std::string(layer) + "." + c, value);
    }
    EXPECT_EQ(color_of(kind), glm::vec3(2.0f));
    EXPECT_EQ(color_of(kind, "ViewLayer.DiffCol"), glm::vec3(3.0f));
    for (const char* c : {"R", "G", "B"}) kind.channels.emplace_back(c, 4.0f);
    const Folder folder;
    write_layers(folder / "a.exr", kind);
    Diagnostics diagnostics;
    EXPECT_EQ(read(folder / "a.exr", diagnostics).luminance_nit[0], glm::vec3(4.0f));
    EXPECT_EQ(io::read_luminance(folder / "a.exr", diagnostics).luminance_nit[0], glm::vec3(4.0f));
}

TEST(ExrLayers, AChoiceBetweenEqualsIsSaidAndAWrongNameListsThem) {
    PartKind kind;
    for (const auto& [layer, value] : {std::pair{"key", 1.0f}, {"fill", 2.0f}}) {
        for (const char* c : {"R", "G", "B"}) kind.channels.emplace_back(std::string(layer) + "." + c, value);
    }
    const Folder folder;
    write_layers(folder / "a.exr", kind);
    Diagnostics diagnostics;
    EXPECT_EQ(read(folder / "a.exr", diagnostics).luminance_nit[0], glm::vec3(2.0f));
    ASSERT_EQ(diagnostics.warnings().size(), 1u);
    EXPECT_NE(diagnostics.warnings()[0].text.find("fill, key: fill is read (--env-layer NAME)"),
              std::string::npos)
        << diagnostics.warnings()[0].text;
    const Error error = error_of([&] { (void)read(folder / "a.exr", diagnostics, "rim"); });
    EXPECT_NE(error.hint().find("fill, key"), std::string::npos);
}

TEST(ExrLayers, PartsAreFoundByName) {
    const Folder folder;
    const auto rgb = [](float value) {
        return std::vector<std::pair<std::string, float>>{{"R", value}, {"G", value}, {"B", value}};
    };
    write_parts(folder / "a.exr", {{"ViewLayer.Depth", {{"Z", 9.0f}}},
                                   {"ViewLayer.Normal", {{"X", 9.0f}, {"Y", 9.0f}, {"Z", 9.0f}}},
                                   {"ViewLayer.DiffDir", rgb(1.0f)},
                                   {"ViewLayer.Combined", rgb(2.0f)}});
    Diagnostics diagnostics;
    EXPECT_EQ(read(folder / "a.exr", diagnostics).luminance_nit[0], glm::vec3(2.0f));
    EXPECT_EQ(read(folder / "a.exr", diagnostics, "ViewLayer.DiffDir").luminance_nit[0], glm::vec3(1.0f));
    EXPECT_TRUE(diagnostics.warnings().empty());
}

// OpenEXR's own writer halves chroma, and rounds both as it is told to; green of a deep blue is the small
// difference of luminance and chroma, so the smooth colour comes back within what 10 bits leave of it.
TEST(ExrLayers, LuminanceAndChromaAreTheSameColours) {
    const Folder folder;
    constexpr int width = 64, height = 32;
    Imf::Array2D<Imf::Rgba> pixels(height, width);
    const auto expected = [](int x, int y) {
        return glm::vec3(1.0f + 0.02f * float(x), 0.5f + 0.01f * float(y), 40.0f + 0.3f * float(x + y));
    };
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const glm::vec3 c = expected(x, y);
            pixels[y][x] = Imf::Rgba(c.x, c.y, c.z);
        }
    }
    for (const Imf::RgbaChannels channels : {Imf::WRITE_YC, Imf::WRITE_YCA}) {
        {
            Imf::RgbaOutputFile out((folder / "yc.exr").c_str(), width, height, channels);
            out.setYCRounding(10, 10);
            out.setFrameBuffer(&pixels[0][0], 1, width);
            out.writePixels(height);
        }
        Diagnostics diagnostics;
        const scene::Environment e = read(folder / "yc.exr", diagnostics);
        EXPECT_TRUE(diagnostics.warnings().empty());
        ASSERT_EQ(e.width, std::uint32_t(width));
        for (int y = 2; y < height - 2; ++y) {
            for (int x = 2; x < width - 2; ++x) {
                const glm::vec3 value = e.luminance_nit[std::size_t(y * width + x)], c = expected(x, y);
                for (int k = 0; k < 3; ++k) EXPECT_NEAR(value[k] / c[k], 1.0f, 0.05f) << x << " " << y << k;
            }
        }
    }
}

TEST(DisplayPictures, AreLinearLightWithAWarning) {
    const Folder folder;
    PngKind png;
    png.width = kWidth;
    png.height = kHeight;
    png.color_type = 2;
    std::vector<std::uint8_t> rows;
    for (int i = 0; i < kWidth * kHeight; ++i) rows.insert(rows.end(), {255, 188, 0});
    save(folder / "a.png", encode_png(png, rows));
    JpegKind jpeg;
    jpeg.width = kWidth;
    jpeg.height = kHeight;
    save(folder / "a.jpg", encode_jpeg(jpeg, rows));
    std::vector<std::uint8_t> rgba;
    for (int i = 0; i < kWidth * kHeight; ++i) rgba.insert(rgba.end(), {255, 188, 0, 255});
    save(folder / "a.webp", encode_webp(kWidth, kHeight, rgba));
    for (const char* name : {"a.png", "a.jpg", "a.webp"}) {
        Diagnostics diagnostics;
        const io::ReadEnvironment e = read(folder / name, diagnostics);
        EXPECT_NEAR(e.luminance_nit[9].x, 1.0f, 0.02f) << name;
        EXPECT_NEAR(e.luminance_nit[9].y, 0.503f, 0.02f) << "188 is 0.503: IEC 61966-2-1";
        EXPECT_NEAR(e.luminance_nit[9].z, 0.0f, 0.02f);
        EXPECT_FALSE(e.absolute);
        ASSERT_EQ(diagnostics.warnings().size(), 1u) << name;
        EXPECT_NE(diagnostics.warnings()[0].text.find("brighter than white"), std::string::npos);
    }
}

TEST(ExrLayers, CasesThatFailed) {
    const std::filesystem::path cases = CANDELA_SOURCE_DIR "/../shared/data/cases/layered_exr";
    if (!std::filesystem::exists(cases)) GTEST_SKIP() << "no cases here";
    for (const char* name : {"layer.exr", "YC.exr"}) {
        Diagnostics diagnostics;
        const scene::Environment e = read(cases / name, diagnostics);
        EXPECT_GT(e.luminance_nit[0].y, 0.0f) << name;
    }
}
