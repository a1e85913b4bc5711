#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfTiledOutputFile.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "candela/io/environment_read.hpp"
#include "candela/io/image_read.hpp"
#include "candela/io/image_write.hpp"
#include "image_files.hpp"
#include "source_folder.hpp"

using namespace candela;
using namespace candela::tests;

namespace {

using Rgbe = std::array<unsigned char, 4>;

std::string flat(const std::vector<Rgbe>& texels) {
    std::string out;
    for (const Rgbe& t : texels) out.append(reinterpret_cast<const char*>(t.data()), 4);
    return out;
}

scene::Environment read_hdr(const std::string& content) {
    const Folder folder;
    save(folder / "a.hdr", bytes_of(content));
    Diagnostics diagnostics;
    return io::read_environment(folder / "a.hdr", diagnostics);
}

const std::string head = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n";

/// Red counts the columns, green the rows of a picture 3 wide and 2 high, in the order of the file.
scene::Environment read_oriented(const std::string& resolution,
                                 const std::vector<std::pair<int, int>>& order) {
    std::vector<Rgbe> texels;
    for (const auto& [x, y] : order)
        texels.push_back({static_cast<unsigned char>(16 * x), static_cast<unsigned char>(16 * y), 128, 136});
    return read_hdr(head + "\n" + resolution + "\n" + flat(texels));
}

void expect_upright(const scene::Environment& e, const std::string& what) {
    ASSERT_EQ(e.width, 3u) << what;
    ASSERT_EQ(e.height, 2u) << what;
    for (std::uint32_t y = 0; y < 2; ++y) {
        for (std::uint32_t x = 0; x < 3; ++x)
            EXPECT_EQ(e.luminance_nit[y * 3 + x], glm::vec3(16.0f * float(x), 16.0f * float(y), 128.0f))
                << what;
    }
}

/// One float picture of three planes through OpenEXR itself, with a header of the test's making.
struct ExrKind {
    Imath::Box2i data{{0, 0}, {7, 3}};
    Imath::Box2i display{{0, 0}, {7, 3}};
    Imf::Compression compression = Imf::PIZ_COMPRESSION;
    bool tiled = false;
    std::vector<std::string> channels{"R", "G", "B"};
    float white_nit = 0.0f;
    bool wide_gamut = false;
};

float expected_value(int x, int y) {
    return 100000.0f * static_cast<float>(x + 1) + static_cast<float>(y);
}

void write_exr_kind(const std::filesystem::path& file, const ExrKind& kind) {
    Imf::Header header(kind.display, kind.data);
    header.compression() = kind.compression;
    if (kind.white_nit > 0.0f) Imf::addWhiteLuminance(header, kind.white_nit);
    if (kind.wide_gamut) {
        Imf::addChromaticities(header, Imf::Chromaticities({0.708f, 0.292f}, {0.170f, 0.797f},
                                                           {0.131f, 0.046f}, {0.3127f, 0.3290f}));
    }
    const int width = kind.data.max.x - kind.data.min.x + 1, height = kind.data.max.y - kind.data.min.y + 1;
    std::vector<float> plane;
    for (int y = kind.data.min.y; y <= kind.data.max.y; ++y) {
        for (int x = kind.data.min.x; x <= kind.data.max.x; ++x) plane.push_back(expected_value(x, y));
    }
    Imf::FrameBuffer frame;
    for (const std::string& name : kind.channels) {
        header.channels().insert(name, Imf::Channel(Imf::FLOAT));
        frame.insert(name, Imf::Slice::Make(Imf::FLOAT, plane.data(), kind.data, 4,
                                            4 * static_cast<std::size_t>(width)));
    }
    if (kind.tiled) {
        header.setTileDescription(Imf::TileDescription(5, 3, Imf::ONE_LEVEL));
        Imf::TiledOutputFile out(file.c_str(), header);
        out.setFrameBuffer(frame);
        out.writeTiles(0, out.numXTiles() - 1, 0, out.numYTiles() - 1);
    } else {
        Imf::OutputFile out(file.c_str(), header);
        out.setFrameBuffer(frame);
        out.writePixels(height);
    }
}

}  // namespace

