#include "candela/scene/world_scale.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace candela;

namespace {

scene::Scene of_size(float size_m) {
    scene::Scene s;
    scene::Primitive p;
    p.bounds.extend({0, 0, 0});
    p.bounds.extend({size_m, 0, 0});
    s.meshes.push_back({"mesh", {p}});
    s.instances.push_back({"instance", 0, glm::mat4(1.0f)});
    return s;
}

}  // namespace

TEST(WorldScale, OrdinaryScenesKeepTheMetre) {
    for (const float size_m : {0.2f, 1.0f, 300.0f, 1e5f})
        EXPECT_EQ(scene::suitable_unit_m(of_size(size_m)), 1.0);
    EXPECT_EQ(scene::suitable_unit_m({}), 1.0);
    EXPECT_EQ(scene::suitable_unit_m(of_size(0.0f)), 1.0);
}

TEST(WorldScale, OthersBecomeOfAMiddlingSizeByAPowerOfTwo) {
    for (const float size_m : {1e-9f, 1e-7f, 0.1f, 1e6f, 1e10f}) {
        const double unit_m = scene::suitable_unit_m(of_size(size_m));
        const double own = static_cast<double>(size_m) / unit_m;
        EXPECT_GE(own, size_m < 1.0f ? 1.0 : 65536.0);
        EXPECT_LE(own, size_m < 1.0f ? 2.0 : 131072.0);
        int exponent = 0;
        EXPECT_EQ(std::frexp(unit_m, &exponent), 0.5);
    }
}

TEST(WorldScale, IlluminanceStays) {
    scene::Scene s = of_size(1e-3f);
    s.frame.origin_m = {7, 8, 9};
    scene::Light point, disk;
    point.position = {0.5e-3f, 1e-3f, 0};
    point.intensity = 3e-6f;
    disk.type = scene::LightType::disk;
    disk.position = point.position;
    disk.radius_m = 1e-4f;
    disk.intensity = 1000.0f;
    disk.range_m = 5e-3f;
    s.lights = {point, disk};
    scene::Camera camera;
    camera.world[3] = glm::vec4(0, 0, 4e-3f, 1);
    const glm::dvec3 eye = s.frame.to_world(glm::vec3(camera.world[3]));
    const double unit_m = scene::suitable_unit_m(s);
    scene::set_unit(s, camera, unit_m);
    EXPECT_EQ(s.frame.unit_m, unit_m);
    EXPECT_EQ(s.frame.to_world(glm::vec3(camera.world[3])), eye);
    const float d = glm::vec3(s.lights[0].position).y;
    EXPECT_FLOAT_EQ(s.lights[0].intensity / (d * d), 3e-6f / 1e-6f);
    EXPECT_EQ(s.lights[1].intensity, 1000.0f);
    EXPECT_FLOAT_EQ(s.lights[1].radius_m / d, 0.1f);
    EXPECT_FLOAT_EQ(s.lights[1].range_m / d, 5.0f);
    // There and back again, to the last digit.
    scene::set_unit(s, camera, 1.0);
    EXPECT_EQ(s.lights[0].intensity, 3e-6f);
    EXPECT_EQ(s.lights[0].position, point.position);
}
