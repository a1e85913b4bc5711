// One scene, wherever it stands and however large it is, is one picture in every mode.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "candela/io/image_read.hpp"
#include "cli/process.hpp"
#include "gltf_builder.hpp"

using namespace candela;
using namespace candela::test;

namespace {

/// Two boxes on a floor under a lamp and a sun, `scale` times as large, at `place`.
GltfBuilder boxes(const glm::dvec3& place, double scale) {
    GltfBuilder b;
    std::vector<float> corners, normals;
    std::vector<std::uint16_t> indices;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : {-0.5f, 0.5f}) {
            const auto first = static_cast<std::uint16_t>(corners.size() / 3);
            for (int i = 0; i < 4; ++i) {
                glm::vec3 p;
                p[axis] = side;
                p[(axis + 1) % 3] = i == 1 || i == 2 ? 0.5f : -0.5f;
                p[(axis + 2) % 3] = i >= 2 ? 0.5f : -0.5f;
                glm::vec3 n(0.0f);
                n[axis] = 2.0f * side;
                corners.insert(corners.end(), {p.x, p.y, p.z});
                normals.insert(normals.end(), {n.x, n.y, n.z});
            }
            for (const int i : side > 0.0f ? std::array{0, 1, 2, 0, 2, 3} : std::array{0, 2, 1, 0, 3, 2})
                indices.push_back(static_cast<std::uint16_t>(first + i));
        }
    }
    const int position = b.accessor<float>(corners, "VEC3", 3),
              normal = b.accessor<float>(normals, "VEC3", 3);
    b.push("materials",
           {{"pbrMetallicRoughness",
             {{"baseColorFactor", {0.7, 0.4, 0.3, 1}}, {"metallicFactor", 0}, {"roughnessFactor", 0.5}}}});
    b.push("meshes", {{"primitives",
                       {{{"attributes", {{"POSITION", position}, {"NORMAL", normal}}},
                         {"indices", b.accessor<std::uint16_t>(indices, "SCALAR", 1)},
                         {"material", 0}}}}});
    b.doc["extensionsUsed"] = {"KHR_lights_punctual"};
    b.doc["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "point"}, {"intensity", std::min(500.0 * scale * scale, 1e14)}},
        {{"type", "directional"}, {"intensity", 200}}};
    b.push("nodes", {{"mesh", 0}, {"translation", {0, -0.55, 0}}, {"scale", {6, 0.1, 6}}});
    b.push("nodes", {{"mesh", 0}});
    b.push("nodes", {{"mesh", 0}, {"translation", {1.2, -0.1, 0.8}}, {"scale", {0.8, 0.8, 0.8}}});
    const bool lamp = scale < 1e5;  // beyond, its candela would pass what a file may state
    b.push("nodes", {{"translation", {-1.5, 2, 1.5}},
                     {"extensions", {{"KHR_lights_punctual", {{"light", lamp ? 0 : 1}}}}}});
    b.push("nodes", {{"rotation", {-std::sin(0.6), 0, 0, std::cos(0.6)}},
                     {"extensions", {{"KHR_lights_punctual", {{"light", 1}}}}}});
    b.push("nodes", {{"children", {0, 1, 2, 3, 4}},
                     {"translation", {place.x, place.y, place.z}},
                     {"scale", {scale, scale, scale}}});
    b.doc["scenes"] = {{{"nodes", {5}}}};
    return b;
}

struct Picture {
    io::FloatImage image;
    std::vector<double> luminance;
};

Picture rendered(const GltfBuilder& b, const std::string& options) {
    const TemporaryFolder folder;
    spit(folder / "a.glb", b.glb());
    const Outcome run = run_candela("render " + (folder / "a.glb") + " --size 64x36 --ev100 8 -o " +
                                    (folder / "a.exr") + " --exr-type float " + options);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    Picture out{io::read_exr(folder / "a.exr"), {}};
    const auto &r = *out.image.find("R"), &g = *out.image.find("G"), &blue = *out.image.find("B");
    for (std::size_t i = 0; i < r.size(); ++i) {
        out.luminance.push_back(0.2126 * static_cast<double>(r[i]) + 0.7152 * static_cast<double>(g[i]) +
                                0.0722 * static_cast<double>(blue[i]));
    }
    return out;
}

