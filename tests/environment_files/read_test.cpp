#include <gtest/gtest.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "candela/io/image_write.hpp"
#include "candela/scene/error.hpp"
#include "reading.hpp"

namespace candela::test {
namespace {

void write_picture(const std::string& file, std::uint32_t width, std::uint32_t height,
                   const std::vector<glm::vec3>& texels) {
    std::array<std::vector<float>, 3> planes;
    for (std::size_t c = 0; c < 3; ++c) {
        for (const glm::vec3& t : texels) planes[c].push_back(t[int(c)]);
    }
    io::write_exr(file, width, height,
                  {{"R", io::PixelType::float32, std::span<const float>(planes[0])},
                   {"G", io::PixelType::float32, std::span<const float>(planes[1])},
                   {"B", io::PixelType::float32, std::span<const float>(planes[2])}},
                  {});
}

void expect_colorful(const scene::Environment& e, const std::string& what) {
    const float texel = 4.0f / float(kSize);
    for (const glm::vec3& d : probes()) {
        const glm::vec3 value = seen(e, d), expected = colorful(d);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(value[c], expected[c], texel)
                << what << ", direction " << d.x << " " << d.y << " " << d.z;
    }
}

Text packed(const Text& data, std::uint32_t packing) {
    if (packing == 3) {
        uLongf size = compressBound(data.size());
        Text out(size, '\0');
        compress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(data.data()),
                 data.size());
        out.resize(size);
        return out;
    }
    Text out(ZSTD_compressBound(data.size()), '\0');
    out.resize(ZSTD_compress(out.data(), out.size(), data.data(), data.size(), 3));
    return out;
}

TEST(ReadKtx2, EveryFormatAndPackingShowsTheSameDirections) {
    for (const std::uint32_t format : {97u, 106u, 109u}) {
        Ktx2 file = ktx_cube(colorful_ahead, format);
        expect_colorful(read_bytes(file.bytes()), "format " + std::to_string(format));
        for (const std::uint32_t packing : {2u, 3u}) {
            Ktx2 small = file;
            small.packing = packing;
            small.unpacked = file.data.size();
            small.data = packed(file.data, packing);
            expect_colorful(read_bytes(small.bytes()), "packing " + std::to_string(packing));
        }
    }
}

TEST(ReadKtx2, SharedExponentsAndSmallFloatsHoldTheirValues) {
    Ktx2 file;
    file.width = file.height = 1;
    file.format = 123;
    for (std::uint32_t face = 0; face < 6; ++face)
        put(file.data, 16u << 27 | 256u | 128u << 9 | 511u << 18, 4);
    const glm::vec3 shared = read_bytes(file.bytes()).luminance_nit[0];
    EXPECT_FLOAT_EQ(shared.x, 1.0f);
    EXPECT_FLOAT_EQ(shared.y, 0.5f);
    EXPECT_FLOAT_EQ(shared.z, 511.0f / 256.0f);
    file.format = 122;
    file.data.clear();
    for (std::uint32_t face = 0; face < 6; ++face)
        put(file.data, 0x3c0u | (0x400u << 11) | (0x1e8u << 22), 4);
    const glm::vec3 small = read_bytes(file.bytes()).luminance_nit[0];
    EXPECT_FLOAT_EQ(small.x, 1.0f);
    EXPECT_FLOAT_EQ(small.y, 2.0f);
    EXPECT_FLOAT_EQ(small.z, 1.25f);
}

TEST(ReadKtx2, CandelasKeysSayTheSpaceAndTheUnit) {
    Ktx2 file = ktx_cube([](const glm::vec3& d) { return 0.5f * colorful(d); });
    file.keys = ktx_key("KTXorientation", Text("rd\0", 3)) + ktx_key("candela.cubeSpace", "direct") +
                ktx_key("candela.nitPerUnit", "2");
    expect_colorful(read_bytes(file.bytes()), "direct");
    io::EnvironmentOptions picture;
    picture.cube_space = scene::CubeSpace::picture;
    const scene::Environment mirrored = read_bytes(file.bytes(), picture);
    EXPECT_NEAR(seen(mirrored, {0, 0, -1}).z, 2.5f, 0.1f) << "the option wins over the file";
}

TEST(ReadDds, LegacyAndDx10CubesShowTheSameDirections) {
    const std::vector<glm::vec3> faces = faces_of(colorful_ahead, kSize);
    for (const auto& [code, dxgi, format] :
         {std::tuple{113u, 0u, 97u}, std::tuple{116u, 0u, 109u}, std::tuple{0x30315844u, 10u, 97u},
          std::tuple{0x30315844u, 2u, 109u}, std::tuple{0x30315844u, 6u, 106u}}) {
        Dds file;
        file.width = file.height = kSize;
        file.four_cc = code;
        file.dxgi = dxgi;
        file.data = pixels(faces, format);
        expect_colorful(read_bytes(file.bytes()),
                        "code " + std::to_string(code) + ", DXGI " + std::to_string(dxgi));
    }
}

TEST(ReadDds, CoarserLevelsBetweenTheFacesArePassedOver) {
    Dds file;
    file.width = file.height = 2;
    file.levels = 2;
    for (std::uint32_t face = 0; face < 6; ++face)
        file.data += pixels(std::vector<glm::vec3>(4, glm::vec3(float(face + 1))), 97) +
                     pixels({glm::vec3(1000.0f)}, 97);
    const scene::Environment e = read_bytes(file.bytes());
    for (const glm::vec3& t : e.luminance_nit) EXPECT_LE(t.x, 6.0f);
    EXPECT_NEAR(seen(e, {1, 0, 0}).x, 1.0f, 0.3f);
    EXPECT_NEAR(seen(e, {0, 0, 1}).x, 6.0f, 0.3f) << "behind: the API's -Z";
}

/// A picture `across` by `down` of faces, each by its place, in the API's order.
void write_cross(const std::string& file, std::uint32_t across, std::uint32_t down,
                 const std::array<std::pair<std::uint32_t, std::uint32_t>, 6>& places,
                 bool back_upside_down) {
    std::vector<glm::vec3> texels(std::size_t{across} * down * kSize * kSize, glm::vec3(99.0f));
    const std::vector<glm::vec3> faces = faces_of(colorful_ahead, kSize);
    for (std::uint32_t face = 0; face < 6; ++face) {
        for (std::uint32_t y = 0; y < kSize; ++y) {
            for (std::uint32_t x = 0; x < kSize; ++x) {
                const bool turned = back_upside_down && face == 5;
                const std::uint32_t u = turned ? kSize - 1 - x : x, v = turned ? kSize - 1 - y : y;
                texels[(std::size_t{places[face].second} * kSize + v) * across * kSize +
                       places[face].first * kSize + u] = faces[(std::size_t{face} * kSize + y) * kSize + x];
            }
        }
    }
    write_picture(file, across * kSize, down * kSize, texels);
}

TEST(ReadPictures, CrossesOfBothKindsAreFoundByTheirSides) {
    const TemporaryFolder folder;
    write_cross(folder / "wide.exr", 4, 3, {{{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {3, 1}}}, false);
    expect_colorful(read(folder / "wide.exr"), "horizontal cross");
    write_cross(folder / "high.exr", 3, 4, {{{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {1, 3}}}, true);
    expect_colorful(read(folder / "high.exr"), "vertical cross");
    io::EnvironmentOptions stretched;
    stretched.layout = io::EnvironmentLayout::equirect;
    EXPECT_EQ(read(folder / "wide.exr", stretched).width, 4 * kSize) << "the option wins over the sides";
}

TEST(ReadPictures, SayHowFarTheyAre) {
    const TemporaryFolder folder;
    constexpr std::uint32_t width = 4, height = 1024;
    write_picture(folder / "a.exr", width, height, std::vector<glm::vec3>(width * height, glm::vec3(1.0f)));
    Text hdr = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1024 +X 4\n";
    for (std::uint32_t i = 0; i < width * height; ++i) hdr += Text("\x80\x80\x80\x81", 4);
    spit(folder / "a.hdr", hdr);
    for (const char* file : {"a.exr", "a.hdr"}) {
        std::vector<double> fractions;
        io::EnvironmentOptions options;
        options.progress = [&](double fraction) { fractions.push_back(fraction); };
        const scene::Environment e = read(folder / file, options);
        EXPECT_NEAR(e.luminance_nit.back().x, 1.0f, 0.01f) << file;
        EXPECT_GE(fractions.size(), 4u) << file;
        EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end())) << file;
        EXPECT_LE(fractions.back(), 1.0) << file;
        EXPECT_GE(fractions.back(), 0.7) << file;
    }
}

TEST(ReadPictures, FacesOfAFolderAndOfAPattern) {
    const std::vector<glm::vec3> faces = faces_of(colorful_ahead, kSize);
    for (const auto& names : {std::array<const char*, 6>{"px", "nx", "py", "ny", "pz", "nz"},
                              std::array<const char*, 6>{"sky_right", "sky_left", "sky_top", "sky_bottom",
                                                         "sky_front", "sky_back"}}) {
        const TemporaryFolder folder;
        for (std::size_t face = 0; face < 6; ++face) {
            const auto first = faces.begin() + std::ptrdiff_t(face * kSize * kSize);
            write_picture(folder / (std::string(names[face]) + ".exr"), kSize, kSize,
                          {first, first + kSize * kSize});
        }
        expect_colorful(read(folder.path().string()), names[0]);
        const bool sky = std::string(names[0]).starts_with("sky");
        expect_colorful(read(folder / (sky ? "sky_{face}.exr" : "{face}.exr")), "pattern");
        std::filesystem::remove(folder / (std::string(names[3]) + ".exr"));
        EXPECT_THROW((void)read(folder.path().string()), Error);
        EXPECT_THROW((void)read(folder / "{face}.exr"), Error);
    }
}

TEST(ReadPictures, OctahedralIsAMapOfTheGroundWithNorthAhead) {
    const std::uint32_t side = 2 * kSize;
    std::vector<glm::vec3> texels;
    for (std::uint32_t y = 0; y < side; ++y) {
        for (std::uint32_t x = 0; x < side; ++x) {
            // Cigolle et al. 2014 of (east, north, up).
            glm::vec2 e(2.0f * (float(x) + 0.5f) / float(side) - 1.0f,
                        1.0f - 2.0f * (float(y) + 0.5f) / float(side));
            const float up = 1.0f - std::abs(e.x) - std::abs(e.y);
            if (up < 0.0f)
                e = {(1.0f - std::abs(e.y)) * (e.x >= 0 ? 1.0f : -1.0f),
                     (1.0f - std::abs(e.x)) * (e.y >= 0 ? 1.0f : -1.0f)};
            texels.push_back(colorful(glm::normalize(glm::vec3(e.x, up, -e.y))));
        }
    }
    const TemporaryFolder folder;
    write_picture(folder / "o.exr", side, side, texels);
    Diagnostics diagnostics;
    expect_colorful(io::read_environment(folder / "o.exr", diagnostics), "octahedral");
    EXPECT_EQ(diagnostics.warnings().size(), 1u) << "a guess is said";
}

/// Debevec's definition of an angular map, and a mirroring sphere by the law of reflection: the direction
/// that a point of the picture shows, or nothing beyond the circle.
std::optional<glm::vec3> seen_in_circle(bool ball, float a, float b) {
    const float r = std::sqrt(a * a + b * b);
    if (r > 1.0f) return std::nullopt;
    if (ball) {
        const glm::vec3 n(a, b, std::sqrt(1.0f - r * r)), view(0.0f, 0.0f, -1.0f);
        return view - 2.0f * glm::dot(view, n) * n;
    }
    const float phi = std::numbers::pi_v<float> * r, k = r > 0.0f ? std::sin(phi) / r : 0.0f;
    return glm::vec3(a * k, b * k, -std::cos(phi));
}

TEST(ReadPictures, AngularMapsAndMirrorBalls) {
    const std::uint32_t side = 4 * kSize;
    for (const bool ball : {false, true}) {
        std::vector<glm::vec3> texels;
        for (std::uint32_t i = 0; i < side * side; ++i) {
            const auto d = seen_in_circle(ball, 2.0f * (float(i % side) + 0.5f) / float(side) - 1.0f,
                                          1.0f - 2.0f * (float(i / side) + 0.5f) / float(side));
            texels.push_back(d ? colorful(*d) : glm::vec3(1.0e6f));
        }
        const TemporaryFolder folder;
        write_picture(folder / "probe.exr", side, side, texels);
        io::EnvironmentOptions options;
        options.layout = ball ? io::EnvironmentLayout::mirror_ball : io::EnvironmentLayout::angular;
        Diagnostics diagnostics;
        const scene::Environment e = io::read_environment(folder / "probe.exr", diagnostics, options);
        expect_colorful(e, ball ? "mirror ball" : "angular map");
        EXPECT_TRUE(diagnostics.warnings().empty());
        for (const glm::vec3& t : e.luminance_nit)
            ASSERT_LT(t.x, 10.0f) << "what is beyond the circle is no light";
    }
    EXPECT_EQ(io::layout_by_name("angular"), io::EnvironmentLayout::angular);
    EXPECT_EQ(io::layout_by_name("mirror-ball"), io::EnvironmentLayout::mirror_ball);
}

TEST(Resample, TheLightOfACircleIsKeptAndASunOfOneTexelSurvives) {
    for (const scene::CircleProjection projection :
         {scene::CircleProjection::angular, scene::CircleProjection::mirror_ball}) {
        constexpr std::uint32_t side = 64;
        std::vector<glm::vec3> texels(side * side, glm::vec3(1.0f));
        const std::uint32_t x = 40, y = 20;
        texels[y * side + x] = glm::vec3(1.0e6f);
        const float a = 2.0f * (float(x) + 0.5f) / side - 1.0f, b = 2.0f * (float(y) + 0.5f) / side - 1.0f;
        const float r = std::sqrt(a * a + b * b);
        const double density = projection == scene::CircleProjection::mirror_ball
                                   ? 4.0
                                   : std::numbers::pi * std::sin(std::numbers::pi * double(r)) / double(r);
        const double sun = 1.0e6 * density * 4.0 / (side * side);
        const glm::dvec3 light = light_of(scene::equirect_from_circle(
            texels, side, projection, scene::equirect_size_of_circle(projection, side)));
        EXPECT_NEAR(light.x / (sun + 4.0 * std::numbers::pi), 1.0, 2e-3);
    }
}

TEST(Resample, TheLightOfACubeIsKeptAndASunOfOneTexelSurvives) {
    for (const std::uint32_t size : {7u, 32u}) {
        for (const auto& [face, x, y] : {std::tuple{0u, 3u, 3u}, std::tuple{2u, 0u, 0u},
                                         std::tuple{2u, size / 2, size / 2}, std::tuple{5u, size - 1, 1u}}) {
            scene::CubeMap cube{size,
                                std::vector<glm::vec3>(std::size_t{6} * size * size, glm::vec3(100.0f))};
            const float sun = 1.6e9f;
            cube.texels[cube.index(face, x, y)] = glm::vec3(sun, 0.5f * sun, 0.25f * sun);
            const scene::Environment e =
                scene::equirect_from_cube(cube, scene::CubeSpace::direct, scene::equirect_size_of_cube(size));
            const double texel = solid_angle_of_cube_texel(x, y, size);
            const glm::dvec3 light = light_of(e);
            EXPECT_NEAR(light.x / (double{sun} * texel + 100.0 * (4.0 * std::numbers::pi - texel)), 1.0, 1e-3)
                << size << " " << face;
            EXPECT_NEAR(light.z / (0.25 * double{sun} * texel + 100.0 * (4.0 * std::numbers::pi - texel)),
                        1.0, 1e-3);
            const glm::vec3 middle = gl_direction(face, x, y, size);
            EXPECT_GT(seen(e, middle).x, 0.2f * sun);
        }
    }
}

TEST(Resample, EvenLightStaysEvenAndAllOfASkyIsKept) {
    scene::CubeMap cube{16, std::vector<glm::vec3>(6 * 16 * 16, glm::vec3(3.0f))};
    const scene::Environment even = scene::equirect_from_cube(cube, scene::CubeSpace::picture, {64, 32});
    for (const glm::vec3& t : even.luminance_nit) EXPECT_NEAR(t.x, 3.0f, 1e-4f);
    cube.texels = faces_of(colorful, 16);
    const glm::dvec3 light = light_of(scene::equirect_from_cube(cube, scene::CubeSpace::direct, {64, 32}));
    glm::dvec3 expected(0.0);
    for (std::uint32_t i = 0; i < cube.texels.size(); ++i)
        expected += glm::dvec3(cube.texels[i]) * solid_angle_of_cube_texel(i % 16, i / 16 % 16, 16);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(light[c] / expected[c], 1.0, 1e-3);
}

}  // namespace
}  // namespace candela::test
