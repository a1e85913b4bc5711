#include "emission_units.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "candela/bake/environment.hpp"
#include "candela/realtime/exposure_control.hpp"
#include "option_rules.hpp"
#include "shading/exposure.glsl"

namespace candela::app {
namespace {

/// Emission above this, in a file without lights, is in cd/m^2: no file that means display white writes it.
constexpr float kLargestRelative = 100.0f;
/// White of a display (IEC 61966-2-1 has 80, most have 100 or more): where nothing lights the scene.
constexpr float kDisplayWhite_nit = 100.0f;

float brightest_emission(const scene::Scene& scene) {
    float brightest = 0.0f;
    for (const scene::Material& m : scene.materials) {
        if (!m.unlit) brightest = std::max(brightest, shading::max_component(m.emissive_nit));
    }
    return brightest;
}

/// Luminance of a white surface in the middle of the scene, from its lights and its environment.
float white_nit(const scene::Scene& scene) {
    scene::Scene lights;
    lights.lights = scene.lights;
    lights.environment = scene.environment ? scene.environment : bake::studio_environment();
    if (!scene.environment && !scene.lights.empty()) lights.environment.reset();
    const scene::Aabb bounds = scene::world_bounds(scene);
    return realtime::typical_illuminance_lx(lights, bounds) * shading::INV_PI;
}

io::StageUnits units_of(const JobOptions& options, const io::Stage& stage) {
    if (!options.units) return stage.units.value_or(io::StageUnits::automatic);
    if (*options.units == "absolute") return io::StageUnits::absolute;
    return *options.units == "relative" ? io::StageUnits::relative : io::StageUnits::automatic;
}

}  // namespace

void add_emission_options(CLI::App& command, JobOptions& o) {
    command
        .add_option(
            "--units", o.units,
            "What the scene file's emission is in: absolute (cd/m2), relative (1 = a white surface under "
            "the scene's light), auto (relative where the scene brings no light); auto unless told otherwise")
        ->check(CLI::IsMember({"auto", "absolute", "relative"}));
    command.add_option("--emissive-scale", o.emissive_scale, "Multiplies the scene file's emission")
        ->check(number_in(0.0, 1e12));
}

bool set_emission_units(const JobOptions& options, const io::Stage& stage, bool brings_no_light, Job& job) {
    const io::StageUnits how = units_of(options, stage);
    const float brightest = brightest_emission(job.scene);
    EmissionUnits& units = job.emission;
    units.relative = how == io::StageUnits::relative ||
                     (how == io::StageUnits::automatic && brings_no_light && brightest <= kLargestRelative);
    units.nit_per_unit = 1.0f;
    if (units.relative && brightest > 0.0f) {
        const bool dark = !brings_no_light && !job.scene.environment && job.scene.lights.empty();
        units.nit_per_unit = dark ? kDisplayWhite_nit : white_nit(job.scene);
    }
    units.nit_per_unit *= options.emissive_scale.value_or(stage.emissive_scale.value_or(1.0f));
    for (scene::Material& m : job.scene.materials) m.emissive_nit *= units.nit_per_unit;
    return units.relative && brightest > 0.0f;
}

nlohmann::json emission_units_json(const EmissionUnits& units) {
    return {{"emission", units.relative ? "relative" : "absolute"}, {"nit_per_unit", units.nit_per_unit}};
}

}  // namespace candela::app
