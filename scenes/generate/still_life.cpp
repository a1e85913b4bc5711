#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "candela/io/image_write.hpp"
#include "demo_scenes.hpp"
#include "gltf_document.hpp"
#include "shading/lights/units.glsl"
#include "shading/transfer.glsl"
#include "sky.hpp"
#include "stage_file.hpp"

namespace candela::scenes {
namespace {

using nlohmann::json;

constexpr float board_top_m = 0.021f;

/// 12 x 8 squares of cream and blue stone, each of its own shade, as 8 bit sRGB.
void write_checker(const std::filesystem::path& file) {
    constexpr std::uint32_t squares_x = 12, squares_y = 8, texels = 48;
    constexpr std::uint32_t width = squares_x * texels, height = squares_y * texels;
    std::vector<std::uint8_t> rgb;
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            const std::uint32_t column = x / texels, row = y / texels;
            const bool light = (column + row) % 2 == 0;
            const float shade = 0.9f + 0.1f * static_cast<float>((column * 37 + row * 91) % 17) / 16.0f;
            const auto fx = static_cast<float>(x), fy = static_cast<float>(y);
            const float vein =
                1.0f +
                0.05f * std::sin(0.06f * fx + 2.0f * std::sin(0.045f * fy + static_cast<float>(column)));
            const glm::vec3 stone =
                light ? glm::vec3(0.62f, 0.56f, 0.46f) : glm::vec3(0.035f, 0.055f, 0.085f);
            const glm::vec3 code = shading::srgb_from_linear(glm::min(stone * shade * vein, glm::vec3(1.0f)));
            for (int c = 0; c < 3; ++c)
                rgb.push_back(static_cast<std::uint8_t>(std::lround(255.0f * code[c])));
        }
    }
    io::write_png(file, width, height, rgb);
}

Shape vase() {
    Shape shape = turned({{0.0f, 0.0f},
                          {0.055f, 0.0f},
                          {0.062f, 0.008f},
                          {0.052f, 0.024f},
                          {0.082f, 0.075f},
                          {0.112f, 0.14f},
                          {0.108f, 0.20f},
                          {0.066f, 0.26f},
                          {0.046f, 0.30f},
                          {0.056f, 0.335f},
                          {0.070f, 0.35f},
                          {0.066f, 0.354f},
                          {0.049f, 0.335f},
                          {0.040f, 0.30f},
                          {0.058f, 0.26f},
                          {0.098f, 0.20f},
                          {0.100f, 0.14f},
                          {0.060f, 0.06f},
                          {0.0f, 0.045f}},
                         56, 44);
    for (const float side : {-1.0f, 1.0f}) {
        const auto path = [side](float v) {
            const float a = glm::radians(glm::mix(-78.0f, 118.0f, v));
            return glm::vec3(side * (0.078f + 0.062f * std::cos(a)), 0.247f + 0.062f * std::sin(a), 0.0f);
        };
        const auto reference = [](float) { return glm::vec3(0, 0, 1); };
        const auto radius = [](float v) {
            return 0.0085f + 0.004f * std::pow(std::abs(2.0f * v - 1.0f), 3.0f);
        };
        shape.append(tube({10, 24, true, false}, path, reference, radius));
    }
    return shape;
}

Shape bowl() {
    return turned({{0.0f, 0.0f},
                   {0.045f, 0.0f},
                   {0.048f, 0.006f},
                   {0.052f, 0.014f},
                   {0.085f, 0.035f},
                   {0.107f, 0.072f},
                   {0.110f, 0.076f},
                   {0.106f, 0.077f},
                   {0.098f, 0.064f},
                   {0.080f, 0.040f},
                   {0.045f, 0.020f},
                   {0.0f, 0.017f}},
                  56, 21);
}

Shape candle_stand() {
    return turned({{0.0f, 0.0f},
                   {0.05f, 0.0f},
                   {0.052f, 0.006f},
                   {0.02f, 0.018f},
                   {0.011f, 0.05f},
                   {0.016f, 0.075f},
                   {0.011f, 0.10f},
                   {0.014f, 0.16f},
                   {0.036f, 0.176f},
                   {0.034f, 0.182f},
                   {0.0f, 0.178f}},
                  28, 24);
}

