#include <glm/geometric.hpp>

#include "demo_scenes.hpp"
#include "gltf_document.hpp"
#include "sky.hpp"
#include "stage_file.hpp"

namespace candela::scenes {

// Five roughnesses of a dielectric over the same of a metal, lit by the environment alone.
void write_sphere_grid(const std::filesystem::path& folder) {
    GltfDocument scene("sphere_grid");
    const Shape ball = sphere(0.45f, 64, 32);
    for (int row = 0; row < 2; ++row) {
        const bool metal = row == 0;
        for (int column = 0; column < 5; ++column) {
            const float roughness = 0.1f + 0.2f * static_cast<float>(column);
            const std::string name =
                std::string(metal ? "gold" : "plastic") + " of roughness 0." + std::to_string(1 + 2 * column);
            const glm::vec3 color = metal ? glm::vec3(1.0f, 0.766f, 0.336f) : glm::vec3(0.05f, 0.21f, 0.40f);
            const int material = scene.material(simple_material(name, color, metal ? 1.0f : 0.0f, roughness));
            scene.place(
                name, ball, material,
                {{-2.2f + 1.1f * static_cast<float>(column), 0.5f + 1.1f * static_cast<float>(row), 0.0f}});
        }
    }
    scene.camera("main", {0.0f, 1.05f, 8.0f}, {0.0f, 1.05f, 0.0f}, 58.0f);
    scene.save(folder / "sphere_grid.glb");
    soft_box_studio(500.0f).save(folder / "studio.exr");
    // For measurements (bench/path_convergence): a peak of about two thousand times the mean.
    SkySettings hazy;
    hazy.to_sun = glm::normalize(glm::vec3(-0.5f, 0.6f, 0.6f));
    hazy.sun_illuminance_lx = 2500.0f;
    hazy.ground_illuminance_lx = 20000.0f;
    outdoor_sky(hazy).save(folder / "hazy_sun.exr");
    write_stage(folder / "sphere_grid.stage.json",
                {{"environment", {{"file", "studio.exr"}}},
                 {"exposure", manual_exposure(4.0f, 1.0f / 15.0f, 100.0f)}});
}

}  // namespace candela::scenes
