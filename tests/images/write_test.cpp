#include <ImfChannelList.h>
#include <ImfChromaticitiesAttribute.h>
#include <ImfFloatAttribute.h>
#include <ImfInputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <png.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <csignal>
#include <functional>
#include <numeric>

#include "candela/io/image_read.hpp"
#include "candela/io/image_write.hpp"
#include "image_files.hpp"

using namespace candela;
using namespace candela::tests;

namespace {

constexpr std::uint32_t width = 301, height = 157;

std::vector<float> ramp(float scale) {
    std::vector<float> out(std::size_t{width} * height);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = scale * static_cast<float>(i % 1009);
    return out;
}

void write_layers(const std::filesystem::path& file, float scale = 1.0f) {
    const std::vector<float> red = ramp(scale), depth = ramp(0.1f);
    std::vector<std::uint32_t> ids(red.size());
    std::iota(ids.begin(), ids.end(), 0u);
    io::write_exr(file, width, height,
                  {{"R", io::PixelType::half, std::span<const float>(red)},
                   {"depth.Z", io::PixelType::float32, std::span<const float>(depth)},
                   {"shape_index.I", io::PixelType::uint32, std::span<const std::uint32_t>(ids)}},
                  {{"whiteLuminance", 1.0f},
                   {"expTime", 0.008f},
                   {"candela/profile", std::string("best")},
                   {"candela/a_long_name_beyond_the_old_limit", std::string("x")}});
}

std::vector<std::uint8_t> noise(std::size_t count) {
    std::vector<std::uint8_t> out(count);
    std::uint32_t state = 1;
    for (std::uint8_t& b : out) b = static_cast<std::uint8_t>((state = state * 1664525u + 1013904223u) >> 24);
    return out;
}

/// In a child whose files may not grow beyond some bytes, as on a full disk: 0 when the writer says that the
/// machine failed and leaves nothing but what was there.
int status_with_full_disk(const Folder& folder, const std::function<void()>& write) {
    const std::size_t files = folder.files();
    Imf::setGlobalThreadCount(0);  // a child would wait for ever for threads that it does not have
    const pid_t child = fork();
    if (child == 0) {
        signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{4096, 4096};
        setrlimit(RLIMIT_FSIZE, &limit);
        try {
            write();
        } catch (const Error& error) {
            _exit(error.fault() != Fault::machine ? 2 : folder.files() != files ? 3 : 0);
        }
        _exit(1);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

struct PngHeader {
    int bits = 0, color_type = 0, intent = -1;
    std::map<std::string, std::string> text;
    std::vector<std::uint16_t> first_row;
};

PngHeader read_png_header(const std::filesystem::path& file) {
    PngHeader out;
    std::FILE* stream = std::fopen(file.c_str(), "rb");
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, stream);
    png_read_info(png, info);
    out.bits = png_get_bit_depth(png, info);
    out.color_type = png_get_color_type(png, info);
    png_get_sRGB(png, info, &out.intent);
    png_textp text = nullptr;
    int count = 0;
    png_get_text(png, info, &text, &count);
    for (int i = 0; i < count; ++i) out.text[text[i].key] = text[i].text;
    if (out.bits == 16) {
        png_set_swap(png);
        out.first_row.resize(std::size_t{3} * png_get_image_width(png, info));
        png_read_row(png, reinterpret_cast<png_bytep>(out.first_row.data()), nullptr);
    }
    png_destroy_read_struct(&png, &info, nullptr);
    std::fclose(stream);
    return out;
}

}  // namespace

TEST(WriteExr, LayersAttributesAndTypesComeBack) {
    const Folder folder;
    write_layers(folder / "a.exr");
    const io::FloatImage image = io::read_exr(folder / "a.exr");
    EXPECT_EQ(image.channels, (std::vector<std::string>{"R", "depth.Z", "shape_index.I"}));
    EXPECT_EQ((*image.find("R"))[500], 500.0f);
    EXPECT_EQ((*image.find("depth.Z"))[1008], 0.1f * 1008.0f);
    EXPECT_EQ((*image.find("shape_index.I"))[47000], 47000.0f);
    EXPECT_EQ(image.find("G"), nullptr);
    const Imf::InputFile file((folder / "a.exr").c_str());
    EXPECT_EQ(file.header().channels().findChannel("R")->type, Imf::HALF);
    EXPECT_EQ(file.header().channels().findChannel("depth.Z")->type, Imf::FLOAT);
    EXPECT_EQ(file.header().channels().findChannel("shape_index.I")->type, Imf::UINT);
    EXPECT_EQ(file.header().compression(), Imf::ZIP_COMPRESSION);
    EXPECT_EQ(Imf::whiteLuminance(file.header()), 1.0f);
    EXPECT_EQ(Imf::expTime(file.header()), 0.008f);
    EXPECT_EQ(file.header().typedAttribute<Imf::StringAttribute>("candela/profile").value(), "best");
    EXPECT_EQ(Imf::chromaticities(file.header()).red, Imath::V2f(0.64f, 0.33f));
}

TEST(WriteExr, BeyondHalfRangeTheChannelIsFloat) {
    const Folder folder;
    write_layers(folder / "a.exr", 100.0f);
    const Imf::InputFile file((folder / "a.exr").c_str());
    EXPECT_EQ(file.header().channels().findChannel("R")->type, Imf::FLOAT);
    EXPECT_EQ((*io::read_exr(folder / "a.exr").find("R"))[1008], 100800.0f);
}

TEST(WriteExr, TheSamePictureIsTheSameBytes) {
    const Folder folder;
    write_layers(folder / "a.exr");
    write_layers(folder / "b.exr");
    EXPECT_EQ(load(folder / "a.exr"), load(folder / "b.exr"));
}

TEST(WriteExr, MismatchedPlanesAreTheCallersMistake) {
    const Folder folder;
    const std::vector<float> one(1);
    const io::ExrChannel channel{"R", io::PixelType::half, std::span<const float>(one)};
    EXPECT_THROW(io::write_exr(folder / "a.exr", 2, 1, {channel}, {}), std::invalid_argument);
    EXPECT_THROW(io::write_exr(folder / "a.exr", 1, 1, {channel, channel}, {}), std::invalid_argument);
    EXPECT_THROW(io::write_exr(folder / "a.exr", 1, 1, {channel}, {{"dataWindow", 1.0f}}),
                 std::invalid_argument);
    EXPECT_EQ(folder.files(), 0u);
}

TEST(WritePng, EightAndSixteenBitAreSrgbWithTheirText) {
    const Folder folder;
    const auto rgb = noise(std::size_t{3} * width * height);
    io::write_png(folder / "a.png", width, height, std::span<const std::uint8_t>(rgb),
                  {{"Software", "candela"}, {"Author", "J\xc3\xbcrgen"}});
    const scene::Image image = io::decode_image(load(folder / "a.png"), "a.png");
    ASSERT_EQ(image.width, width);
    for (std::size_t i = 0; i < rgb.size(); ++i) ASSERT_EQ(image.rgba[i / 3 * 4 + i % 3], rgb[i]);
    const PngHeader header = read_png_header(folder / "a.png");
    EXPECT_EQ(header.intent, PNG_sRGB_INTENT_PERCEPTUAL);
    EXPECT_EQ(header.color_type, PNG_COLOR_TYPE_RGB);
    EXPECT_EQ(header.text.at("Software"), "candela");
    EXPECT_EQ(header.text.at("Author"), "J\xc3\xbcrgen");

    const std::vector<std::uint16_t> words{0, 1, 0xfffe, 0x1234, 0x8000, 0xffff};
    io::write_png(folder / "b.png", 2, 1, std::span<const std::uint16_t>(words));
    const PngHeader deep = read_png_header(folder / "b.png");
    EXPECT_EQ(deep.bits, 16);
    EXPECT_EQ(deep.first_row, words);
    EXPECT_THROW(io::write_png(folder / "c.png", 3, 1, std::span<const std::uint16_t>(words)),
                 std::invalid_argument);
}

TEST(Write, AFailureLeavesNothingBehind) {
    const Folder folder;
    const std::vector<std::uint8_t> rgb = noise(std::size_t{3} * width * height);
    const auto png = [&](const std::filesystem::path& file) {
        io::write_png(file, width, height, std::span<const std::uint8_t>(rgb));
    };
    save(folder / "a.png", bytes_of("the picture of yesterday"));
    EXPECT_EQ(status_with_full_disk(folder, [&] { png(folder / "a.png"); }), 0);
    EXPECT_EQ(status_with_full_disk(folder, [&] { write_layers(folder / "b.exr", 1.2345f); }), 0);
    EXPECT_EQ(status_with_full_disk(folder, [&] { io::write_file(folder / "c", Bytes(10000)); }), 0);
    EXPECT_EQ(load(folder / "a.png"), bytes_of("the picture of yesterday"));

    for (const std::filesystem::path& file :
         {folder / "none/a.png", folder / "a.png/b.png", folder.path(), std::filesystem::path("/dev/full"),
          std::filesystem::path("/proc/candela.png")}) {
        const Error error = error_of([&] { png(file); });
        EXPECT_EQ(error.fault(), Fault::input) << error.line();
        EXPECT_EQ(error.where(), file.string());
    }
    EXPECT_EQ(folder.files(), 1u);
}

TEST(Write, ALongNameAndALinkKeepTheirMeaning) {
    const Folder folder;
    const std::string longest(251, 'n');
    io::write_file(folder / (longest + ".png"), Bytes(3));
    EXPECT_EQ(load(folder / (longest + ".png")).size(), 3u);
    std::filesystem::create_directory(folder / "there");
    std::filesystem::create_symlink("there/real", folder / "link");
    io::write_file(folder / "link", Bytes(5));
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
    EXPECT_EQ(load(folder / "there/real").size(), 5u);
    EXPECT_EQ(folder.files(), 3u);
}