TEST(Hdr, AllEightOrientationsComeOutUpright) {
    using Order = std::vector<std::pair<int, int>>;
    const Order rows{{0, 0}, {1, 0}, {2, 0}, {0, 1}, {1, 1}, {2, 1}};
    const Order columns{{0, 0}, {0, 1}, {1, 0}, {1, 1}, {2, 0}, {2, 1}};
    for (const char y_sign : {'-', '+'}) {
        for (const char x_sign : {'-', '+'}) {
            const auto seen = [&](Order order) {
                for (auto& [x, y] : order) {
                    if (x_sign == '-') x = 2 - x;
                    if (y_sign == '+') y = 1 - y;
                }
                return order;
            };
            const std::string y = std::string{y_sign} + "Y 2", x = std::string{x_sign} + "X 3";
            expect_upright(read_oriented(y + " " + x, seen(rows)), y + " " + x);
            expect_upright(read_oriented(x + " " + y, seen(columns)), x + " " + y);
        }
    }
}

TEST(Hdr, OldAndNewRunsAreTheSamePicture) {
    const std::string resolution = "\n-Y 1 +X 600\n";
    // 600 texels: one, then 599 = 0x257 repeats as a chain of two counts.
    const std::string old_runs = flat({Rgbe{10, 20, 30, 140}, Rgbe{1, 1, 1, 0x57}, Rgbe{1, 1, 1, 0x02}});
    std::string new_runs{'\x02', '\x02', '\x02', '\x58'};
    for (const int value : {10, 20, 30, 140}) {
        for (const int count : {127, 127, 127, 127}) new_runs += {char(128 + count), char(value)};
        new_runs += char(92);
        new_runs += std::string(92, char(value));
    }
    const auto a = read_hdr(head + resolution + old_runs);
    const auto b = read_hdr(head + resolution + new_runs);
    ASSERT_EQ(a.luminance_nit.size(), 600u);
    EXPECT_EQ(a.luminance_nit, b.luminance_nit);
    EXPECT_EQ(a.luminance_nit[599], glm::vec3(160.0f, 320.0f, 480.0f)) << "mantissa * 2^(140 - 136)";
}

TEST(Hdr, ExposureIsDividedOutAndSeveralMultiply) {
    const auto e = read_hdr(head + "EXPOSURE=2\nEXPOSURE= 4.0\n\n-Y 1 +X 1\n" + flat({Rgbe{128, 0, 0, 136}}));
    EXPECT_EQ(e.luminance_nit[0], glm::vec3(16.0f, 0.0f, 0.0f));
}

TEST(Hdr, BrokenOnesAreErrors) {
    const std::vector<std::pair<std::string, std::string>> cases{
        {"#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n", "unsupported format"},
        {head + "\n-Y 1 +Y 1\n" + std::string(4, 'a'), "not a resolution"},
        {head + "\n-Y 100000 +X 100000\n", "too large"},
        {head + "\n-Y 16384 +X 16384\n" + std::string(100, 'a'), "claims a larger picture"},
        {head + "\n-Y 1 +X 8\n\x02\x02" + std::string(1, '\0') + "\x09" + std::string(64, '\x80'),
         "another length"},
        {head + "\n-Y 1 +X 8\n\x02\x02" + std::string(1, '\0') + "\x08" + std::string(64, '\xff'),
         "leaves its scan line"},
        {head + "\n-Y 1 +X 2\n\x01\x01\x01\x02" + std::string(4, 'a'), "leaves its scan line"},
        {head + "EXPOSURE=0\n\n-Y 1 +X 1\n" + std::string(4, 'a'), "not positive"},
        {head + "\n-Y 1 +X 2\n" + std::string(4, 'a'), "too early"},
        {head, "too early"}};
    for (const auto& [content, message] : cases) {
        const Error error = error_of([&, c = content] { (void)read_hdr(c); });
        EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
        EXPECT_EQ(error.fault(), Fault::input);
    }
}