Shape rainbow_knot() {
    Shape knot = torus_knot(2, 3, 0.062f, 0.026f, 0.0155f, 128, 10);
    knot.color_by([](const glm::vec3& p, const glm::vec2&) {
        const float turn = std::atan2(p.y, p.x);
        const auto wave = [&](float shift) { return 0.5f + 0.5f * std::cos(turn - shift); };
        return glm::vec3(0.04f) +
               glm::vec3(0.75f, 0.45f, 0.7f) * glm::vec3(wave(0.4f), wave(2.5f), wave(4.4f));
    });
    return knot;
}

struct Palette {
    int lacquer, copper, velvet, steel, porcelain, plastic, glass, walnut, checker, paper, night_light;
};

Palette make_palette(GltfDocument& scene, float night_light_nit) {
    Palette p{};
    json lacquer = simple_material("crimson lacquer", {0.42f, 0.012f, 0.02f}, 0.0f, 0.45f);
    lacquer["extensions"]["KHR_materials_clearcoat"] = {{"clearcoatFactor", 1.0f},
                                                        {"clearcoatRoughnessFactor", 0.04f}};
    p.lacquer = scene.material(lacquer);

    json copper = simple_material("brushed copper", {0.955f, 0.638f, 0.538f}, 1.0f, 0.34f);
    copper["extensions"]["KHR_materials_anisotropy"] = {{"anisotropyStrength", 0.75f},
                                                        {"anisotropyRotation", 0.0f}};
    p.copper = scene.material(copper);

    json velvet = simple_material("green velvet", {0.012f, 0.055f, 0.035f}, 0.0f, 0.9f);
    velvet["extensions"]["KHR_materials_sheen"] = {{"sheenColorFactor", {0.25f, 0.5f, 0.38f}},
                                                   {"sheenRoughnessFactor", 0.35f}};
    p.velvet = scene.material(velvet);

    p.steel = scene.material(simple_material("polished steel", {0.56f, 0.57f, 0.58f}, 1.0f, 0.12f));
    p.porcelain = scene.material(simple_material("porcelain", {0.78f, 0.76f, 0.72f}, 0.0f, 0.08f));
    p.plastic = scene.material(simple_material("painted plastic", glm::vec3(1.0f), 0.0f, 0.3f));

    json glass = simple_material("tinted glass", {0.10f, 0.32f, 0.36f}, 0.0f, 0.03f);
    glass["pbrMetallicRoughness"]["baseColorFactor"][3] = 0.28f;
    glass["alphaMode"] = "BLEND";
    glass["doubleSided"] = true;
    p.glass = scene.material(glass);

    p.walnut = scene.material(simple_material("walnut", {0.11f, 0.055f, 0.03f}, 0.0f, 0.5f));
    json checker = simple_material("inlaid stone", glm::vec3(1.0f), 0.0f, 0.22f);
    checker["pbrMetallicRoughness"]["baseColorTexture"]["index"] = scene.texture("checker.png");
    p.checker = scene.material(checker);
    json paper = simple_material("paper sweep", {0.42f, 0.40f, 0.37f}, 0.0f, 0.95f);
    paper["doubleSided"] = true;
    p.paper = scene.material(paper);
    p.night_light = scene.material(emissive_material("night light", night_light_nit, 2400.0f));
    return p;
}

void light_like_a_room(GltfDocument& scene, const glm::vec3& night_light_at, float night_light_lm) {
    // Together with the 150 lx of the soft boxes about 500 lx where the vase stands: a well-lit desk.
    LightSource key{.name = "key, 1500 cd", .type = "spot", .intensity = 1500.0f, .kelvin = 4300.0f};
    key.at_m = {-1.25f, 1.7f, 1.2f};
    key.towards_m = {0.0f, 0.08f, 0.0f};
    key.inner_cone_rad = glm::radians(14.0f);
    key.outer_cone_rad = glm::radians(30.0f);
    LightSource rim{.name = "rim, 500 cd", .type = "spot", .intensity = 500.0f, .kelvin = 6500.0f};
    rim.at_m = {0.95f, 1.25f, -0.55f};
    rim.towards_m = {0.05f, 0.1f, 0.0f};
    rim.inner_cone_rad = glm::radians(18.0f);
    rim.outer_cone_rad = glm::radians(34.0f);
    LightSource bulb{
        .name = "ceiling bulb, 800 lm", .type = "point", .intensity = shading::point_cd_from_lm(800.0f)};
    bulb.kelvin = 2700.0f;
    bulb.at_m = {0.7f, 1.6f, 0.9f};
    LightSource night{.name = "night light, 25 lm", .intensity = shading::point_cd_from_lm(night_light_lm)};
    night.kelvin = 2400.0f;
    night.at_m = night_light_at;
    for (const LightSource& light : {key, rim, bulb, night}) scene.light(light);
}

}  // namespace

