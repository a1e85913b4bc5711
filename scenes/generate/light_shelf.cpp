#include <cmath>
#include <glm/trigonometric.hpp>
#include <span>
#include <sstream>

#include "candela/io/image_write.hpp"
#include "demo_scenes.hpp"
#include "gltf_document.hpp"
#include "shading/lights/units.glsl"
#include "stage_file.hpp"

namespace candela::scenes {
namespace {

using nlohmann::json;

constexpr int columns = 4;
constexpr int rows = 3;
constexpr float cell_m = 1.0f;
constexpr float depth_m = 0.8f;
constexpr float board_m = 0.04f;

/// Middle of a cell's floor at the back wall; x to the right, y up.
glm::vec3 cell(int index) {
    const auto column = static_cast<float>(index % columns);
    const auto row = static_cast<float>(rows - 1 - index / columns);
    return {(column - 0.5f * (columns - 1)) * (cell_m + board_m), row * (cell_m + board_m) + board_m, 0.0f};
}

json place(int index, const glm::vec3& in_cell) {
    return to_json(cell(index) + in_cell);
}

/// A recessed downlight with a batwing web: 1200 lm in the shape of cos^3 with a dip below.
std::string downlight_ies() {
    std::ostringstream text;
    text << "IESNA:LM-63-2002\n[TEST] computed, not measured\n[MANUFAC] Candela\n[LUMINAIRE] batwing "
            "downlight\n"
            "TILT=NONE\n1 1200 1 37 1 1 2 0.15 0 0\n1 1 14\n";
    for (int a = 0; a <= 90; a += 5) text << a << (a < 90 ? " " : "");
    for (int a = 95; a <= 180; a += 5) text << ' ' << a;
    text << "\n0\n";
    // cos^3 (1 - 0.6 cos^8): its integral over the sphere is 2 pi (1/4 - 0.6/12) = 0.4 pi.
    for (int a = 0; a <= 180; a += 5) {
        const float c = a < 90 ? std::cos(glm::radians(static_cast<float>(a))) : 0.0f;
        text << 1200.0f / (0.4f * shading::PI) * c * c * c * (1.0f - 0.6f * std::pow(c, 8.0f))
             << (a % 50 == 45 ? "\n" : " ");
    }
    return text.str();
}

/// What glTF has no carrier for, or what is to be shown in the stage's own words.
json stage_lights() {
    const glm::vec3 top(0.0f, 0.86f, 0.40f);
    const json down = {0, -1, 0};
    return {
        {{"name", "frustum, 300 cd"},
         {"type", "frustum"},
         {"intensity_cd", 300},
         {"temperature_k", 6500},
         {"position", place(2, top)},
         {"direction", down},
         {"right", {1, 0, 0}},
         {"horizontal_angle_deg", 60},
         {"vertical_angle_deg", 35}},
        {{"name", "line, 900 lm"},
         {"type", "line"},
         {"power_lm", 900},
         {"temperature_k", 4000},
         {"length_m", 0.7},
         {"position", place(3, top)},
         {"direction", down},
         {"right", {1, 0, 0}}},
        {{"name", "photometric, 1200 lm"},
         {"type", "point"},
         {"profile", "downlight.ies"},
         {"temperature_k", 3000},
         {"position", place(4, top)},
         {"direction", down},
         {"right", {1, 0, 0}}},
        {{"name", "sphere, 800 lm"},
         {"type", "sphere"},
         {"power_lm", 800},
         {"temperature_k", 2700},
         {"radius_m", 0.09},
         {"position", place(5, {0.0f, 0.72f, 0.36f})}},
        {{"name", "disk, 600 lm"},
         {"type", "disk"},
         {"power_lm", 600},
         {"temperature_k", 4000},
         {"radius_m", 0.12},
         {"position", place(6, {-0.1f, 0.84f, 0.36f})},
         {"direction", {0.35, -1, 0}}},
        {{"name", "rectangle, 900 lm"},
         {"type", "rectangle"},
         {"power_lm", 900},
         {"temperature_k", 5000},
         {"width_m", 0.6},
         {"height_m", 0.16},
         {"position", place(7, {0.0f, 0.84f, 0.18f})},
         {"direction", {0, -1, 0.35}},
         {"right", {1, 0, 0}}},
        {{"name", "tube, 1000 lm"},
         {"type", "tube"},
         {"power_lm", 1000},
         {"temperature_k", 6500},
         {"radius_m", 0.02},
         {"length_m", 0.6},
         {"position", place(8, {0.0f, 0.74f, 0.34f})},
         {"direction", down},
         {"right", {1, 0.25, 0}}},
        {{"name", "two-sided rectangle, EV 12"},
         {"type", "rectangle"},
         {"ev100", 12},
         {"color", {0.55, 0.8, 1.0}},
         {"width_m", 0.3},
         {"height_m", 0.3},
         {"two_sided", true},
         {"position", place(10, {0.02f, 0.5f, 0.3f})},
         {"direction", {1, 0, 0.4}}},
        {{"name", "sphere of 60 W, 14 lm/W"},
         {"type", "sphere"},
         {"power_w", 60},
         {"efficacy_lm_per_w", 14},
         {"temperature_k", 2400},
         {"radius_m", 0.03},
         {"position", place(11, {0.0f, 0.55f, 0.34f})},
         {"range_m", 6}},
        {{"name", "low sun, 100 lx"},
         {"type", "sun"},
         {"illuminance_lx", 100},
         {"temperature_k", 3200},
         {"angular_diameter_deg", 2},
         {"direction", {-0.62, -0.38, -0.69}}},
    };
}

void add_gltf_lights(GltfDocument& scene) {
    const glm::vec3 top(0.0f, 0.80f, 0.40f);
    LightSource bulb{
        .name = "point, 800 lm", .type = "point", .intensity = shading::point_cd_from_lm(800.0f)};
    bulb.kelvin = 2700.0f;
    bulb.at_m = cell(0) + top;
    LightSource spot{.name = "spot, 500 cd", .type = "spot", .intensity = 500.0f, .kelvin = 4000.0f};
    spot.at_m = cell(1) + glm::vec3(-0.2f, 0.92f, 0.55f);
    spot.towards_m = cell(1) + glm::vec3(0.05f, 0.1f, 0.35f);
    spot.inner_cone_rad = glm::radians(16.0f);
    spot.outer_cone_rad = glm::radians(26.0f);
    LightSource moon{
        .name = "directional, 8 lx", .type = "directional", .intensity = 8.0f, .kelvin = 8000.0f};
    moon.at_m = {2.0f, 3.0f, 4.0f};
    moon.towards_m = {0.0f, 0.5f, 0.0f};
    for (const LightSource& light : {bulb, spot, moon}) scene.light(light);
}

void add_shelf(GltfDocument& scene) {
    const int wall = scene.material(simple_material("limewash", {0.62f, 0.60f, 0.56f}, 0.0f, 0.9f));
    const int board = scene.material(simple_material("oak", {0.28f, 0.17f, 0.09f}, 0.0f, 0.45f));
    const float width_m = columns * (cell_m + board_m) + board_m;
    const float height_m = rows * (cell_m + board_m) + board_m;
    scene.place("back", box({width_m, height_m, board_m}), wall, {{0.0f, 0.5f * height_m, -0.5f * board_m}});
    for (int r = 0; r <= rows; ++r) {
        const float y = static_cast<float>(r) * (cell_m + board_m) + 0.5f * board_m;
        scene.place("board", box({width_m, board_m, depth_m}), board, {{0.0f, y, 0.5f * depth_m}});
    }
    for (int c = 0; c <= columns; ++c) {
        const float x = (static_cast<float>(c) - 0.5f * columns) * (cell_m + board_m);
        scene.place("upright", box({board_m, height_m, depth_m}), wall,
                    {{x, 0.5f * height_m, 0.5f * depth_m}});
    }
    scene.place("floor", ground(12.0f, 5.0f), wall, {{0.0f, 0.0f, 2.0f}});
}

}  // namespace

// A shelf whose cells hold a light of every type, with its strength in the unit it is sold in.
void write_light_shelf(const std::filesystem::path& folder) {
    GltfDocument scene("light_shelf");
    add_shelf(scene);
    const int gold = scene.material(simple_material("satin brass", {0.91f, 0.78f, 0.42f}, 1.0f, 0.28f));
    const int lacquer = scene.material(simple_material("black lacquer", {0.02f, 0.02f, 0.022f}, 0.0f, 0.12f));
    const int plaster = scene.material(simple_material("plaster", {0.7f, 0.7f, 0.7f}, 0.0f, 0.8f));
    const int balls[] = {scene.mesh("brass ball", sphere(0.14f, 48, 24), gold),
                         scene.mesh("lacquer ball", sphere(0.14f, 48, 24), lacquer)};
    const int block = scene.mesh("block", box({0.2f, 0.34f, 0.2f}), plaster);
    for (int i = 0; i < columns * rows; ++i) {
        scene.node("ball", balls[i % 2], {cell(i) + glm::vec3(-0.22f, 0.14f, 0.5f)});
        scene.node("block", block, {cell(i) + glm::vec3(0.2f, 0.17f, 0.38f), {0, 1, 0}, glm::radians(28.0f)});
    }
    const float luminance_nit = 2500.0f;
    scene.place("glowing knot", torus_knot(2, 3, 0.11f, 0.045f, 0.022f, 96, 12),
                scene.material(emissive_material("emissive mesh, 2500 cd/m2", luminance_nit, 3500.0f)),
                {cell(9) + glm::vec3(0.0f, 0.68f, 0.34f)});
    add_gltf_lights(scene);
    scene.camera("main", {0.3f, 1.85f, 6.6f}, {0.0f, 1.5f, 0.0f}, 42.0f);
    scene.save(folder / "light_shelf.glb");
    const std::string ies = downlight_ies();
    io::write_file(folder / "downlight.ies", std::as_bytes(std::span(ies)));
    write_stage(folder / "light_shelf.stage.json",
                {{"environment", {{"none", true}}},
                 {"lights", stage_lights()},
                 {"exposure", manual_exposure(4.0f, 1.0f / 30.0f, 400.0f)}});
}

}  // namespace candela::scenes
