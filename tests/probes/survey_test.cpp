// What is said about where irradiance volumes stand: plain mistakes, and nothing about what may be meant.
#include <gtest/gtest.h>

#include "candela/io/gltf.hpp"
#include "candela/io/stage.hpp"
#include "candela/truth/volume_survey.hpp"
#include "common/contact_scenes.hpp"
#include "common/files.hpp"
#include "demo_scenes.hpp"

using namespace candela;
using namespace candela::test;

namespace {

scene::IrradianceVolume volume(const glm::vec3& middle, const glm::vec3& half_size_m,
                               const glm::ivec3& cells = glm::ivec3(8, 6, 8)) {
    scene::IrradianceVolume v;
    v.world = at(middle);
    v.half_size_m = half_size_m;
    v.cells = cells;
    v.fade_m = 0.25f;
    return v;
}

/// Walls, floor and ceiling of 20 cm about a space of 4 x 3 x 4 m on y = 0; `window_m`: a hole of this half
/// width in one wall.
void add_room(scene::Scene& s, float window_m = 0.0f) {
    const auto wall = [&](const glm::vec3& half_m, const glm::vec3& middle) {
        place(s, box(half_m), at(middle));
    };
    for (const float y : {-0.1f, 3.1f}) wall({2.2f, 0.1f, 2.2f}, {0, y, 0});
    wall({0.1f, 1.5f, 2.2f}, {-2.1f, 1.5f, 0});
    for (const float z : {-2.1f, 2.1f}) wall({2.0f, 1.5f, 0.1f}, {0, 1.5f, z});
    if (window_m == 0.0f) return wall({0.1f, 1.5f, 2.2f}, {2.1f, 1.5f, 0});
    const float beside_m = 0.5f * (2.2f - window_m);
    for (const float side : {-1.0f, 1.0f}) {
        wall({0.1f, 1.5f, beside_m}, {2.1f, 1.5f, side * (window_m + beside_m)});
        const float above_m = 0.5f * (1.5f - window_m);
        wall({0.1f, above_m, window_m}, {2.1f, 1.5f + side * (window_m + above_m), 0});
    }
}

scene::Scene room(float window_m = 0.0f) {
    scene::Scene s;
    s.materials.push_back(grey(0.7f));
    add_room(s, window_m);
    return s;
}

double outside(scene::Scene s, const scene::IrradianceVolume& v) {
    s.irradiance_volumes = {v};
    return truth::survey_volumes(s).outside.front();
}

double uncovered(scene::Scene s, const scene::IrradianceVolume& v) {
    s.irradiance_volumes = {v};
    return truth::survey_volumes(s).uncovered;
}

const scene::IrradianceVolume kFits = volume({0, 1.5f, 0}, {2.0f, 1.5f, 2.0f});

scene::Scene street() {
    scene::Scene s = ground(40.0f);
    for (const float x : {-7.0f, 7.0f})
        for (const float z : {-12.0f, 0.0f, 12.0f}) place(s, box({4.0f, 6.0f, 5.0f}), at({x, 6.0f, z}));
    return s;
}

}  // namespace

TEST(VolumeSurvey, NothingIsSaidOfTheDemoScenes) {
    for (const auto& [write, name] :
         {std::pair{&scenes::write_room, "cornell_room"}, std::pair{&scenes::write_two_rooms, "two_rooms"}}) {
        const TemporaryFolder folder;
        write(folder.path());
        Diagnostics diagnostics;
        scene::Scene s = io::load_gltf(folder / (std::string(name) + ".glb"), {}, diagnostics);
        io::place_stage_probes(io::load_stage(folder / (std::string(name) + ".stage.json")).probes, s);
        const truth::VolumeSurvey survey = truth::survey_volumes(s);
        for (const double share : survey.outside) EXPECT_LT(share, 0.05) << name;
        EXPECT_LT(survey.uncovered, 0.1) << name;
    }
}

TEST(VolumeSurvey, ABoxThatEndsAtTheWallsOrInThemIsRight) {
    EXPECT_EQ(outside(room(), kFits), 0.0);
    EXPECT_EQ(uncovered(room(), kFits), 0.0);
    EXPECT_EQ(outside(room(), volume({0, 1.5f, 0}, {2.15f, 1.65f, 2.15f}, {20, 16, 20})), 0.0);
    EXPECT_EQ(outside(room(0.6f), kFits), 0.0) << "with a window";
}