TEST(ExrEnvironment, LinesTilesAndEveryLosslessCompressionAreTheSame) {
    const Folder folder;
    for (const Imf::Compression compression :
         {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION, Imf::ZIP_COMPRESSION,
          Imf::PIZ_COMPRESSION}) {
        for (const bool tiled : {false, true}) {
            ExrKind kind;
            kind.compression = compression;
            kind.tiled = tiled;
            write_exr_kind(folder / "a.exr", kind);
            Diagnostics diagnostics;
            const auto e = io::read_environment(folder / "a.exr", diagnostics);
            ASSERT_EQ(e.width, 8u);
            ASSERT_EQ(e.height, 4u);
            EXPECT_EQ(e.luminance_nit[0 * 8 + 7], glm::vec3(expected_value(7, 0)))
                << "beyond half range, unharmed";
            EXPECT_EQ(e.luminance_nit[3 * 8 + 0], glm::vec3(expected_value(0, 3)));
            EXPECT_TRUE(diagnostics.warnings().empty()) << diagnostics.warnings()[0].text;
            EXPECT_EQ(e.name, "a.exr");
        }
    }
}

TEST(ExrEnvironment, TheDisplayWindowIsThePicture) {
    const Folder folder;
    ExrKind kind;
    kind.data = {{-2, 1}, {5, 6}};
    write_exr_kind(folder / "a.exr", kind);
    Diagnostics diagnostics;
    const auto e = io::read_environment(folder / "a.exr", diagnostics);
    ASSERT_EQ(e.width, 8u);
    ASSERT_EQ(e.height, 4u);
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 8; ++x) {
            const bool there = x <= 5 && y >= 1;
            EXPECT_EQ(e.luminance_nit[static_cast<std::size_t>(8 * y + x)],
                      glm::vec3(there ? expected_value(x, y) : 0.0f));
        }
    }
    EXPECT_EQ(diagnostics.warnings().size(), 1u);
}

TEST(ExrEnvironment, GreyIsReadAndOtherChannelsAreNamedInTheError) {
    const Folder folder;
    ExrKind kind;
    kind.channels = {"Y"};
    write_exr_kind(folder / "grey.exr", kind);
    Diagnostics diagnostics;
    EXPECT_EQ(io::read_environment(folder / "grey.exr", diagnostics).luminance_nit[9],
              glm::vec3(expected_value(1, 1)));
    kind.channels = {"depth.Z", "left.R"};
    write_exr_kind(folder / "odd.exr", kind);
    const Error error = error_of([&] { (void)io::read_environment(folder / "odd.exr", diagnostics); });
    EXPECT_NE(error.hint().find("depth.Z, left.R"), std::string::npos);
}

TEST(HdrEnvironment, PrimariesOfZerosAreAnUnsetField) {
    const auto warned = [](const std::string& primaries) {
        const Folder folder;
        save(folder / "a.hdr", bytes_of(head + "PRIMARIES=" + primaries + "\n\n-Y 1 +X 1\n" +
                                        flat({Rgbe{128, 128, 128, 136}})));
        Diagnostics diagnostics;
        (void)io::read_environment(folder / "a.hdr", diagnostics);
        bool found = false;
        for (const Diagnostics::Warning& w : diagnostics.warnings())
            found = found || w.text.find("primaries") != std::string::npos;
        return found;
    };
    EXPECT_FALSE(warned("0 0 0 0 0 0 0 0"));
    EXPECT_FALSE(warned("0.640 0.330 0.300 0.600 0.150 0.060 0.3127 0.3290"));
    EXPECT_TRUE(warned("0.7 0.3 0.2 0.7 0.15 0.06 0.3127 0.3290"));
}

TEST(ExrEnvironment, WhiteLuminanceScalesAndForeignPrimariesWarn) {
    const Folder folder;
    ExrKind kind;
    kind.white_nit = 100.0f;
    kind.wide_gamut = true;
    write_exr_kind(folder / "a.exr", kind);
    Diagnostics diagnostics;
    const auto e = io::read_environment(folder / "a.exr", diagnostics);
    EXPECT_FLOAT_EQ(e.luminance_nit[0].x, 100.0f * expected_value(0, 0));
    ASSERT_EQ(diagnostics.warnings().size(), 1u);
    EXPECT_NE(diagnostics.warnings()[0].text.find("primaries"), std::string::npos);
}

