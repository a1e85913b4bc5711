#include <glm/trigonometric.hpp>

#include "demo_scenes.hpp"
#include "gltf_document.hpp"
#include "shading/lights/units.glsl"
#include "stage_file.hpp"

namespace candela::scenes {
namespace {

// Both rooms: x from wall to wall, mirrored; a wall of this thickness with a doorway stands between them.
constexpr float kWidth_m = 4.0f, kHeight_m = 2.8f, kDepth_m = 5.0f, kWall_m = 0.2f;
constexpr float kDoor_m = 1.4f, kDoorHeight_m = 2.1f;
constexpr float kPanel_m = 0.6f;

void add_shell(GltfDocument& scene, float side, int wall, int ceiling) {
    const float middle = side * 0.5f * (kWidth_m + kWall_m);
    const float out = 0.5f * kWall_m;
    scene.place("ceiling", box({kWidth_m, kWall_m, kDepth_m}), ceiling, {{middle, kHeight_m + out, 0}});
    scene.place("end wall", box({kWall_m, kHeight_m, kDepth_m}), wall,
                {{side * (kWidth_m + kWall_m), 0.5f * kHeight_m, 0}});
    for (const float z : {-1.0f, 1.0f}) {
        scene.place("side wall", box({kWidth_m, kHeight_m, kWall_m}), wall,
                    {{middle, 0.5f * kHeight_m, z * (0.5f * kDepth_m + out)}});
    }
}

void add_wall_between(GltfDocument& scene, int material) {
    const float part = 0.5f * (kDepth_m - kDoor_m);
    for (const float z : {-1.0f, 1.0f}) {
        scene.place("wall between", box({kWall_m, kHeight_m, part}), material,
                    {{0, 0.5f * kHeight_m, z * 0.5f * (kDoor_m + part)}});
    }
    const float lintel = kHeight_m - kDoorHeight_m;
    scene.place("lintel", box({kWall_m, lintel, kDoor_m}), material, {{0, kDoorHeight_m + 0.5f * lintel, 0}});
}

void add_panel(GltfDocument& scene, float side, float power_lm, float kelvin) {
    const int panel = scene.material(
        emissive_material("panel", shading::rectangle_nit_from_lm(power_lm, kPanel_m, kPanel_m), kelvin));
    scene.place(
        "panel", ground(kPanel_m, kPanel_m), panel,
        {{side * 0.5f * (kWidth_m + kWall_m), kHeight_m - 0.01f, 0}, {1, 0, 0}, glm::radians(180.0f)});
}

/// The box of a room, `into_wall_m` longer towards the other one.
nlohmann::json room_box(const std::string& name, float side, float into_wall_m) {
    const float from = 0.5f * kWall_m - into_wall_m;
    return {{"name", name},
            {"center", {side * 0.5f * (from + 0.5f * kWall_m + kWidth_m), 0.5f * kHeight_m, 0.0f}},
            {"size_m", {kWidth_m + into_wall_m, kHeight_m, kDepth_m}}};
}

}  // namespace

// Two rooms with one polished floor, a bright warm one and a dim cool one, and a doorway between them: each
// with a reflection probe and an irradiance volume of its own. Nothing of the sky gets in.
void write_two_rooms(const std::filesystem::path& folder) {
    GltfDocument scene("two_rooms");
    const int warm = scene.material(simple_material("warm plaster", {0.72f, 0.6f, 0.48f}, 0.0f, 0.9f));
    const int cool = scene.material(simple_material("cool plaster", {0.45f, 0.56f, 0.68f}, 0.0f, 0.9f));
    const int white = scene.material(simple_material("white", {0.8f, 0.8f, 0.78f}, 0.0f, 0.9f));
    const int floor = scene.material(simple_material("polished stone", {0.2f, 0.18f, 0.17f}, 0.0f, 0.2f));
    const int gold = scene.material(simple_material("gold", {1.0f, 0.77f, 0.34f}, 1.0f, 0.25f));
    const int steel = scene.material(simple_material("steel", {0.56f, 0.57f, 0.58f}, 1.0f, 0.4f));
    const int red = scene.material(simple_material("red lacquer", {0.6f, 0.03f, 0.03f}, 0.0f, 0.3f));
    add_shell(scene, -1.0f, warm, white);
    add_shell(scene, 1.0f, cool, white);
    add_wall_between(scene, white);
    scene.place("floor", box({2.0f * kWidth_m + 3.0f * kWall_m, kWall_m, kDepth_m + 2.0f * kWall_m}), floor,
                {{0, -0.5f * kWall_m, 0}});
    add_panel(scene, -1.0f, 3000.0f, 4500.0f);
    add_panel(scene, 1.0f, 800.0f, 7500.0f);
    scene.place("gold ball", sphere(0.35f, 64, 32), gold, {{-1.6f, 0.35f, -0.9f}});
    scene.place("steel ball", sphere(0.3f, 64, 32), steel, {{1.5f, 0.3f, -0.2f}});
    scene.place("red block", box({0.5f, 0.9f, 0.5f}), red,
                {{-2.9f, 0.45f, -1.4f}, {0, 1, 0}, glm::radians(25.0f)});
    scene.camera("main", {-3.7f, 1.5f, 1.9f}, {0.1f, 0.75f, -0.5f}, 24.0f);
    scene.save(folder / "two_rooms.glb");

    nlohmann::json probes = nlohmann::json::array();
    nlohmann::json volumes = nlohmann::json::array();
    for (const float side : {-1.0f, 1.0f}) {
        const std::string name = side < 0.0f ? "warm room" : "cool room";
        nlohmann::json probe = room_box(name, side, 0.0f);
        // Both reach through the doorway, so that one is whole before the other begins to fade.
        probe["margin_m"] = 2.0f * kWall_m;
        probe["fade_m"] = kWall_m;
        probes.push_back(probe);
        nlohmann::json volume = room_box(name, side, 0.5f * kWall_m);
        volume["cells"] = {8, 6, 10};
        volumes.push_back(volume);
    }
    write_stage(folder / "two_rooms.stage.json", {{"environment", {{"none", true}}},
                                                  {"reflection_probes", probes},
                                                  {"irradiance_volumes", volumes},
                                                  {"exposure", manual_exposure(2.8f, 1.0f / 15.0f, 400.0f)}});
}

}  // namespace candela::scenes
