#include <png.h>
#include <sys/resource.h>

#include "candela/io/image_read.hpp"
#include "encoders.hpp"

using namespace candela;
using namespace candela::tests;

namespace {

std::array<int, 4> texel(const scene::Image& image, std::uint32_t x, std::uint32_t y) {
    const std::uint8_t* t = image.rgba.data() + 4 * (std::size_t{y} * image.width + x);
    return {t[0], t[1], t[2], t[3]};
}

using Texel = std::array<int, 4>;

std::vector<std::uint8_t> gradient(std::uint32_t width, std::uint32_t height, std::size_t components) {
    std::vector<std::uint8_t> out;
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            for (std::size_t c = 0; c < components; ++c)
                out.push_back(static_cast<std::uint8_t>(40 + 3 * x + 2 * y + 20 * c));
        }
    }
    return out;
}

void store_be32(Bytes& bytes, std::size_t at, std::uint32_t value) {
    for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = std::byte(value >> (24 - 8 * i));
}

std::uint32_t crc32_of(const Bytes& bytes, std::size_t first, std::size_t count) {
    std::uint32_t crc = ~0u;
    for (std::size_t i = first; i < first + count; ++i) {
        crc ^= std::to_integer<std::uint32_t>(bytes[i]);
        for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0xedb88320u : 0u);
    }
    return ~crc;
}

/// The same picture with another size in its header, checksum right.
Bytes claim_png(Bytes png, std::uint32_t width, std::uint32_t height) {
    store_be32(png, 16, width);
    store_be32(png, 20, height);
    store_be32(png, 29, crc32_of(png, 12, 17));
    return png;
}

long peak_kib() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
}

}  // namespace

TEST(DecodePng, EveryKindOfPixelBecomesRgba8) {
    const auto decode = [](const PngKind& kind, const std::vector<std::uint8_t>& rows) {
        return io::decode_image(encode_png(kind, rows), "test");
    };
    const auto grey1 = decode({3, 1, 1, PNG_COLOR_TYPE_GRAY, false, {}, {}}, {0b01000000});
    EXPECT_EQ(texel(grey1, 0, 0), (Texel{0, 0, 0, 255}));
    EXPECT_EQ(texel(grey1, 1, 0), (Texel{255, 255, 255, 255}));
    const auto clear_grey = decode({2, 1, 8, PNG_COLOR_TYPE_GRAY, false, {}, {77}}, {77, 78});
    EXPECT_EQ(texel(clear_grey, 0, 0), (Texel{77, 77, 77, 0}));
    EXPECT_EQ(texel(clear_grey, 1, 0), (Texel{78, 78, 78, 255}));
    const auto grey_alpha = decode({1, 1, 8, PNG_COLOR_TYPE_GRAY_ALPHA, false, {}, {}}, {10, 20});
    EXPECT_EQ(texel(grey_alpha, 0, 0), (Texel{10, 10, 10, 20}));
    const auto palette =
        decode({2, 1, 4, PNG_COLOR_TYPE_PALETTE, false, {1, 2, 3, 40, 50, 60}, {255, 128}}, {0x01});
    EXPECT_EQ(texel(palette, 0, 0), (Texel{1, 2, 3, 255}));
    EXPECT_EQ(texel(palette, 1, 0), (Texel{40, 50, 60, 128}));
    const auto rgb = decode({1, 1, 8, PNG_COLOR_TYPE_RGB, false, {}, {}}, {9, 8, 7});
    EXPECT_EQ(texel(rgb, 0, 0), (Texel{9, 8, 7, 255}));
    const auto rgba16 = decode({1, 1, 16, PNG_COLOR_TYPE_RGB_ALPHA, false, {}, {}},
                               {0xff, 0xff, 0x80, 0x80, 0x00, 0xff, 0x00, 0x00});
    EXPECT_EQ(texel(rgba16, 0, 0), (Texel{255, 128, 1, 0})) << "0x00ff rounds to 1, not down to 0";
}