TEST(ExrEnvironment, WhatIsNoLuminanceIsRepairedWithWarnings) {
    const Folder folder;
    const float inf = std::numeric_limits<float>::infinity();
    const std::vector<float> red{1.0f, std::nanf(""), -5.0f, inf, 2e9f, 0.0f, -inf, 3.0f};
    const std::vector<float> zero(8, 0.0f);
    io::write_exr(folder / "a.exr", 4, 2,
                  {{"R", io::PixelType::float32, std::span<const float>(red)},
                   {"G", io::PixelType::float32, std::span<const float>(zero)},
                   {"B", io::PixelType::float32, std::span<const float>(zero)}},
                  {});
    Diagnostics diagnostics;
    const auto e = io::read_environment(folder / "a.exr", diagnostics);
    const std::vector<float> expected{1.0f, 0.0f, 0.0f, 2e9f, 2e9f, 0.0f, 0.0f, 3.0f};
    for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(e.luminance_nit[i].x, expected[i]) << i;
    ASSERT_EQ(diagnostics.warnings().size(), 3u);
    EXPECT_NE(diagnostics.warnings()[0].text.find("negative luminance"), std::string::npos);
    EXPECT_NE(diagnostics.warnings()[1].text.find("not a number"), std::string::npos)
        << diagnostics.warnings()[1].text;
    EXPECT_NE(diagnostics.warnings()[2].text.find("infinit"), std::string::npos)
        << diagnostics.warnings()[2].text;
}

TEST(ExrEnvironment, TruncatedAndFlippedFilesAreErrorsOrPictures) {
    const Folder folder;
    ExrKind kind;
    kind.compression = Imf::ZIP_COMPRESSION;
    kind.data = kind.display = {{0, 0}, {31, 63}};
    write_exr_kind(folder / "a.exr", kind);
    const Bytes whole = load(folder / "a.exr");
    Diagnostics diagnostics;
    for (std::size_t length = 0; length < whole.size(); length += 7) {
        save(folder / "b.exr", Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)));
        const Error error = error_of([&] { (void)io::read_environment(folder / "b.exr", diagnostics); });
        ASSERT_EQ(error.fault(), Fault::input) << length;
    }
    for (std::size_t at = 4; at < std::min<std::size_t>(whole.size(), 500); ++at) {
        Bytes broken = whole;
        broken[at] ^= std::byte{0x41};
        save(folder / "b.exr", broken);
        try {
            (void)io::read_environment(folder / "b.exr", diagnostics);
        } catch (const Error& error) {
            ASSERT_EQ(error.fault(), Fault::input) << at;
        }
    }
}

TEST(Environment, OtherFilesAndShapesAreNoticed) {
    const Folder folder;
    save(folder / "a.exr", bytes_of("not a picture"));
    Diagnostics diagnostics;
    EXPECT_EQ(error_of([&] { (void)io::read_environment(folder / "a.exr", diagnostics); }).where(),
              (folder / "a.exr").string());
    EXPECT_STREQ(error_of([&] { (void)io::read_environment(folder / "no.exr", diagnostics); }).what(),
                 "no such file");
    save(folder / "b.hdr", bytes_of(head + "\n-Y 1 +X 1\n" + flat({Rgbe{1, 1, 1, 128}})));
    EXPECT_STREQ(error_of([&] { (void)io::read_environment(folder / "b.hdr", diagnostics); }).what(),
                 "broken Radiance picture: a run leaves its scan line");
    save(folder / "b.hdr", bytes_of(head + "\n-Y 1 +X 1\n" + flat({Rgbe{2, 1, 1, 128}})));
    (void)io::read_environment(folder / "b.hdr", diagnostics);
    ASSERT_EQ(diagnostics.warnings().size(), 1u);
    EXPECT_NE(diagnostics.warnings()[0].text.find("stretched"), std::string::npos);
}

TEST(Environment, RealOnesRead) {
    const std::filesystem::path shared = CANDELA_SOURCE_DIR "/../shared/data/hdri";
    if (!std::filesystem::exists(shared)) GTEST_SKIP() << "no sample environments here";
    for (const auto& entry : std::filesystem::directory_iterator(shared)) {
        Diagnostics diagnostics;
        const auto e = io::read_environment(entry.path(), diagnostics);
        EXPECT_EQ(e.width, 2 * e.height) << entry.path();
        const bool light = std::any_of(e.luminance_nit.begin(), e.luminance_nit.end(),
                                       [](const glm::vec3& t) { return t.y > 0.1f; });
        EXPECT_TRUE(light) << entry.path();
    }
}
