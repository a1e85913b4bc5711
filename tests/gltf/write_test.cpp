#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <set>

#include "candela/io/gltf_write.hpp"
#include "candela/io/ies_write.hpp"
#include "candela/io/photometric.hpp"
#include "common/files.hpp"
#include "demo_scenes.hpp"
#include "gltf_lights.hpp"
#include "gltf_samples.hpp"
#include "source_folder.hpp"

using namespace candela;
using namespace candela::test;
using scene::Light;
using scene::LightType;

namespace {

struct Written {
    scene::Scene scene;
    std::vector<std::string> warnings;
};

Written round_trip(const scene::Scene& scene, const char* name = "out.glb") {
    const TemporaryFolder folder;
    Written out;
    Diagnostics writing, reading;
    io::write_gltf(folder / name, scene, writing);
    for (const auto& w : writing.warnings()) out.warnings.push_back(w.text);
    out.scene = io::load_gltf(folder / name, {}, reading);
    EXPECT_TRUE(reading.warnings().empty()) << reading.warnings().front().text;
    return out;
}

template <class T>
void expect_near(const std::vector<T>& a, const std::vector<T>& b, const char* what) {
    ASSERT_EQ(a.size(), b.size()) << what;
    float most = 0.0f;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, glm::length(a[i] - b[i]));
    EXPECT_LE(most, 1e-6f) << what;
}

void expect_equal(const scene::Primitive& a, const scene::Primitive& b) {
    expect_near(a.positions, b.positions, "positions");
    expect_near(a.normals, b.normals, "normals");
    expect_near(a.tangents, b.tangents, "tangents");
    expect_near(a.uv[0], b.uv[0], "uv 0");
    expect_near(a.uv[1], b.uv[1], "uv 1");
    expect_near(a.colors, b.colors, "colors");
    EXPECT_EQ(a.indices, b.indices);
    EXPECT_EQ(a.material, b.material);
}

/// A texture is what it shows, whatever its index.
void expect_equal(const scene::Scene& s, const scene::TextureRef& a, const scene::Scene& t,
                  const scene::TextureRef& b) {
    ASSERT_EQ(static_cast<bool>(a), static_cast<bool>(b));
    if (!a) return;
    EXPECT_EQ(a.uv_set, b.uv_set);
    EXPECT_EQ(a.offset, b.offset);
    EXPECT_EQ(a.scale, b.scale);
    EXPECT_EQ(a.rotation_rad, b.rotation_rad);
    EXPECT_EQ(s.textures[a.texture].sampler, t.textures[b.texture].sampler);
    const scene::Image& x = s.images[s.textures[a.texture].image];
    const scene::Image& y = t.images[t.textures[b.texture].image];
    EXPECT_EQ(x.name, y.name);
    EXPECT_EQ(x.width, y.width);
    EXPECT_TRUE(x.rgba == y.rgba);
}

void expect_equal(const scene::Scene& s, const scene::Material& a, const scene::Scene& t,
                  const scene::Material& b) {
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.workflow, b.workflow);
    EXPECT_EQ(a.base_color, b.base_color);
    EXPECT_EQ(a.metallic, b.metallic);
    EXPECT_EQ(a.perceptual_roughness, b.perceptual_roughness);
    EXPECT_EQ(a.emissive_nit, b.emissive_nit);
    EXPECT_EQ(a.ior, b.ior);
    EXPECT_EQ(a.specular, b.specular);
    EXPECT_EQ(a.specular_color, b.specular_color);
    EXPECT_EQ(a.clearcoat.factor, b.clearcoat.factor);
    EXPECT_EQ(a.clearcoat.perceptual_roughness, b.clearcoat.perceptual_roughness);
    EXPECT_EQ(a.sheen.color, b.sheen.color);
    EXPECT_EQ(a.sheen.perceptual_roughness, b.sheen.perceptual_roughness);
    EXPECT_EQ(a.anisotropy.strength, b.anisotropy.strength);
    EXPECT_EQ(a.anisotropy.rotation_rad, b.anisotropy.rotation_rad);
    EXPECT_EQ(a.alpha_mode, b.alpha_mode);
    EXPECT_EQ(a.alpha_cutoff, b.alpha_cutoff);
    EXPECT_EQ(a.double_sided, b.double_sided);
    EXPECT_EQ(a.unlit, b.unlit);
    const auto refs = [](const scene::Material& m) {
        return std::vector<const scene::TextureRef*>{
            &m.base_color_texture,       &m.metallic_roughness_texture, &m.normal_texture,
            &m.occlusion_texture,        &m.emissive_texture,           &m.specular_texture,
            &m.specular_color_texture,   &m.clearcoat.texture,          &m.clearcoat.roughness_texture,
            &m.clearcoat.normal_texture, &m.sheen.color_texture,        &m.sheen.roughness_texture,
            &m.anisotropy.texture};
    };
    for (std::size_t i = 0; i < refs(a).size(); ++i) {
        SCOPED_TRACE("texture " + std::to_string(i));
        expect_equal(s, *refs(a)[i], t, *refs(b)[i]);
    }
    if (a.normal_texture) {
        EXPECT_EQ(a.normal_scale, b.normal_scale);
    }
    if (a.occlusion_texture) {
        EXPECT_EQ(a.occlusion_strength, b.occlusion_strength);
    }
    if (a.clearcoat.normal_texture) {
        EXPECT_EQ(a.clearcoat.normal_scale, b.clearcoat.normal_scale);
    }
}

