// Linearly transformed cosines against the integrals that they stand for, and where they are known to fail.
#include "shading/lights/ltc.glsl"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "candela/bake/ltc_table.hpp"
#include "candela/measure/specular_techniques.hpp"
#include "shading/basis.glsl"
#include "shading/sequence.glsl"

namespace candela::measure {
namespace {

using namespace shading;

constexpr std::array kShapes{LightShape::sphere, LightShape::disk, LightShape::rectangle, LightShape::tube};
const vec3 kNormal(0.0f, 0.0f, 1.0f);

mat3 table_matrix(float NoV, float perceptual_roughness) {
    return ltc_inverse_matrix(bake::ltc_table().read(NoV, perceptual_roughness));
}
vec3 view_at(float NoV) {
    return {-std::sqrt((1.0f - NoV) * (1.0f + NoV)), 0.0f, NoV};
}

float ltc_of(const mat3& m, const vec3& v, const ShapedLight& light) {
    switch (light.shape) {
        case LightShape::sphere:
            return ltc_sphere(m, kNormal, v, light.center, light.radius);
        case LightShape::disk:
            return ltc_disk(m, kNormal, v, light.center, light.direction(), light.radius);
        case LightShape::rectangle:
            return ltc_rectangle(m, kNormal, v, light.center, light.right, light.up, light.half_width,
                                 light.half_height);
        default:
            return ltc_tube(m, kNormal, v, light.center, light.right, light.half_width, light.radius);
    }
}

/// Light k, its centre anywhere up to `below` under the horizon, its front to the receiver.
ShapedLight random_light(LightShape shape, uint k, float below) {
    const vec2 a = sobol_owen(k, 1u);
    const vec2 b = sobol_owen(k, 2u);
    const vec2 c = sobol_owen(k, 3u);
    ShapedLight light;
    light.shape = shape;
    vec3 towards = sample_uniform_hemisphere(a);
    towards = normalize(vec3(towards.x, towards.y, towards.z * (1.0f + below) - below));
    light.center = towards * (0.6f + 1.4f * b.x);
    light.half_width = 0.1f + 0.7f * c.x;
    light.half_height = 0.1f + 0.7f * c.y;
    light.radius = shape == LightShape::disk ? 0.1f + 0.7f * b.y : 0.05f + 0.4f * b.y;
    vec3 t;
    vec3 u;
    orthonormal_basis(-towards, t, u);
    const vec3 shine = to_world(sample_uniform_hemisphere(sobol_owen(k, 4u)), t, u, -towards);
    orthonormal_basis(shine, light.right, u);
    light.up = cross(-shine, light.right);
    return light;
}

/// The same with a number each for view and roughness, from smooth to rough and from the normal to grazing.
struct Case {
    ShapedLight light;
    float NoV;
    float perceptual_roughness;
};
Case random_case(LightShape shape, uint k, float below) {
    const vec2 u = sobol_owen(k, 7u);
    // Every fourth view is at the normal, where both horizons are one.
    const float NoV = k % 4u == 0u ? 1.0f : 0.03f + 0.97f * u.x;
    return {random_light(shape, k, below), NoV, 0.25f + 0.75f * u.y};
}

/// Share of the transformed cosine over a light, by its own samples: what the closed forms integrate.
double sampled(const mat3& m, const vec3& v, const ShapedLight& light, uint count) {
    const LtcFrame frame = ltc_frame(m, kNormal, v);
    const mat3 from_cosine = glm::inverse(frame.to_cosine);
    double hits = 0.0;
    for (uint i = 0; i < count; ++i) {
        const vec3 l = normalize(from_cosine * sample_cosine_hemisphere(sobol_owen(i, 11u)));
        if (l.z > 0.0f && square_metres_per_steradian(light, l) > 0.0) hits += 1.0;
    }
    return hits / count * double(frame.scale * PI);
}

TEST(Ltc, ClosedFormsAreTheIntegralsOverTheShapesAcrossBothHorizons) {
    for (const LightShape shape : kShapes) {
        for (uint k = 0; k < 150; ++k) {
            const Case c = random_case(shape, k, 0.3f);
            if (contains_receiver(c.light)) continue;
            const mat3 m = table_matrix(c.NoV, c.perceptual_roughness);
            const vec3 v = view_at(c.NoV);
            EXPECT_NEAR(ltc_of(m, v, c.light), sampled(m, v, c.light, 8192), 2.5e-3)
                << name_of(shape) << ' ' << k;
        }
    }
}

TEST(Ltc, NoLightIsFurtherFromTheLobeThanTheTableSays) {
    for (const LightShape shape : kShapes) {
        for (uint k = 0; k < 60; ++k) {
            const Case c = random_case(shape, k, 0.0f);
            if (contains_receiver(c.light)) continue;
            const float alpha = square(c.perceptual_roughness);
            const vec3 v = view_at(c.NoV);
            const SpecularIntegral truth =
                SpecularTruth(c.NoV, alpha, specular_albedo(c.NoV, alpha), 1024, 1024).integrate(c.light);
            const vec2 cell = ltc_uv(c.NoV, c.perceptual_roughness) * float(kLtcSize) - 0.5f;
            const int x = min(int(cell.x), kLtcSize - 2);
            const int y = min(int(cell.y), kLtcSize - 2);
            float stated = 0.0f;
            for (const int i : {0, 1, kLtcSize, kLtcSize + 1})
                stated = max(stated, bake::ltc_table().errors[std::size_t(y * kLtcSize + x + i)]);
            EXPECT_NEAR(ltc_of(table_matrix(c.NoV, c.perceptual_roughness), v, c.light), truth.value,
                        double(stated) + 4.0 * truth.noise + 0.004)
                << name_of(shape) << ' ' << k << ", NoV " << c.NoV << ", alpha " << alpha;
        }
    }
}

TEST(Ltc, TheLobeHasTheEnergyOne) {
    for (const float roughness : {0.3f, 0.5f, 0.8f, 1.0f}) {
        for (const float NoV : {1.0f, 0.7f, 0.3f, 0.08f}) {
            const mat3 m = table_matrix(NoV, roughness);
            const vec3 v = view_at(NoV);
            double sum = 0.0;
            constexpr uint count = 1u << 16u;
            for (uint i = 0; i < count; ++i) {
                // Half of the points where the lobe goes, half over all directions.
                const vec2 u = sobol_owen(i / 2u, 5u);
                const float alpha = square(roughness);
                const vec3 h = sample_ggx_vndf(u, v, alpha);
                const vec3 l = i % 2u == 0u ? sample_uniform_hemisphere(u) : 2.0f * dot(v, h) * h - v;
                const vec3 half = normalize(v + l);
                const float pdf =
                    0.5f / TWO_PI + 0.5f * pdf_reflected(pdf_ggx_vndf(v, half, alpha), dot(v, half));
                if (l.z > 0.0f) sum += double(ltc_density(m, kNormal, v, l) / pdf);
            }
            EXPECT_NEAR(sum / count, 1.0, 0.01) << roughness << ' ' << NoV;
        }
    }
}

TEST(Ltc, ACeilingThatIsAllThatIsSeenReflectsTheWholeLobe) {
    ShapedLight ceiling;
    ceiling.shape = LightShape::rectangle;
    ceiling.center = vec3(0.0f, 0.0f, 0.01f);
    ceiling.half_width = ceiling.half_height = 1000.0f;
    ShapedLight dome = ceiling;
    dome.shape = LightShape::disk;
    dome.radius = 1000.0f;
    for (const float roughness : {0.05f, 0.4f, 1.0f}) {
        for (const float NoV : {1.0f, 0.5f, 0.1f}) {
            const mat3 m = table_matrix(NoV, roughness);
            EXPECT_NEAR(ltc_of(m, view_at(NoV), ceiling), 1.0f, 2.0e-3f) << roughness << ' ' << NoV;
            EXPECT_NEAR(ltc_of(m, view_at(NoV), dome), 1.0f, 2.0e-3f) << roughness << ' ' << NoV;
        }
    }
}

TEST(Ltc, ASmoothSurfaceMirrorsTheShape) {
    // The lobe's half width here is 0.3 degrees at the normal: the mirror ray is the image but in a seam
    // along the outline.
    for (const float roughness : {0.0f, 0.02f, 0.05f}) {
        for (const LightShape shape : kShapes) {
            int inside = 0;
            int outside = 0;
            for (uint k = 0; k < 400; ++k) {
                const Case c = random_case(shape, k, 0.0f);
                const float NoV = 0.3f + 0.7f * c.NoV;
                const vec3 v = view_at(NoV);
                const vec3 mirror(-v.x, 0.0f, v.z);
                ShapedLight light = c.light;
                // Near the mirror ray, so that half of them are hit.
                light.center = length(light.center) * normalize(mirror + 0.4f * normalize(light.center));
                vec3 t;
                vec3 b;
                const vec3 shine = -normalize(light.center);
                orthonormal_basis(shine, t, b);
                light.right = t;
                light.up = cross(-shine, t);
                if (contains_receiver(light)) continue;
                int hits = 0;
                for (int i = 0; i < 16; ++i) {
                    const vec3 near = normalize(
                        mirror + 0.06f * vec3(std::cos(float(i) * 0.4f), std::sin(float(i) * 0.4f), 0.0f));
                    hits += square_metres_per_steradian(light, near) > 0.0 ? 1 : 0;
                }
                const float value = ltc_of(table_matrix(NoV, roughness), v, light);
                if (hits == 16 && square_metres_per_steradian(light, mirror) > 0.0) {
                    ++inside;
                    EXPECT_GT(value, 0.97f) << name_of(shape) << ' ' << k << " at roughness " << roughness;
                } else if (hits == 0) {
                    ++outside;
                    EXPECT_LT(value, 0.03f) << name_of(shape) << ' ' << k << " at roughness " << roughness;
                }
            }
            EXPECT_GT(inside, 10) << name_of(shape);
            EXPECT_GT(outside, 10) << name_of(shape);
        }
    }
}

TEST(Ltc, LightBelowTheSurfaceOrFromTheBackIsNone) {
    for (const LightShape shape : kShapes) {
        for (uint k = 0; k < 60; ++k) {
            Case c = random_case(shape, k, 0.0f);
            const mat3 m = table_matrix(c.NoV, c.perceptual_roughness);
            const vec3 v = view_at(c.NoV);
            if (shape == LightShape::disk || shape == LightShape::rectangle) {
                ShapedLight back = c.light;
                back.up = -back.up;
                EXPECT_EQ(ltc_of(m, v, back), 0.0f) << name_of(shape) << ' ' << k;
            }
            c.light.center.z = -1.5f;
            c.light.half_height = std::min(c.light.half_height, 0.5f);
            EXPECT_LE(ltc_of(m, v, c.light), 1.0e-6f) << name_of(shape) << ' ' << k;
        }
    }
}

TEST(Ltc, GrazingViewsAndLightsThatTouchOrCrossTheSurfaceAreFiniteAndWithinOne) {
    for (const LightShape shape : kShapes) {
        for (const float NoV : {0.0f, 1.0e-4f, 0.01f, 0.5f, 1.0f}) {
            for (const float roughness : {0.0f, 0.02f, 0.3f, 1.0f}) {
                const mat3 m = table_matrix(NoV, roughness);
                for (const vec3& center :
                     {vec3(0.0f), vec3(0.0f, 0.0f, 0.3f), vec3(0.3f, 0.0f, 0.0f), vec3(0.5f, 0.2f, 0.0f),
                      vec3(0.0f, 0.0f, 1.0e-6f), vec3(1.0e-6f, 0.0f, 0.0f), vec3(100.0f, 0.0f, 1.0f)}) {
                    for (const vec3& right : {vec3(1.0f, 0.0f, 0.0f), vec3(0.0f, 0.0f, 1.0f),
                                              normalize(vec3(1.0f, 2.0f, 3.0f))}) {
                        ShapedLight light;
                        light.shape = shape;
                        light.center = center;
                        light.right = right;
                        light.up = normalize(cross(right, vec3(0.3f, -0.2f, 0.5f)));
                        light.radius = 0.3f;
                        const float value = ltc_of(m, view_at(NoV), light);
                        EXPECT_TRUE(value >= 0.0f && value <= 1.0f)
                            << name_of(shape) << ": " << value << " at " << center.x << ' ' << center.y << ' '
                            << center.z;
                    }
                }
            }
        }
    }
}

TEST(Ltc, AGrazingViewOfALightInTheMirrorDirectionIsNotDark) {
    for (const LightShape shape : kShapes) {
        for (const float NoV : {0.002f, 0.02f, 0.1f}) {
            ShapedLight light = random_light(shape, 1u, 0.0f);
            light.center = vec3(1.0f, 0.0f, 0.2f);
            const vec3 shine = -normalize(light.center);
            vec3 b;
            orthonormal_basis(shine, light.right, b);
            light.up = cross(-shine, light.right);
            EXPECT_GT(ltc_of(table_matrix(NoV, 0.3f), view_at(NoV), light), 0.05f)
                << name_of(shape) << ' ' << NoV;
        }
    }
}

TEST(Ltc, ATubeThatPointsAtTheSurfaceIsItsNearSphere) {
    ShapedLight tube;
    tube.shape = LightShape::tube;
    tube.right = vec3(0.0f, 0.0f, 1.0f);
    tube.center = vec3(0.0f, 0.0f, 1.5f);
    tube.half_width = 1.0f;
    tube.radius = 0.2f;
    ShapedLight sphere = tube;
    sphere.shape = LightShape::sphere;
    sphere.center = vec3(0.0f, 0.0f, 0.5f);
    for (const float NoV : {1.0f, 0.6f}) {
        const mat3 m = table_matrix(NoV, 0.6f);
        EXPECT_NEAR(ltc_of(m, view_at(NoV), tube), ltc_of(m, view_at(NoV), sphere), 1.0e-5f);
        // As the tube comes out from behind its end, nothing jumps.
        tube.center.x = 0.2001f;
        sphere.center.x = 0.2001f;
        EXPECT_NEAR(ltc_of(m, view_at(NoV), tube), ltc_of(m, view_at(NoV), sphere), 1.0e-3f);
        tube.center.x = sphere.center.x = 0.0f;
    }
}

TEST(Ltc, ATubeWithoutLengthIsASphere) {
    for (uint k = 0; k < 50; ++k) {
        const Case c = random_case(LightShape::tube, k, 0.3f);
        if (contains_receiver(c.light)) continue;
        ShapedLight tube = c.light;
        tube.half_width = 1.0e-4f;
        ShapedLight sphere = tube;
        sphere.shape = LightShape::sphere;
        const mat3 m = table_matrix(c.NoV, c.perceptual_roughness);
        EXPECT_NEAR(ltc_of(m, view_at(c.NoV), tube), ltc_of(m, view_at(c.NoV), sphere), 1.0e-3f) << k;
    }
}

}  // namespace
}  // namespace candela::measure
