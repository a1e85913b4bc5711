// Options that contradict one another, or that could have no effect, are refused while the command line is
// read: no file is opened, so that none has to exist here.
#include "process.hpp"

namespace candela::test {
namespace {

struct Case {
    const char* arguments;
    const char* names;
};

void expect_refused(const Case& c) {
    SCOPED_TRACE(c.arguments);
    expect_one_line(run_candela(c.arguments), 2, c.names);
}

TEST(Contradictions, OfExposureAndCamera) {
    for (const Case& c : {
             Case{"render s.glb --ev100 9 --auto-exposure", "--auto-exposure: contradicts --ev100"},
             Case{"render s.glb --ev100 9 --iso 100", "--iso: contradicts --ev100"},
             Case{"render s.glb --shutter 1/60 --ev100 9", "--shutter: contradicts --ev100"},
             Case{"render s.glb --ev100 9 --aperture 8", "--aperture: contradicts --ev100"},
             Case{"render s.glb --auto-exposure --aperture 8 --shutter 1 --iso 100", "--auto-exposure"},
             Case{"bench s.glb --ev100 9 --auto-exposure", "--auto-exposure: contradicts --ev100"},
             Case{"compare s.glb --ev100 9 --auto-exposure", "--auto-exposure: contradicts --ev100"},
             Case{"compare s.glb --ev100 9 --exposure 8", "--ev100: contradicts --exposure"},
             Case{"render s.glb --camera main --look-from 1,2,3", "--look-from: contradicts --camera"},
             Case{"render s.glb --camera main --look-at 1,2,3", "--look-at: contradicts --camera"},
             Case{"meter s.glb --at 0,0,0 --size 8x8", "--size: has no effect"},
             Case{"meter s.glb --at 0,0,0 --field-deg 3", "--field-deg: has no effect"},
             Case{"meter s.glb --at 0,0,0 --ev100 3", "--ev100"},
         })
        expect_refused(c);
}

TEST(Contradictions, OfEnvironments) {
    for (const Case& c : {
             Case{"render s.glb --env a.exr --env-lux 5 --env-scale 2", "--env-lux: contradicts --env-scale"},
             Case{"env info a.exr --env-lux 5 --env-scale 2", "--env-lux: contradicts --env-scale"},
             Case{"env split a.exr -o x --env-lux 5 --env-scale 2", "--env-lux: contradicts --env-scale"},
             Case{"render s.glb --env-visible --env-hidden", "--env-hidden: contradicts --env-visible"},
             Case{"render s.glb --env sky:elevation=9 --env-keep-sun", "--env-keep-sun: has no effect"},
             Case{"render s.glb --env sky --env-layout cross", "--env-layout: has no effect"},
             Case{"render s.glb --env studio --env-cube direct", "--env-cube: has no effect"},
             Case{"render s.glb --env studio --env-keep-sun", "--env-keep-sun: has no effect"},
             Case{"env info sky --env-layout cross", "--env-layout: has no effect"},
             Case{"bake studio --env-layout cross", "--env-layout: has no effect"},
             Case{"render s.glb --env none --env-lux 5", "--env-lux: has no effect"},
             Case{"render s.glb --env none --env-hidden", "--env-hidden: has no effect"},
             Case{"render s.glb --env-layout cross", "--env-layout: has no effect"},
             Case{"render s.glb --env sky --env-negative spread", "--env-negative: has no effect"},
             Case{"env info studio --env-layer a", "--env-layer: has no effect"},
             Case{"bake dfg --env-negative spread", "--env-negative: has no effect"},
             Case{"info s.glb --env none --env-scale 5", "--env-scale: has no effect"},
             Case{"info --env sky", "--env: has no effect without a scene"},
             Case{"info --env-scale 2", "--env-scale: has no effect without a scene"},
             Case{"info --env-keep-sun", "--env-keep-sun: has no effect without a scene"},
             Case{"render s.glb --env sky:elevation=1,elevation=2", "given twice: elevation"},
             Case{"bake sky:turbidity=3,elevation=1,turbidity=3", "given twice: turbidity"},
             Case{"render s.glb --env sky:", "names no key"},
         })
        expect_refused(c);
}

TEST(Contradictions, OfFilesThatAreNotWritten) {
    for (const Case& c : {
             Case{"render s.glb --aov all -o a.png", "--aov: has no effect without an EXR"},
             Case{"render s.glb --aov all", "--aov: has no effect without an EXR"},
             Case{"render s.glb --exr-type float -o a.png", "--exr-type: has no effect"},
             Case{"render s.glb --png-bits 16 -o a.exr", "--png-bits: has no effect"},
             Case{"render s.glb --tonemap agx -o a.exr", "--tonemap: has no effect"},
             Case{"light a.ies --per-klm", "--per-klm: has no effect"},
             Case{"validate --list --threads 2", "--threads: has no effect"},
             Case{"validate --list -o x", "--output: has no effect"},
         })
        expect_refused(c);
    expect_refused({"render s.glb -o a.png -o a.png", "a.png: is given twice"});
}

TEST(Contradictions, OfModes) {
    for (const Case& c : {
             Case{"render s.glb --checkpoint-every 5",
                  "--checkpoint-every: has no effect in the mode realtime"},
             Case{"render s.glb --mode integrate --max-bounces 3",
                  "--max-bounces: has no effect in the mode"},
             Case{"render s.glb --mode path --focus-m 3", "--focus-m: has no effect without a lens"},
             Case{"render s.glb --mode path --direct-only --max-bounces 3", "--max-bounces: contradicts"},
             Case{"render s.glb --mode path --shadows none --max-bounces 3", "--max-bounces: contradicts"},
             Case{"render s.glb --mode path --furnace --env sky", "--env: contradicts --furnace"},
             Case{"render s.glb --mode path --shadow-atlas 1024", "--shadow-atlas: has no effect"},
             Case{"render s.glb --shadows none --shadow-atlas 1024", "--shadow-atlas: contradicts --shadows"},
             Case{"compare a.exr b.exr --env sky", "--env: has no effect on pictures"},
             Case{"compare a.exr b.exr --path-spp 4", "--path-spp: has no effect on pictures"},
             Case{"compare s.glb --no-truth --path-spp 4", "--path-spp: has no effect without the mode path"},
             Case{"compare s.glb --shadows ray", "--shadows: has no effect"},
         })
        expect_refused(c);
}

TEST(Contradictions, OfBakes) {
    for (const Case& c : {
             Case{"bake studio --preset filament --format dds", "--format: has no effect"},
             Case{"bake studio --preset gltf --irradiance-size 8", "--irradiance-size: has no effect"},
             Case{"bake studio --preset threejs --levels 3", "--levels: has no effect"},
             Case{"bake studio --preset filament --mapping linear", "--mapping: is not what"},
             Case{"bake studio --size 64 --levels 12", "--levels: a cube of 64 has 7 at most"},
             Case{"bake studio --size 64 --preset filament --levels 6", "--levels: a cube of 64 has 5"},
             Case{"bake studio --size 2 --preset filament", "--size"},
             Case{"bake studio --size 100", "--size: 100 is not a power of two"},
             Case{"bake studio --samples 64", "--samples: has no effect"},
             Case{"bake studio --dfg-size 64", "--dfg-size: has no effect"},
             Case{"bake dfg --size 64", "--size: has no effect on dfg"},
             Case{"bake ltc --preset filament", "--preset: has no effect on ltc"},
             Case{"bake lobes --visibility schlick", "--visibility: has no effect"},
             Case{"bake -o x probes s.glb", "--output: has no effect before probes"},
             Case{"bench --frames 3 bake", "--frames: has no effect before bake"},
             // Before its heading.
             Case{"bench bake --size 100", "--size: 100 is not a power of two"},
         })
        expect_refused(c);
}

// What only the scene can tell.
TEST(Contradictions, OfASceneWithoutAnEnvironment) {
    const TemporaryFolder folder;
    const std::string lit = folder / "lit.gltf", stage = folder / "none.json";
    spit(lit, R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "directional", "intensity": 1000}]}},
        "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"extensions": {"KHR_lights_punctual": {"light": 0}}}]})");
    spit(stage, R"({"environment": {"none": true}})");
    for (const char* option : {"--env-lux 500", "--env-scale 2", "--env-rotate 9", "--env-hidden"}) {
        const std::string name = std::string(option).substr(0, std::string(option).find(' '));
        expect_one_line(run_candela("meter " + lit + " --at 0,0,0 " + option), 2, name + ": has no effect");
        expect_one_line(run_candela("info " + lit + " " + option), 2, name + ": has no effect");
        expect_one_line(run_candela("meter " + lit + " --at 0,0,0 --stage " + stage + " " + option), 2,
                        name + ": has no effect");
    }
    spit(folder / "sky.json", R"({"environment": {"sky": {}}})");
    expect_one_line(
        run_candela("meter " + lit + " --at 0,0,0 --env-keep-sun --stage " + (folder / "sky.json")), 2,
        "--env-keep-sun");
    expect_one_line(run_candela("render " + lit + " --look-at 0,0,0"), 2, "--look-at: needs a place");
    expect_one_line(run_candela("render " + lit + " --focal-mm 85"), 2, "--focal-mm: has no effect");
}

// An aperture beside an EV is the lens's.
TEST(Contradictions, AnApertureOfALensIsNone) {
    const Outcome outcome =
        run_candela("render no.glb --mode path --depth-of-field --ev100 9 --aperture 2 -o x.exr");
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    EXPECT_NE(outcome.err.find("no.glb"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace candela::test