void expect_equal(const Light& a, const Light& b) {
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.type, b.type);
    EXPECT_TRUE(near(a.color * a.intensity, b.color * b.intensity, 1e-6f * a.intensity));
    if (!scene::is_distant(a.type)) {
        EXPECT_TRUE(near(a.position, b.position));
    }
    EXPECT_TRUE(near(a.direction, b.direction));
    EXPECT_TRUE(near(a.right, b.right));
    EXPECT_EQ(a.range_m, b.range_m);
    EXPECT_NEAR(a.radius_m, b.radius_m, 1e-6f);
    EXPECT_NEAR(a.half_width_m, b.half_width_m, 1e-6f);
    EXPECT_NEAR(a.half_height_m, b.half_height_m, 1e-6f);
    if (a.type == LightType::spot) {
        EXPECT_EQ(a.inner_cone_rad, b.inner_cone_rad);
        EXPECT_EQ(a.outer_cone_rad, b.outer_cone_rad);
    }
    EXPECT_EQ(a.profile == scene::no_index, b.profile == scene::no_index);
}

void expect_equal(const scene::Scene& a, const scene::Scene& b) {
    ASSERT_EQ(a.materials.size(), b.materials.size());
    for (std::size_t i = 0; i < a.materials.size(); ++i) {
        SCOPED_TRACE("material " + a.materials[i].name);
        expect_equal(a, a.materials[i], b, b.materials[i]);
    }
    ASSERT_EQ(a.instances.size(), b.instances.size());
    for (std::size_t i = 0; i < a.instances.size(); ++i) {
        SCOPED_TRACE("instance " + std::to_string(i) + " " + a.instances[i].name);
        EXPECT_EQ(a.instances[i].name, b.instances[i].name);
        EXPECT_EQ(a.instances[i].world, b.instances[i].world);
        const scene::Mesh& m = a.meshes[a.instances[i].mesh];
        const scene::Mesh& n = b.meshes[b.instances[i].mesh];
        EXPECT_EQ(m.name, n.name);
        ASSERT_EQ(m.primitives.size(), n.primitives.size());
        for (std::size_t p = 0; p < m.primitives.size(); ++p) expect_equal(m.primitives[p], n.primitives[p]);
    }
    ASSERT_EQ(a.cameras.size(), b.cameras.size());
    for (std::size_t i = 0; i < a.cameras.size(); ++i) {
        const scene::Camera &c = a.cameras[i], &d = b.cameras[i];
        EXPECT_EQ(c.name, d.name);
        EXPECT_EQ(c.projection, d.projection);
        EXPECT_EQ(c.yfov_rad, d.yfov_rad);
        EXPECT_EQ(c.aspect, d.aspect);
        EXPECT_EQ(c.znear_m, d.znear_m);
        EXPECT_EQ(c.zfar_m, d.zfar_m);
        for (int column = 0; column < 4; ++column)
            EXPECT_TRUE(near(glm::vec3(c.world[column]), glm::vec3(d.world[column])));
    }
    ASSERT_EQ(a.lights.size(), b.lights.size());
    for (std::size_t i = 0; i < a.lights.size(); ++i) {
        SCOPED_TRACE("light " + a.lights[i].name);
        expect_equal(a.lights[i], b.lights[i]);
    }
    std::set<std::string> names, other_names;
    for (const scene::Node& node : a.nodes) names.insert(node.name);
    for (const scene::Node& node : b.nodes) other_names.insert(node.name);
    EXPECT_TRUE(std::includes(other_names.begin(), other_names.end(), names.begin(), names.end()));
}