TEST(DecodePng, InterlacedIsTheSameAsNot) {
    const auto rows = gradient(21, 13, 4);
    PngKind kind{21, 13, 8, PNG_COLOR_TYPE_RGB_ALPHA, false, {}, {}};
    const auto plain = io::decode_image(encode_png(kind, rows), "test");
    kind.interlaced = true;
    EXPECT_EQ(plain.rgba, rows);
    EXPECT_EQ(io::decode_image(encode_png(kind, rows), "test").rgba, rows);
}

TEST(DecodeJpeg, ColourGreyAndProgressiveAreCloseToTheOriginal) {
    for (const bool progressive : {false, true}) {
        for (const int components : {1, 3}) {
            const auto texels = gradient(33, 17, static_cast<std::size_t>(components));
            const auto image =
                io::decode_image(encode_jpeg({33, 17, components, false, progressive}, texels), "test");
            ASSERT_EQ(image.width, 33u);
            ASSERT_EQ(image.height, 17u);
            for (std::uint32_t i = 0; i < 33 * 17; ++i) {
                for (std::size_t c = 0; c < 3; ++c) {
                    const std::size_t source = components == 1 ? i : 3 * i + c;
                    ASSERT_NEAR(image.rgba[4 * i + c], texels[source], 5);
                }
                ASSERT_EQ(image.rgba[4 * i + 3], 255);
            }
        }
    }
}

TEST(DecodeJpeg, InksBecomeColoursWithAndWithoutAdobesInversion) {
    const std::vector<std::uint8_t> cyan(64 * 4, 0);
    std::vector<std::uint8_t> ink = cyan;
    for (std::size_t i = 0; i < ink.size(); i += 4) ink[i] = 255;
    const auto plain = io::decode_image(encode_jpeg({8, 8, 4, false, false}, ink), "test");
    EXPECT_NEAR(texel(plain, 3, 3)[0], 0, 2);
    EXPECT_NEAR(texel(plain, 3, 3)[1], 255, 2);
    for (std::uint8_t& i : ink) i = static_cast<std::uint8_t>(255 - i);
    const auto adobe = io::decode_image(encode_jpeg({8, 8, 4, true, false}, ink), "test");
    EXPECT_NEAR(texel(adobe, 3, 3)[0], 0, 2);
    EXPECT_NEAR(texel(adobe, 3, 3)[2], 255, 2);
    EXPECT_EQ(texel(adobe, 3, 3)[3], 255);
}

TEST(DecodeWebp, LosslessComesBackExactly) {
    auto texels = gradient(19, 23, 4);
    for (std::size_t i = 3; i < texels.size(); i += 4) texels[i] = 255;
    EXPECT_EQ(io::decode_image(encode_webp(19, 23, texels), "test").rgba, texels);
}

TEST(Decode, EveryTruncationIsAnErrorThatNamesTheSource) {
    const auto rgba = gradient(40, 30, 4);
    const std::vector<Bytes> pictures{encode_png({40, 30, 8, PNG_COLOR_TYPE_RGB_ALPHA, false, {}, {}}, rgba),
                                      encode_jpeg({40, 30, 3, false, false}, gradient(40, 30, 3)),
                                      encode_jpeg({40, 30, 3, false, true}, gradient(40, 30, 3)),
                                      encode_webp(40, 30, rgba)};
    for (const Bytes& whole : pictures) {
        for (std::size_t length = 0; length < whole.size(); ++length) {
            const Bytes part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length));
            const Error error = error_of([&] { (void)io::decode_image(part, "scene.glb: /images/0"); });
            ASSERT_EQ(error.fault(), Fault::input);
            ASSERT_EQ(error.where(), "scene.glb: /images/0") << length << " of " << whole.size();
        }
    }
}

TEST(Decode, FlippedBytesNeverDoMoreThanThrow) {
    const auto rgba = gradient(24, 24, 4);
    const std::vector<Bytes> pictures{encode_png({24, 24, 8, PNG_COLOR_TYPE_RGB_ALPHA, true, {}, {}}, rgba),
                                      encode_jpeg({24, 24, 3, false, true}, gradient(24, 24, 3)),
                                      encode_webp(24, 24, rgba)};
    for (const Bytes& whole : pictures) {
        for (std::size_t at = 12; at < whole.size(); ++at) {
            Bytes broken = whole;
            broken[at] ^= std::byte{0x5a};
            try {
                const auto image = io::decode_image(broken, "test");
                EXPECT_EQ(image.rgba.size(), std::size_t{4} * image.width * image.height);
            } catch (const Error& error) {
                EXPECT_EQ(error.fault(), Fault::input);
            }
        }
    }
}