// A product shot: one of each kind of material on an inlaid board, in front of a paper sweep.
void write_still_life(const std::filesystem::path& folder) {
    const float globe_m = 0.035f, globe_lm = 25.0f;
    GltfDocument scene("still_life");
    write_checker(folder / "checker.png");
    const Palette p = make_palette(scene, shading::sphere_nit_from_lm(globe_lm, globe_m));

    scene.place("vase", vase(), p.lacquer, {{-0.04f, board_top_m, -0.06f}, {0, 1, 0}, glm::radians(-14.0f)});
    scene.place("bowl", bowl(), p.copper, {{-0.27f, board_top_m, 0.10f}});
    const Shape egg = superellipsoid({0.031f, 0.040f, 0.031f}, 1.0f, 1.0f, 24, 12);
    const int eggs = scene.mesh("egg", egg, p.porcelain);
    scene.node("egg in the bowl", eggs,
               {{-0.285f, board_top_m + 0.053f, 0.115f}, {0, 0, 1}, glm::radians(78.0f)});
    scene.node("egg on the board", eggs,
               {{-0.095f, board_top_m + 0.031f, 0.205f},
                glm::normalize(glm::vec3(0.4f, 0.0f, 0.9f)),
                glm::radians(90.0f)});
    scene.place("cushion", superellipsoid({0.12f, 0.042f, 0.10f}, 0.75f, 0.55f, 36, 18), p.velvet,
                {{0.235f, board_top_m + 0.041f, 0.085f}, {0, 1, 0}, glm::radians(-18.0f)});
    scene.place("knot", rainbow_knot(), p.plastic,
                {{0.23f, board_top_m + 0.177f, 0.085f}, {0, 1, 0}, glm::radians(-12.0f)});
    scene.place("steel ball", sphere(0.034f, 32, 16), p.steel, {{0.045f, board_top_m + 0.034f, 0.185f}});
    const glm::vec3 stand_at(-0.26f, board_top_m, -0.15f);
    const glm::vec3 globe_at = stand_at + glm::vec3(0.0f, 0.178f + globe_m, 0.0f);
    scene.place("stand", candle_stand(), p.steel, {stand_at});
    scene.place("night light", sphere(globe_m, 28, 14), p.night_light, {globe_at});
    scene.place("glass pane", box({0.20f, 0.26f, 0.006f}), p.glass,
                {{0.16f, board_top_m + 0.13f, -0.12f}, {0, 1, 0}, glm::radians(-24.0f)});
    scene.place("board", box({0.96f, 0.02f, 0.64f}), p.walnut, {{0.0f, 0.010f, 0.0f}});
    scene.place("inlay", ground(0.90f, 0.60f), p.checker, {{0.0f, board_top_m, 0.0f}});
    scene.place("paper", paper_sweep(5.0f, 2.5f, -0.95f, 2.2f, 0.5f), p.paper);

    light_like_a_room(scene, globe_at, globe_lm);
    scene.camera("main", {0.05f, 0.58f, 1.72f}, {-0.01f, 0.135f, 0.0f}, 66.0f);
    scene.camera("close", {-0.42f, 0.28f, 0.62f}, {-0.12f, 0.12f, 0.02f}, 50.0f);
    scene.save(folder / "still_life.glb");
    soft_box_studio(150.0f).save(folder / "soft_boxes.exr");
    write_stage(folder / "still_life.stage.json",
                {{"environment", {{"file", "soft_boxes.exr"}}},
                 {"camera", {{"name", "main"}}},
                 {"exposure", manual_exposure(8.0f, 1.0f / 15.0f, 400.0f)}});
}

}  // namespace candela::scenes
