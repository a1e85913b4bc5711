#include <gtest/gtest.h>

#include "gltf_lights.hpp"
#include "limited_run.hpp"

using namespace candela;
using namespace candela::test;
using scene::LightType;

namespace {

std::string data_uri(const std::string& bytes) {
    static const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t i = 0; i + 2 < bytes.size(); i += 3) {
        unsigned word = 0;
        for (std::size_t k = 0; k < 3; ++k) word = word << 8 | static_cast<unsigned char>(bytes[i + k]);
        for (int shift = 18; shift >= 0; shift -= 6) out += digits[word >> shift & 63];
    }
    return "data:application/x-ies-lm-63;base64," + out;
}

}  // namespace

TEST(AreaLights, RectangleAndDiskInTheFrameOfTheirNode) {
    const scene::Scene s = load(lit_by(
        "EXT_lights_area", {{"type", "rect"}, {"size", 0.5}, {"rect", {{"aspect", 4}}}, {"intensity", 250}}));
    ASSERT_EQ(s.lights.size(), 1u);
    const scene::Light& rect = s.lights[0];
    EXPECT_EQ(rect.type, LightType::rectangle);
    EXPECT_EQ(rect.name, "Lamp");
    EXPECT_EQ(rect.carrier, "EXT_lights_area");
    EXPECT_FLOAT_EQ(rect.intensity, 250.0f);
    // The largest absolute scale, 3, whatever the axis: height 1.5 m, width 6 m.
    EXPECT_FLOAT_EQ(rect.half_height_m, 0.75f);
    EXPECT_FLOAT_EQ(rect.half_width_m, 3.0f);
    EXPECT_FALSE(rect.two_sided);
    EXPECT_TRUE(near(rect.position, {1, 2, 3}));
    EXPECT_TRUE(near(rect.direction, {0, -1, 0}));

    const scene::Light disk = load(lit_by("EXT_lights_area", {{"type", "disk"}, {"size", 0.5}})).lights.at(0);
    EXPECT_EQ(disk.type, LightType::disk);
    EXPECT_FLOAT_EQ(disk.radius_m, 0.75f);
    EXPECT_FLOAT_EQ(disk.intensity, 1000.0f);  // the draft's default
}

TEST(ProfileLights, FromABufferViewAndFromAUri) {
    const scene::Scene s =
        load(lit_by_profile(small_ies(), {{"multiplier", 2.5}, {"color", {1, 0.5, 0.25}}}));
    ASSERT_EQ(s.lights.size(), 1u);
    ASSERT_EQ(s.profiles.size(), 1u);
    const scene::Light& light = s.lights[0];
    EXPECT_EQ(light.type, LightType::point);
    EXPECT_EQ(light.profile, 0u);
    EXPECT_FLOAT_EQ(light.intensity, 2.5f);
    EXPECT_FLOAT_EQ(light.color.y, 0.5f);
    EXPECT_TRUE(near(light.direction, {0, -1, 0}));
    EXPECT_NEAR(scene::intensity_cd(s.profiles[0], glm::vec3(0, 0, -1)), 100.0, 1e-4);

    const scene::Scene by_uri = load(lit_by("EXT_lights_ies", {{"uri", data_uri(small_ies() + "  ")}}));
    EXPECT_NEAR(scene::intensity_cd(by_uri.profiles.at(0), glm::vec3(1, 0, 0)), 50.0, 1e-4);
}

TEST(ProfileLights, WithAPunctualLightOnTheNodeThereIsOneLight) {
    GltfBuilder b = lit_by_profile(small_ies(), {{"multiplier", 2}});
    b.doc["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"}, {"intensity", 7}, {"color", {1, 0, 0}}, {"spot", {{"outerConeAngle", 0.5}}}}};
    b.doc["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    const scene::Scene s = load(b);
    ASSERT_EQ(s.lights.size(), 1u);
    EXPECT_EQ(s.lights[0].type, LightType::spot);
    EXPECT_EQ(s.lights[0].carrier, "KHR_lights_punctual, EXT_lights_ies");
    EXPECT_FLOAT_EQ(s.lights[0].intensity, 2.0f);  // times the profile's cd
    EXPECT_FLOAT_EQ(s.lights[0].outer_cone_rad, 0.5f);
    EXPECT_FLOAT_EQ(s.lights[0].color.y, 0.0f);
}

TEST(LightOptions, TheScaleIsForEveryLightOfTheFile) {
    io::GltfOptions twice;
    twice.light_scale = 2.0f;
    EXPECT_FLOAT_EQ(load(lit_by_profile(small_ies()), twice).lights.at(0).intensity, 2.0f);
    EXPECT_FLOAT_EQ(load(lit_by("EXT_lights_area", {{"type", "disk"}}), twice).lights.at(0).intensity,
                    2000.0f);
}

/// What Blender's exporter writes for a point light of 10 W and a sun of 2 W/m^2 in its three modes is the
/// same light.
TEST(LightOptions, BlendersLightingModesAgree) {
    constexpr float pi = 3.14159265f;
    struct Mode {
        io::GltfLightUnits units;
        float point, sun;
    };
    const Mode modes[] = {{io::GltfLightUnits::spec, 683 * 10 / (4 * pi), 683 * 2},
                          {io::GltfLightUnits::unitless, 10 / (4 * pi), 2},
                          {io::GltfLightUnits::raw, 10, 2}};
    for (const Mode& mode : modes) {
        io::GltfOptions options;
        options.light_units = mode.units;
        const auto intensity = [&](const char* type, float stated) {
            return load(lit_by("KHR_lights_punctual", {{"type", type}, {"intensity", stated}}), options)
                .lights.at(0)
                .intensity;
        };
        EXPECT_NEAR(intensity("point", mode.point), 543.514f, 0.01f);
        EXPECT_NEAR(intensity("spot", mode.point), 543.514f, 0.01f);
        EXPECT_NEAR(intensity("directional", mode.sun), 1366.0f, 0.01f);
    }
}