/// Mean absolute difference over the mean.
double difference(const Picture& a, const Picture& b) {
    double sum = 0.0, off = 0.0;
    for (std::size_t i = 0; i < a.luminance.size(); ++i) {
        sum += a.luminance[i];
        off += std::abs(a.luminance[i] - b.luminance[i]);
    }
    EXPECT_GT(sum, 0.0);
    return off / sum;
}

class InEveryMode : public testing::TestWithParam<const char*> {};

}  // namespace

TEST_P(InEveryMode, FarScenesAreThePictureOfNearOnes) {
    const Picture near = rendered(boxes(glm::dvec3(0.0), 1.0), GetParam());
    for (const glm::dvec3& place :
         {glm::dvec3(5e4, 0, 0), glm::dvec3(500000, 0, 5e6), glm::dvec3(1e7, 1e7, 1e7)})
        EXPECT_LT(difference(near, rendered(boxes(place, 1.0), GetParam())), 0.01) << place.x;
}

TEST_P(InEveryMode, ScenesOfAnySizeAreOnePicture) {
    const Picture ordinary = rendered(boxes(glm::dvec3(0.0), 1.0), GetParam());
    for (const double scale : {1e-8, 1e-4, 1e-2, 1e4})
        EXPECT_LT(difference(ordinary, rendered(boxes(glm::dvec3(0.0), scale), GetParam())), 0.01) << scale;
    const Picture large = rendered(boxes(glm::dvec3(0.0), 1e5), GetParam());
    for (const double scale : {1e6, 1e9})
        EXPECT_LT(difference(large, rendered(boxes(glm::dvec3(0.0), scale), GetParam())), 0.01) << scale;
    // What the lamp adds aside, a sun and its shadows are the same.
    EXPECT_LT(difference(large, ordinary), 1.0);
}

INSTANTIATE_TEST_SUITE_P(Place, InEveryMode,
                         testing::Values("--spp 1", "--mode integrate --spp 1",
                                         "--mode path --spp 2 --max-bounces 2"));

TEST(PlaceRender, DepthAndMeterAreInMetresOfTheWorld) {
    const std::string options = "--spp 1 --aov depth";
    const Picture ordinary = rendered(boxes(glm::dvec3(0.0), 1.0), options);
    const Picture tiny = rendered(boxes({300, 0, 0}, 1e-6), options);
    const auto &a = *ordinary.image.find("depth.Z"), &b = *tiny.image.find("depth.Z");
    const std::size_t middle = 18 * 64 + 32;
    EXPECT_GT(a[middle], 1.0f);
    EXPECT_NEAR(b[middle] / a[middle], 1e-6f, 1e-9f);

    const TemporaryFolder folder;
    spit(folder / "a.glb", boxes({500000, 0, 5e6}, 1.0).glb());
    const auto lux = [&](const char* at) {
        const Outcome run =
            run_candela("meter " + (folder / "a.glb") + " --json --mode path --spp 1 --at " + at);
        EXPECT_EQ(run.exit_code, 0) << run.err;
        return json::parse(run.out)["illuminance_lx"].get<double>();
    };
    // Above everything: the sun's 200 lx and the lamp's 500 cd.
    const double to_lamp_m2 = 1.5 * 1.5 + 0.5 * 0.5 + 1.5 * 1.5;
    const double sun = 200.0 * std::sin(1.2);
    EXPECT_NEAR(lux("500000,1.5,5000000"), sun + 500.0 / to_lamp_m2 * 0.5 / std::sqrt(to_lamp_m2), 1.0);
    const json info = json::parse(run_candela("info --json " + (folder / "a.glb")).out)["scene"];
    EXPECT_NEAR(info["bounds_m"][0][2].get<double>(), 5e6 - 3.0, 1e-6);
    EXPECT_NEAR(info["lights"][0]["position"][0].get<double>(), 500000.0 - 1.5, 1e-6);
}
