// Spheres on a ground of 20 x 20 m under many lamps, for measurements of the light lists.
#include <cmath>
#include <numbers>

#include "demo_scenes.hpp"
#include "gltf_document.hpp"
#include "stage_file.hpp"

namespace candela::scenes {
namespace {

constexpr float kSide_m = 20.0f;
constexpr float kOverlapping = 8.0f;

/// The range at which about eight lamps reach every point of the ground.
float even_range_m(int count) {
    return std::sqrt(kOverlapping * kSide_m * kSide_m /
                     (std::numbers::pi_v<float> * static_cast<float>(count)));
}

}  // namespace

// The lamps stand on a square grid at a quarter of their range. Their intensities make the ground about as
// bright for any number of them.
void write_many_lights(const std::filesystem::path& folder, int count, float range_m) {
    const std::string name = "many_lights_" + std::to_string(count);
    const bool even = !(range_m > 0.0f);
    if (even) range_m = even_range_m(count);
    GltfDocument scene(name + (even ? "" : "_ranged"));
    scene.place("ground", ground(kSide_m, kSide_m),
                scene.material(simple_material("concrete", glm::vec3(0.5f), 0.0f, 0.6f)));
    const Shape ball = sphere(0.5f, 48, 24);
    for (int row = 0; row < 5; ++row) {
        for (int column = 0; column < 5; ++column) {
            const bool metal = (row + column) % 2 == 0;
            const float roughness = 0.15f + 0.15f * static_cast<float>(column);
            const std::string ball_name = "ball " + std::to_string(row) + " " + std::to_string(column);
            scene.place(
                ball_name, ball,
                scene.material(simple_material(ball_name,
                                               metal ? glm::vec3(1.0f, 0.77f, 0.34f) : glm::vec3(0.3f),
                                               metal ? 1.0f : 0.0f, roughness)),
                {{-8.0f + 4.0f * static_cast<float>(column), 0.5f, -8.0f + 4.0f * static_cast<float>(row)}});
        }
    }
    const int side = static_cast<int>(std::ceil(std::sqrt(static_cast<float>(count))));
    const float step_m = kSide_m / static_cast<float>(side);
    for (int i = 0; i < count; ++i) {
        LightSource lamp{.name = "lamp " + std::to_string(i), .intensity = 10.0f * range_m * range_m};
        lamp.kelvin = 2700.0f + 500.0f * static_cast<float>(i % 8);
        lamp.range_m = range_m;
        lamp.at_m = {-0.5f * kSide_m + (static_cast<float>(i % side) + 0.5f) * step_m, 0.25f * range_m,
                     -0.5f * kSide_m + (static_cast<float>(i / side) + 0.5f) * step_m};
        scene.light(lamp);
    }
    scene.camera("main", {0.0f, 7.0f, 13.0f}, {0.0f, 0.0f, 0.5f}, 28.0f);
    const std::string file = name + (even ? "" : "_ranged");
    scene.save(folder / (file + ".glb"));
    write_stage(folder / (file + ".stage.json"), {{"exposure", manual_exposure(4.0f, 1.0f / 15.0f, 200.0f)}});
}

}  // namespace candela::scenes
