#include <gtest/gtest.h>

#include <random>

#include "read_back.hpp"
#include "shading/lights/photometric.glsl"

using namespace candela;
using namespace candela::test;

namespace {

double beam(double c, double gamma) {
    return 2000.0 * std::exp(-gamma * gamma / 144.0) * (1.2 + std::cos(c * kDegree)) + gamma;
}

scene::PhotometricProfile narrow_beam() {
    IesFile file;
    file.vertical = steps(0, 180, 2.5);
    file.horizontal = steps(0, 360, 22.5);
    file.intensity = [](double c, double gamma) { return gamma == 0.0 ? 2400.0 : beam(c, gamma); };
    return read(file.bytes());
}

double looked_up(const std::vector<float>& table, int width, int height, const glm::vec3& direction) {
    const shading::PhotometricTaps taps = shading::photometric_taps(direction, width, height);
    double sum = 0.0;
    for (int i = 0; i < 4; ++i) sum += double(taps.weight[i]) * table.at(std::size_t(taps.index[i]));
    return sum;
}

/// Integral of the bilinear table: closed form over gamma, trapezoids over C, which are exact.
double table_lm(const std::vector<float>& table, int width, int height) {
    scene::PhotometricProfile p;
    for (int y = 0; y < height; ++y) p.vertical_deg.push_back(180.0 * y / (height - 1));
    for (int x = 0; x <= width; ++x) {
        p.horizontal_deg.push_back(360.0 * x / width);
        for (int y = 0; y < height; ++y) p.candela.push_back(table[std::size_t(y * width + x % width)]);
    }
    return scene::integrated_lm(p);
}

std::vector<glm::vec3> directions(int count) {
    std::mt19937 random(7);
    std::normal_distribution<float> normal;
    std::vector<glm::vec3> out{{0, 0, -1},     {0, 0, 1}, {1, 0, 0}, {-1, 0, 0},
                               {-1, -0.0f, 0}, {0, 1, 0}, {0, -1, 0}};
    while (int(out.size()) < count) out.emplace_back(normal(random), normal(random), normal(random));
    return out;
}

}  // namespace

TEST(PhotometricTable, AFittingGridIsTheFileItself) {
    const auto p = narrow_beam();
    const auto grid = scene::fitting_grid(p);
    EXPECT_EQ(grid.width, 16);
    EXPECT_EQ(grid.height, 73);
    const auto table = scene::resample(p, grid.width, grid.height);
    for (const glm::vec3& d : directions(2000)) {
        const double exact = scene::intensity_cd(p, d);
        EXPECT_NEAR(looked_up(table, grid.width, grid.height, d), exact, 1e-4 * exact + 1e-2);
    }
    EXPECT_NEAR(table_lm(table, grid.width, grid.height), scene::integrated_lm(p),
                1e-6 * scene::integrated_lm(p));
    // Any multiple of it too, as layers of one texture have.
    const auto finer = scene::resample(p, 4 * grid.width, 5 * (grid.height - 1) + 1);
    EXPECT_NEAR(looked_up(finer, 64, 361, {0, 0, -1}), 2400.0, 1e-3);
    EXPECT_NEAR(table_lm(finer, 64, 361), scene::integrated_lm(p), 1e-6 * scene::integrated_lm(p));
}

TEST(PhotometricTable, IlluminanceUnderTheFixtureIsTheFilesOverDistanceSquared) {
    const auto p = narrow_beam();
    const auto grid = scene::fitting_grid(p);
    const auto table = scene::resample(p, grid.width, grid.height);
    for (double height_m : {0.5, 2.7, 12.0}) {
        for (double aside_m : {0.0, 0.1, 1.0}) {
            const glm::vec3 to_point(float(aside_m), 0.0f, float(-height_m));
            const double d2 = height_m * height_m + aside_m * aside_m;
            const double gamma = std::atan2(aside_m, height_m) / kDegree;
            const double lx =
                looked_up(table, grid.width, grid.height, to_point) / d2 * height_m / std::sqrt(d2);
            const double stated = scene::intensity_cd(p, 0.0, gamma) / d2 * height_m / std::sqrt(d2);
            EXPECT_NEAR(lx, stated, 0.0005 * stated);
        }
    }
}

TEST(PhotometricTable, ATableThatDoesNotFitKeepsTheLumens) {
    const auto p = narrow_beam();
    for (const auto& [width, height] : {std::pair{64, 32}, {7, 100}, {1, 50}, {100, 181}, {16, 64}}) {
        const auto table = scene::resample(p, width, height);
        EXPECT_NEAR(table_lm(table, width, height), scene::integrated_lm(p), 1e-6 * scene::integrated_lm(p))
            << width << "x" << height;
    }
}

TEST(PhotometricTable, AJumpAtTheHorizonKeepsTheLumens) {
    IesFile file;
    file.vertical = {0.0, 90.0};
    const auto p = read(file.bytes());
    const auto grid = scene::fitting_grid(p);
    const auto table = scene::resample(p, grid.width, grid.height);
    EXPECT_NEAR(table_lm(table, grid.width, grid.height), scene::integrated_lm(p),
                1e-4 * scene::integrated_lm(p));
    EXPECT_NEAR(looked_up(table, grid.width, grid.height, {0, 0, -1}), 100.0, 1e-5);
    EXPECT_LE(180.0 / (grid.height - 1), 0.5);
}

TEST(PhotometricTable, OneGridFitsManyFiles) {
    IesFile fine;
    fine.vertical = steps(0, 180, 1);
    const auto q = read(fine.bytes());
    const scene::PhotometricProfile both[] = {narrow_beam(), q};
    const auto grid = scene::fitting_grid(both);
    EXPECT_EQ(grid.height, 361);
    EXPECT_EQ(grid.width, 16);
    EXPECT_EQ(scene::fitting_grid(q).width, 1) << "all half-planes are the same";
}

TEST(PhotometricTable, AnglesAreExactNearTheAim) {
    for (const double gamma : {1e-4, 1e-3, 0.01}) {
        const glm::vec3 d(float(std::sin(gamma)), 0.0f, float(-std::cos(gamma)));
        EXPECT_NEAR(shading::photometric_angles(d).y, gamma, 1e-6 * gamma);
    }
}

TEST(PhotometricTable, TapsStayInsideAndSumToOne) {
    for (const glm::vec3& d : directions(5000)) {
        for (const auto& [width, height] : {std::pair{1, 2}, {3, 7}, {72, 91}}) {
            const auto taps = shading::photometric_taps(d, width, height);
            float sum = 0.0f;
            for (int i = 0; i < 4; ++i) {
                ASSERT_GE(taps.index[i], 0);
                ASSERT_LT(taps.index[i], width * height);
                ASSERT_GE(taps.weight[i], 0.0f);
                sum += taps.weight[i];
            }
            ASSERT_NEAR(sum, 1.0f, 1e-6f);
        }
    }
}

TEST(PhotometricTable, TextureCoordinatesMeetTheSameTexels) {
    const glm::vec3 d = shading::photometric_direction(float(45.0 * kDegree), float(30.0 * kDegree));
    const glm::vec2 uv = shading::photometric_uv(d, 8, 7);
    EXPECT_NEAR(uv.x * 8.0f - 0.5f, 1.0f, 1e-5f) << "column 1 of 8 is C45";
    EXPECT_NEAR(uv.y * 7.0f - 0.5f, 1.0f, 1e-5f) << "row 1 of 7 is gamma 30";
}
