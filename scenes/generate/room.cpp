#include <glm/trigonometric.hpp>

#include "demo_scenes.hpp"
#include "gltf_document.hpp"
#include "shading/lights/units.glsl"
#include "stage_file.hpp"

namespace candela::scenes {
namespace {

constexpr float size_m = 5.5f;
constexpr float panel_m = 1.0f;
constexpr float panel_lm = 4000.0f;  // an office LED panel

}  // namespace

// A room in the manner of the Cornell box, 5.5 m on a side, lit by one panel in the ceiling. Its front is
// open.
void write_room(const std::filesystem::path& folder) {
    GltfDocument scene("cornell_room");
    // Reflectances of the measured Cornell box (Cornell University Program of Computer Graphics), in Rec.709.
    const int white = scene.material(simple_material("white", {0.73f, 0.71f, 0.68f}, 0.0f, 1.0f));
    const int red = scene.material(simple_material("red", {0.63f, 0.065f, 0.05f}, 0.0f, 1.0f));
    const int green = scene.material(simple_material("green", {0.14f, 0.45f, 0.091f}, 0.0f, 1.0f));
    const float luminance_nit = shading::rectangle_nit_from_lm(panel_lm, panel_m, panel_m);
    const int panel = scene.material(emissive_material("panel of 4000 lm", luminance_nit, 4000.0f));

    const float half = 0.5f * size_m, quarter_turn = glm::radians(90.0f);
    const Shape wall = card(size_m, size_m);
    scene.place("floor", ground(size_m, size_m), white);
    scene.place("ceiling", ground(size_m, size_m), white, {{0, size_m, 0}, {1, 0, 0}, 2.0f * quarter_turn});
    scene.place("back wall", wall, white, {{0, half, -half}});
    scene.place("left wall", wall, red, {{-half, half, 0}, {0, 1, 0}, quarter_turn});
    scene.place("right wall", wall, green, {{half, half, 0}, {0, 1, 0}, -quarter_turn});
    scene.place("panel", ground(panel_m, panel_m), panel,
                {{0, size_m - 0.01f, 0}, {1, 0, 0}, 2.0f * quarter_turn});
    scene.place("tall block", box({1.65f, 3.3f, 1.65f}), white,
                {{-0.95f, 1.65f, -0.85f}, {0, 1, 0}, glm::radians(17.0f)});
    scene.place("short block", box({1.65f, 1.65f, 1.65f}), white,
                {{0.95f, 0.825f, 0.85f}, {0, 1, 0}, glm::radians(-17.0f)});
    scene.camera("main", {0.0f, half, half + 8.0f}, {0.0f, half, 0.0f}, 35.0f);
    scene.save(folder / "cornell_room.glb");
    write_stage(folder / "cornell_room.stage.json",
                {{"environment", {{"none", true}}},
                 {"irradiance_volumes",
                  {{{"name", "room"},
                    {"center", {0.0f, half, 0.0f}},
                    {"size_m", {size_m, size_m, size_m}},
                    {"cells", {10, 10, 10}}}}},
                 {"exposure", manual_exposure(2.8f, 1.0f / 15.0f, 400.0f)}});
}

}  // namespace candela::scenes