TEST(MalformedLights, NameTheirPointer) {
    const auto area = [](const json& light) { return lit_by("EXT_lights_area", light); };
    const auto ies = [](const json& light) { return lit_by("EXT_lights_ies", light); };
    const json mime = "application/x-ies-lm-63";
    const std::pair<GltfBuilder, const char*> cases[] = {
        {area({{"type", "sphere"}}), "/extensions/EXT_lights_area/lights/0/type"},
        {area({{"type", 3}}), "/extensions/EXT_lights_area/lights/0/type"},
        {area({{"type", "rect"}, {"size", 0}}), "/extensions/EXT_lights_area/lights/0/size"},
        {area({{"type", "rect"}, {"rect", {{"aspect", -1}}}}), "/lights/0/rect/aspect"},
        {area({{"type", "rect"}, {"rect", 2}}), "/lights/0/rect"},
        {area({{"type", "disk"}, {"intensity", "1"}}), "/lights/0/intensity"},
        {area({{"type", "disk"}, {"color", {1, 1}}}), "/lights/0/color"},
        {area("disk"), "/extensions/EXT_lights_area/lights/0"},
        {lit_by("EXT_lights_area", {{"type", "disk"}}, {{"light", 1}}),
         "/nodes/1/extensions/EXT_lights_area/light: index 1 is out of range"},
        {lit_by("EXT_lights_ies", json::object(), {{"light", 9}}),
         "/nodes/1/extensions/EXT_lights_ies/light"},
        {lit_by("EXT_lights_ies", json::object(), {{"light", "0"}}),
         "/nodes/1/extensions/EXT_lights_ies/light"},
        {ies(json::object()), "/extensions/EXT_lights_ies/lights/0: needs a uri or a bufferView"},
        {ies({{"uri", "a.ies"}, {"bufferView", 0}, {"mimeType", mime}}), "has a uri and a bufferView"},
        {ies({{"bufferView", 0}}), "/extensions/EXT_lights_ies/lights/0: needs a mimeType"},
        {ies({{"bufferView", 0}, {"mimeType", "text/plain"}}), "/lights/0/mimeType"},
        {ies({{"bufferView", 99}, {"mimeType", mime}}), "/lights/0/bufferView"},
        {ies({{"bufferView", 0}, {"mimeType", mime}}), "/lights/0/bufferView"},  // vertices
        {ies({{"uri", 7}}), "/lights/0/uri"},
        {lit_by_profile(small_ies().substr(0, small_ies().size() - 8)), "/lights/0/bufferView"},
        {lit_by_profile(""), "/lights/0/bufferView"},
        {lit_by_profile(small_ies(), {{"multiplier", "2"}}), "/nodes/1/extensions/EXT_lights_ies/multiplier"},
        {lit_by_profile(small_ies(), {{"color", {1}}}), "/nodes/1/extensions/EXT_lights_ies/color"},
    };
    for (const auto& [builder, mentions] : cases) {
        SCOPED_TRACE(builder.doc["extensions"].dump() + builder.doc["nodes"][1].dump());
        const TemporaryFolder folder;
        write(folder / "scene.glb", builder.glb());
        // Drawn without the light or the value, and said where; docs/scene-files.md.
        const auto outcome = info_within_limits(folder / "scene.glb");
        const std::string pointer = std::string(mentions).substr(0, std::string(mentions).find(": "));
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_NE(outcome.out.find("  warning  "), std::string::npos) << outcome.out;
        EXPECT_NE(outcome.out.find(pointer), std::string::npos) << outcome.out;
    }
}

TEST(MalformedLights, FilesThatAreMissingOrElsewhere) {
    // What is not there is no reason to draw nothing.
    for (const std::string missing : {"none.ies", "http://example.org/lamp.ies"}) {
        const TemporaryFolder folder;
        write(folder / "scene.glb", lit_by("EXT_lights_ies", {{"uri", missing}}).glb());
        const auto outcome = info_within_limits(folder / "scene.glb");
        EXPECT_EQ(outcome.exit_code, 0);
        EXPECT_NE(outcome.out.find(missing), std::string::npos) << outcome.out;
        EXPECT_NE(outcome.out.find("the light is drawn without it"), std::string::npos) << outcome.out;
    }
    const std::pair<const char*, const char*> cases[] = {{"../lamp.ies", "path leaves the folder"},
                                                         {"%2e%2e/lamp.ies", "path leaves the folder"},
                                                         {"/etc/passwd", "absolute path"}};
    for (const auto& [uri, mentions] : cases) {
        SCOPED_TRACE(uri);
        const TemporaryFolder folder;
        write(folder / "scene.glb", lit_by("EXT_lights_ies", {{"uri", uri}}).glb());
        expect_one_clear_line(info_within_limits(folder / "scene.glb"), mentions);
    }
    const TemporaryFolder folder;
    write(folder / "scene.glb", lit_by("EXT_lights_ies", {{"uri", "lamp%201.ies"}}).glb());
    write(folder / "lamp 1.ies", small_ies());
    EXPECT_EQ(info_within_limits(folder / "scene.glb").exit_code, 0);
}