TEST(VolumeSurvey, ABoxBeyondTheWallsIsFoundInTheVoidAndOnTheGround) {
    // Half of the cells across are beyond the walls.
    const double share = outside(room(), volume({2.0f, 1.5f, 0}, {2.0f, 1.5f, 2.0f}));
    EXPECT_NEAR(share, 0.5, 0.1);
    scene::Scene on_ground = ground(40.0f);
    add_room(on_ground);
    EXPECT_NEAR(outside(on_ground, volume({2.0f, 1.5f, 0}, {2.0f, 1.5f, 2.0f})), 0.5, 0.1);
    // Twice as wide and deep: three quarters are beyond.
    EXPECT_NEAR(outside(on_ground, volume({0, 1.5f, 0}, {4.0f, 1.5f, 4.0f})), 0.75, 0.1);
}

// Walls of one side, open to a camera: the probes beyond see their backs and the sky.
TEST(VolumeSurvey, ABoxBeyondTheWallsOfAStageSetIsFound) {
    const TemporaryFolder folder;
    scenes::write_room(folder.path());
    Diagnostics diagnostics;
    const scene::Scene s = io::load_gltf(folder / "cornell_room.glb", {}, diagnostics);
    EXPECT_GT(outside(s, volume({0, 2.75f, -2.0f}, glm::vec3(2.75f))), 0.2);
}

// Where somebody may well mean it.
TEST(VolumeSurvey, NothingIsSaidWhereItMayBeMeant) {
    EXPECT_EQ(outside(street(), volume({0, 4.0f, 0}, {12.0f, 4.0f, 18.0f})), 0.0)
        << "streets and solid houses";
    EXPECT_EQ(uncovered(street(), volume({0, 2.0f, 0}, {3.0f, 2.0f, 3.0f})), 0.0) << "part of a street";
    scene::Scene open = ground(40.0f);
    EXPECT_EQ(outside(open, volume({0, 2.0f, 0}, {5.0f, 2.0f, 5.0f})), 0.0);
    EXPECT_EQ(outside(room(1.2f), volume({1.0f, 1.5f, 0}, {2.0f, 1.5f, 2.0f})), 0.0)
        << "through a large window onto the terrace";
    scene::Scene flats = room();
    for (std::size_t i = 0, n = flats.instances.size(); i < n; ++i) {
        scene::Instance next = flats.instances[i];
        next.world = at({4.2f, 0, 0}) * next.world;
        flats.instances.push_back(next);
    }
    EXPECT_EQ(outside(flats, volume({2.1f, 1.5f, 0}, {4.1f, 1.5f, 2.0f}, {16, 6, 8})), 0.0)
        << "two closed rooms";
}

TEST(VolumeSurvey, SurfacesThatNoVolumeReachesAreCounted) {
    // A quarter of the room has it all.
    EXPECT_GT(uncovered(room(), volume({-1.0f, 1.5f, -1.0f}, {1.0f, 1.5f, 1.0f})), 0.5);
    EXPECT_NEAR(uncovered(room(), volume({-1.0f, 1.5f, 0}, {1.0f, 1.5f, 2.0f})), 0.45, 0.12);
    scene::Scene s = room();
    s.irradiance_volumes = {volume({-1.0f, 1.5f, 0}, {1.0f, 1.5f, 2.0f}),
                            volume({1.0f, 1.5f, 0}, {1.0f, 1.5f, 2.0f})};
    EXPECT_EQ(truth::survey_volumes(s).uncovered, 0.0) << "two volumes together";
    s.irradiance_volumes.pop_back();
    scene::ReflectionProbe probe;
    probe.world = at({1.0f, 1.5f, 0});
    probe.half_size_m = {1.0f, 1.5f, 2.0f};
    probe.margin_m = probe.fade_m = 0.2f;
    s.reflection_probes = {probe};
    EXPECT_EQ(truth::survey_volumes(s).uncovered, 0.0) << "a reflection probe stands in";
}

TEST(VolumeSurvey, NoVolumeAndNoSurfaceAreNoMistake) {
    EXPECT_TRUE(truth::survey_volumes(room()).outside.empty());
    EXPECT_EQ(outside({}, kFits), 0.0);
    EXPECT_EQ(uncovered({}, kFits), 0.0);
}