TEST(Decode, AHugeHeaderIsRefusedBeforeMemoryIsTaken) {
    const Bytes small = encode_png({8, 8, 8, PNG_COLOR_TYPE_RGB, false, {}, {}}, gradient(8, 8, 3));
    Bytes jpeg = encode_jpeg({8, 8, 1, false, false}, gradient(8, 8, 1));
    for (std::size_t i = 0; i + 8 < jpeg.size(); ++i) {
        const bool frame = jpeg[i] == std::byte{0xff} && jpeg[i + 1] == std::byte{0xc0};
        if (frame) store_be32(jpeg, i + 5, 0x3fff3fff);
    }
    std::vector<std::uint8_t> flat(std::size_t{5000} * 5000 * 4, 200);
    const Bytes webp = encode_webp(5000, 5000, flat);
    flat.clear();
    flat.shrink_to_fit();
    ASSERT_LT(webp.size(), 2000u) << "the point is a picture that is honest and flat";
    const long before = peak_kib();
    EXPECT_STREQ(error_of([&] { (void)io::decode_image(claim_png(small, 100000, 100000), "x"); }).what(),
                 "the picture is too large: 100000 x 100000");
    for (const Bytes& bytes : {claim_png(small, 16384, 16384), claim_png(small, 2000, 2000), jpeg, webp}) {
        const Error error = error_of([&] { (void)io::decode_image(bytes, "x"); });
        EXPECT_NE(std::string(error.what()).find("claims a larger picture"), std::string::npos)
            << error.what();
    }
    EXPECT_LT(peak_kib() - before, 4096);
}

TEST(Decode, WhatIsNoPictureSaysSo) {
    EXPECT_STREQ(error_of([] { (void)io::decode_image(bytes_of("GIF89a"), "x"); }).what(),
                 "not a PNG, JPEG or WebP picture: a GIF picture");
    EXPECT_STREQ(error_of([] { (void)io::decode_image({}, "x"); }).what(), "the picture is empty");
}

TEST(ReadFile, MissingFoldersDevicesAndLargeFilesAreInputErrors) {
    const Folder folder;
    EXPECT_STREQ(error_of([&] { (void)io::read_file(folder / "none", 10); }).what(), "no such file");
    EXPECT_STREQ(error_of([&] { (void)io::read_file(folder.path(), 10); }).what(), "is a folder, not a file");
    EXPECT_STREQ(error_of([&] { (void)io::read_file("/dev/zero", 10); }).what(), "is not a regular file");
    save(folder / "eleven", Bytes(11));
    EXPECT_EQ(io::read_file(folder / "eleven", 11).size(), 11u);
    const Error large = error_of([&] { (void)io::read_file(folder / "eleven", 10); });
    EXPECT_EQ(large.fault(), Fault::input);
    EXPECT_STREQ(large.what(), "the file is too large: 11 bytes");
}

TEST(DecodedBytes, AreKnownFromTheHeader) {
    const auto expect = [](const Bytes& bytes) {
        EXPECT_EQ(io::decoded_bytes(bytes), io::decode_image(bytes, "test").rgba.size());
    };
    expect(encode_png({13, 7, 8, PNG_COLOR_TYPE_RGB}, gradient(13, 7, 3)));
    expect(encode_jpeg({17, 9, 3}, gradient(17, 9, 3)));
    expect(encode_jpeg({17, 9, 1, true, true}, gradient(17, 9, 1)));
    expect(encode_webp(5, 6, gradient(5, 6, 4)));
    Bytes png = encode_png({13, 7, 8, PNG_COLOR_TYPE_RGB}, gradient(13, 7, 3));
    EXPECT_EQ(io::decoded_bytes(claim_png(png, 4096, 16384)), std::uint64_t{4} * 4096 * 16384);
    png.resize(20);
    EXPECT_EQ(io::decoded_bytes(png), 0u);
    EXPECT_EQ(io::decoded_bytes({}), 0u);
}
