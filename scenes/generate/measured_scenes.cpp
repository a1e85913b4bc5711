// Scenes whose numbers are known beforehand: what a meter or a pixel must read is computed here by hand.
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "demo_scenes.hpp"
#include "gltf_document.hpp"
#include "shading/lights/punctual.glsl"
#include "sky.hpp"
#include "stage_file.hpp"

namespace candela::scenes {

// Sunny 16 (Frostbite 5.1.4): 100,000 lx of sun on an 18 % card that faces it, and a sky of 20,000 lx on the
// ground.
void write_grey_card(const std::filesystem::path& folder) {
    const float elevation = glm::radians(50.0f),
                azimuth = glm::radians(35.0f);  // of the sun, from +Z towards +X
    const glm::vec3 to_sun(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                           std::cos(elevation) * std::cos(azimuth));
    const float sun_lx = 100000.0f, sky_lx = 20000.0f, ground_albedo = 0.2f;
    const Panorama sky = outdoor_sky({to_sun, sky_lx, 0.0f, sky_lx + sun_lx * to_sun.y, ground_albedo});
    sky.save(folder / "clear_sky.exr");

    GltfDocument scene("grey_card");
    const int card_grey = scene.material(simple_material("grey card 18 %", glm::vec3(0.18f), 0.0f, 1.0f));
    const int board = scene.material(simple_material("board", {0.32f, 0.20f, 0.11f}, 0.0f, 0.7f));
    const int floor = scene.material(simple_material("gravel", {0.21f, 0.20f, 0.18f}, 0.0f, 1.0f));
    scene.place("ground", ground(200.0f, 200.0f), floor);

    // The easel is built facing +Z, then turned so that +Z meets the sun.
    const glm::quat turn =
        glm::angleAxis(azimuth, glm::vec3(0, 1, 0)) * glm::angleAxis(-elevation, glm::vec3(1, 0, 0));
    const glm::vec3 axis = glm::axis(turn);
    const float angle = glm::angle(turn);
    const glm::vec3 card_at(0.0f, 0.55f, 0.0f);
    scene.place("card", card(0.56f, 0.42f), card_grey, {card_at, axis, angle});
    scene.place("board", box({0.66f, 0.52f, 0.02f}), board, {card_at - 0.012f * to_sun, axis, angle});
    scene.place("leg", box({0.06f, 0.44f, 0.06f}), board, {{0.0f, 0.22f, -0.06f}, {0, 1, 0}, azimuth});
    scene.meter(card_at, to_sun, sun_lx + sky.illuminance_lx(to_sun));

    struct {
        const char* name;
        glm::vec3 color;
        float metallic, roughness;
    } const balls[] = {{"white plaster", glm::vec3(0.8f), 0, 0.9f},
                       {"black rubber", glm::vec3(0.04f), 0, 0.6f},
                       {"chrome", glm::vec3(0.55f, 0.556f, 0.554f), 1, 0.05f},
                       {"red enamel", glm::vec3(0.55f, 0.03f, 0.02f), 0, 0.15f}};
    const Shape ball = sphere(0.18f, 64, 32);
    float x = -0.99f;
    for (const auto& b : balls) {
        scene.place(b.name, ball, scene.material(simple_material(b.name, b.color, b.metallic, b.roughness)),
                    {{x, 0.18f, 0.35f}});
        x += 0.66f;
    }
    scene.light(
        {.name = "sun", .type = "directional", .intensity = sun_lx, .at_m = 5.0f * to_sun, .towards_m = {}});
    scene.camera("main", {0.35f, 1.35f, 3.4f}, {0.0f, 0.42f, 0.1f}, 50.0f);
    scene.save(folder / "grey_card.glb");
    write_stage(folder / "grey_card.stage.json",
                {{"environment", {{"file", "clear_sky.exr"}}},
                 {"exposure", manual_exposure(16.0f, 1.0f / 125.0f, 100.0f)}});
}

// A Lambertian 50 % plane under 10,000 lx at normal incidence: every pixel shows 10,000 * 0.5 / pi cd/m^2.
void write_grey_plane(const std::filesystem::path& folder) {
    GltfDocument scene("grey_plane");
    nlohmann::json grey = simple_material("grey 50 %", glm::vec3(0.5f), 0.0f, 1.0f);
    grey["extensions"]["KHR_materials_specular"]["specularFactor"] = 0.0f;
    scene.place("plane", card(8.0f, 8.0f), scene.material(grey));
    scene.light(
        {.name = "lamp", .type = "directional", .intensity = 10000.0f, .at_m = {0, 0, 3}, .towards_m = {}});
    scene.camera("main", {0.0f, 0.0f, 3.0f}, {0.0f, 0.0f, 0.0f}, 35.0f);
    scene.meter({0, 0, 0}, {0, 0, 1}, 10000.0f);
    scene.save(folder / "grey_plane.glb");
    write_stage(folder / "grey_plane.stage.json",
                {{"exposure", manual_exposure(16.0f, 1.0f / 15.0f, 100.0f)}});
}

// Lamps of known intensity over a white floor, for meters: the illuminance below each is in
// asset.extras.meters.
void write_lamps(const std::filesystem::path& folder) {
    LightSource moon{.name = "moon of 2 lx", .type = "directional", .intensity = 2.0f, .kelvin = 7000.0f};
    moon.at_m = 6.0f * glm::vec3(0.0f, std::sqrt(0.75f), 0.5f);
    moon.towards_m = glm::vec3(0.0f);
    LightSource bulb{.name = "bulb of 100 cd", .type = "point", .intensity = 100.0f, .kelvin = 2700.0f};
    bulb.at_m = {-2.5f, 1.5f, 0.0f};
    LightSource spot{.name = "spot of 500 cd", .type = "spot", .intensity = 500.0f, .kelvin = 3000.0f};
    spot.at_m = {0.0f, 2.5f, 0.0f};
    spot.towards_m = {0.0f, 0.0f, 0.0f};
    spot.inner_cone_rad = glm::radians(15.0f);
    spot.outer_cone_rad = glm::radians(25.0f);
    LightSource ranged{.name = "bulb of 100 cd with a range of 3 m", .type = "point", .intensity = 100.0f};
    ranged.kelvin = 6504.0f;
    ranged.at_m = {2.5f, 1.5f, 0.0f};
    ranged.range_m = 3.0f;

    GltfDocument scene("lamps");
    for (const LightSource& light : {moon, bulb, spot, ranged}) scene.light(light);
    scene.place("floor", ground(14.0f, 10.0f),
                scene.material(simple_material("paper", glm::vec3(0.8f), 0.0f, 1.0f)));
    const int metal = scene.material(simple_material("steel", {0.56f, 0.57f, 0.58f}, 1.0f, 0.3f));
    const Shape post = turned({{0.0f, 0.0f},
                               {0.14f, 0.0f},
                               {0.14f, 0.04f},
                               {0.04f, 0.09f},
                               {0.03f, 0.5f},
                               {0.06f, 0.56f},
                               {0.06f, 0.66f},
                               {0.0f, 0.71f}},
                              32, 28);
    for (const float x : {-2.5f, 0.0f, 2.5f}) scene.place("post", post, metal, {{x + 0.5f, 0.0f, 0.5f}});

    const auto point_lx = [](const LightSource& light, const glm::vec3& at, float range_m) {
        const glm::vec3 to_light = light.at_m - at;
        return light.intensity * shading::distance_attenuation(to_light, range_m) *
               std::max(glm::normalize(to_light).y, 0.0f);
    };
    const auto illuminance_lx = [&](const glm::vec3& at) {
        const float infinite = std::numeric_limits<float>::infinity();
        const float cosine = glm::normalize(spot.at_m - at).y;  // also to the spot's axis, which is vertical
        return moon.intensity * std::sqrt(0.75f) + point_lx(bulb, at, infinite) +
               point_lx(ranged, at, ranged.range_m) +
               point_lx(spot, at, infinite) * shading::angle_attenuation(cosine,
                                                                         std::cos(spot.inner_cone_rad),
                                                                         std::cos(spot.outer_cone_rad));
    };
    for (const glm::vec3 at : {glm::vec3(-2.5f, 0, 0), glm::vec3(0, 0, 0), glm::vec3(2.5f, 0, 0),
                               glm::vec3(0.9f, 0, 0), glm::vec3(-2.5f, 0, 2.0f), glm::vec3(-6, 0, -4)})
        scene.meter(at, {0, 1, 0}, illuminance_lx(at));
    scene.camera("main", {0.0f, 3.2f, 5.6f}, {0.0f, 0.2f, 0.2f}, 32.0f);
    scene.save(folder / "lamps.glb");
    write_stage(folder / "lamps.stage.json", {{"exposure", manual_exposure(4.0f, 1.0f / 15.0f, 800.0f)}});
}

}  // namespace candela::scenes