Light light_of(LightType type) {
    Light l;
    l.name = scene::name_of(type);
    l.type = type;
    l.position = {1, 2, 3};
    l.direction = {0, -1, 0};
    l.right = {0, 0, 1};
    l.intensity = 250.0f;
    l.color = {1.5f, 1.0f, 0.25f};
    l.radius_m = 0.25f;
    l.half_width_m = 0.5f;
    l.half_height_m = 0.125f;
    return l;
}

Written written_light(const Light& light) {
    scene::Scene scene = load(triangle());
    scene.lights = {light};
    return round_trip(scene);
}

}  // namespace

TEST(WriteGltf, ScenesComeBackAsTheyWere) {
    GltfBuilder lit = lit_by_profile(small_ies(), {{"multiplier", 2.5}});
    lit.push("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}});
    lit.push("cameras", {{"type", "orthographic"},
                         {"orthographic", {{"xmag", 3}, {"ymag", 2}, {"znear", 0}, {"zfar", 9}}}});
    lit.doc["nodes"][0]["camera"] = 0;
    lit.doc["nodes"][1]["camera"] = 1;
    GltfBuilder old = with_material({{"name", "old"},
                                     {"extensions",
                                      {{"KHR_materials_pbrSpecularGlossiness",
                                        {{"diffuseFactor", {0.1, 0.2, 0.3, 0.4}},
                                         {"specularFactor", {0.5, 0.6, 0.7}},
                                         {"glossinessFactor", 0.3},
                                         {"diffuseTexture", {{"index", 0}}}}}}}});
    add_texture(old, png_of_four_texels());
    const std::pair<const char*, GltfBuilder> samples[] = {
        {"triangle", triangle()},
        {"material", everything_in_a_material()},
        {"skin", skinned()},
        {"morph", morphed()},
        {"draco", draco_strip(3)},
        {"meshopt", meshopt_triangle()},
        {"lit", lit},
        {"area", lit_by("EXT_lights_area", {{"type", "rect"}, {"rect", {{"aspect", 3}}}})},
        {"specular-glossiness", old}};
    for (const auto& [name, builder] : samples) {
        SCOPED_TRACE(name);
        const scene::Scene scene = load(builder);
        for (const char* file : {"out.glb", "out put.gltf"}) {
            const Written written = round_trip(scene, file);
            EXPECT_TRUE(written.warnings.empty());
            expect_equal(scene, written.scene);
        }
    }
}

TEST(WriteGltf, LightsThatGltfHas) {
    for (const LightType type :
         {LightType::point, LightType::spot, LightType::directional, LightType::rectangle, LightType::disk}) {
        SCOPED_TRACE(scene::name_of(type));
        Light light = light_of(type);
        if (type != LightType::rectangle) light.half_width_m = light.half_height_m = 0.0f;
        if (type != LightType::disk) light.radius_m = 0.0f;
        const Written written = written_light(light);
        EXPECT_TRUE(written.warnings.empty());
        ASSERT_EQ(written.scene.lights.size(), 1u);
        expect_equal(light, written.scene.lights[0]);
    }
}

TEST(WriteGltf, WhatGltfCannotCarryIsAWarningAndComesNear) {
    constexpr float pi = 3.14159265f;
    for (const LightType type :
         {LightType::sun, LightType::sphere, LightType::tube, LightType::line, LightType::frustum}) {
        SCOPED_TRACE(scene::name_of(type));
        const Light light = light_of(type);
        const Written written = written_light(light);
        ASSERT_EQ(written.warnings.size(), 1u);
        EXPECT_NE(written.warnings[0].find(std::string("light ") + scene::name_of(type)), std::string::npos);
        ASSERT_EQ(written.scene.lights.size(), 1u);
        if (type == LightType::sphere) {
            EXPECT_EQ(written.scene.lights[0].type, LightType::point);
            EXPECT_NEAR(written.scene.lights[0].intensity * written.scene.lights[0].color.y,
                        250.0f * pi * 0.25f * 0.25f, 1e-3f);
        }
    }
    Light odd = light_of(LightType::rectangle);
    odd.visible = odd.casts_shadow = false;
    odd.range_m = 3.0f;
    EXPECT_EQ(written_light(odd).warnings.size(), 3u);
}

TEST(WriteGltf, TwoSidesAreTwoLights) {
    Light light = light_of(LightType::disk);
    light.two_sided = true;
    const Written written = written_light(light);
    ASSERT_EQ(written.scene.lights.size(), 2u);
    EXPECT_TRUE(near(written.scene.lights[0].direction, -written.scene.lights[1].direction));
}

TEST(WriteGltf, ASpotWithAProfileKeepsItsCones) {
    scene::Scene scene = load(lit_by_profile(small_ies()));
    scene.lights[0].type = LightType::spot;
    scene.lights[0].outer_cone_rad = 0.5f;
    const Written written = round_trip(scene);
    ASSERT_EQ(written.scene.lights.size(), 1u);
    expect_equal(scene.lights[0], written.scene.lights[0]);
}

TEST(WriteGltf, ProfilesKeepTheirWeb) {
    std::string four_planes = small_ies();
    const std::string head = "1 -1 1 3 1 1", planes = "1 -1 1 3 5 1";
    four_planes.replace(four_planes.find(head), head.size(), planes);
    four_planes.replace(
        four_planes.find("\r\n0\r\n100 50 0"), std::string::npos,
        "\r\n0 90 180 270 360\r\n100 50 0.1 100 33.3333 0.1 100 40 0.1 100 20 0.1 100 50 0.1\r\n");
    // Light to 90 degrees, and abruptly none beyond; the same upwards.
    std::string down = small_ies(), up = small_ies();
    down.replace(down.find("0 90 180"), 8, "0 45 90");
    down.replace(down.find("100 50 0"), 8, "100 80 50");
    up.replace(up.find("0 90 180"), 8, "90 135 180");
    up.replace(up.find("100 50 0"), 8, "50 80 100");
    for (const std::string& text : {small_ies(), four_planes, down, up}) {
        Diagnostics diagnostics;
        const auto read = [&](const std::string& bytes) {
            return io::load_photometric_from_memory(std::as_bytes(std::span(bytes.data(), bytes.size())),
                                                    "a.ies", {}, diagnostics);
        };
        const scene::PhotometricProfile first = read(text);
        const scene::PhotometricProfile second = read(io::ies_text(first));
        EXPECT_EQ(first.vertical_deg, second.vertical_deg);
        EXPECT_EQ(first.horizontal_deg, second.horizontal_deg);
        EXPECT_EQ(first.candela, second.candela);
        EXPECT_EQ(first.name, second.name);
        EXPECT_TRUE(diagnostics.warnings().empty()) << diagnostics.warnings().front().text;
    }
}

TEST(WriteGltf, NothingIsLeftWhereTheFolderIsMissing) {
    Diagnostics diagnostics;
    EXPECT_THROW(io::write_gltf("/nowhere/at/all/out.gltf", load(triangle()), diagnostics), Error);
}

namespace {

void expect_round_trip(const std::filesystem::path& file) {
    SCOPED_TRACE(file.string());
    Diagnostics diagnostics;
    const scene::Scene scene = io::load_gltf(file, {}, diagnostics);
    const Written written = round_trip(scene);
    EXPECT_TRUE(written.warnings.empty());
    expect_equal(scene, written.scene);
}

}  // namespace

TEST(WriteGltf, DemoScenesComeBackAsTheyWere) {
    const TemporaryFolder folder;
    for (const scenes::Demo& demo : scenes::demos()) demo.write(folder.path());
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
        if (entry.path().extension() == ".glb") expect_round_trip(entry.path());
    }
}

TEST(WriteGltf, SampleScenesComeBackAsTheyWere) {
    const std::filesystem::path shared = CANDELA_SOURCE_DIR "/../shared/data/gltf";
    if (!std::filesystem::exists(shared)) GTEST_SKIP() << "no sample scenes here";
    for (const auto& entry : std::filesystem::recursive_directory_iterator(shared)) {
        const auto extension = entry.path().extension();
        const bool scene = extension == ".glb" || extension == ".gltf";
        if (scene && entry.path().parent_path().filename() != "malformed") expect_round_trip(entry.path());
    }
}
