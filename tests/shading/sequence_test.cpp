#include "shading/sequence.glsl"

#include <gtest/gtest.h>

#include <functional>
#include <set>
#include <vector>

namespace candela::shading {
namespace {

using Point = std::function<vec2(uint)>;

/// True when every elementary interval 2^-a x 2^-(m-a) holds one of the first 2^m points: a (0,m,2)-net.
bool is_net(const Point& point, int m) {
    const uint n = 1u << m;
    for (int a = 0; a <= m; ++a) {
        std::vector<int> hits(n);
        for (uint i = 0; i < n; ++i) {
            const vec2 p = point(i);
            const uint x = uint(p.x * float(1u << a));
            const uint y = uint(p.y * float(1u << (m - a)));
            if (x >= (1u << a) || y >= (1u << (m - a)) || hits[(x << (m - a)) | y]++ != 0) return false;
        }
    }
    return true;
}

/// Largest difference between the share of points and the area of boxes at the origin, over a grid of boxes.
double discrepancy(const Point& point, uint n) {
    double worst = 0.0;
    for (int i = 1; i <= 32; ++i) {
        for (int j = 1; j <= 32; ++j) {
            const double x = i / 32.0 - 0.011;
            const double y = j / 32.0 - 0.007;
            uint inside = 0;
            for (uint k = 0; k < n; ++k) {
                const vec2 p = point(k);
                if (p.x < x && p.y < y) ++inside;
            }
            worst = std::max(worst, std::abs(double(inside) / n - x * y));
        }
    }
    return worst;
}

TEST(Sequence, RadicalInverseMirrorsTheBits) {
    EXPECT_EQ(radical_inverse_base2(0), 0.0f);
    EXPECT_EQ(radical_inverse_base2(1), 0.5f);
    EXPECT_EQ(radical_inverse_base2(2), 0.25f);
    EXPECT_EQ(radical_inverse_base2(3), 0.75f);
    EXPECT_EQ(radical_inverse_base2(6), 0.375f);
}

TEST(Sequence, HammersleyIsANet) {
    EXPECT_TRUE(is_net([](uint i) { return hammersley(i, 256); }, 8));
    EXPECT_LT(discrepancy([](uint i) { return hammersley(i, 1024); }, 1024), 0.005);
}

TEST(Sequence, SobolSecondDimensionHasItsKnownStart) {
    const float expected[] = {0.0f, 0.5f, 0.75f, 0.25f, 0.625f, 0.125f, 0.375f, 0.875f};
    for (uint i = 0; i < 8; ++i) EXPECT_EQ(unit_float(sobol_second(i)), expected[i]) << i;
}

// The butterfly against the sum of direction numbers that defines the sequence.
TEST(Sequence, SobolSecondDimensionIsTheSumOfItsDirectionNumbers) {
    uint index = 1;
    for (int trial = 0; trial < 2000; ++trial) {
        index = hash_uint(index);
        uint expected = 0;
        uint direction = 0x80000000u;
        for (uint rest = index; rest != 0; rest >>= 1) {
            if (rest & 1u) expected ^= direction;
            direction ^= direction >> 1;
        }
        ASSERT_EQ(sobol_second(index), expected) << index;
        ASSERT_EQ(bitfieldReverse(bitfieldReverse(index)), index);
        ASSERT_EQ(bitfieldReverse(index) & 1u, index >> 31);
    }
}

TEST(Sequence, ScramblingKeepsTheNetForEverySeedAndEveryPair) {
    for (uint seed = 0; seed < 50; ++seed) {
        EXPECT_TRUE(is_net([&](uint i) { return sobol_owen(i, seed); }, 8)) << seed;
        EXPECT_TRUE(is_net([&](uint i) { return sobol_owen_pair(i, seed % 5u, seed); }, 8)) << seed;
        // Any aligned run of 2^m points is a net too.
        EXPECT_TRUE(is_net([&](uint i) { return sobol_owen(i + 1024u, seed); }, 8)) << seed;
    }
}

TEST(Sequence, ScrambledPointsAreUniformOverSeeds) {
    const int seeds = 20000;
    for (const uint index : {0u, 1u, 7u, 100u}) {
        std::vector<int> bins(16);
        for (int s = 0; s < seeds; ++s) {
            const vec2 p = sobol_owen(index, uint(s));
            ++bins[size_t(int(p.x * 4.0f) * 4 + int(p.y * 4.0f))];
        }
        double statistic = 0.0;
        for (const int count : bins) statistic += std::pow(count - seeds / 16.0, 2) / (seeds / 16.0);
        EXPECT_LT(statistic, 50.0) << index;  // 15 degrees of freedom
    }
}

TEST(Sequence, PairsOfOneSampleAreIndependent) {
    // Correlation between dimensions of different pairs over seeds.
    const int seeds = 20000;
    double sum = 0.0;
    for (int s = 0; s < seeds; ++s) {
        const vec2 a = sobol_owen_pair(3, 0, uint(s));
        const vec2 b = sobol_owen_pair(3, 1, uint(s));
        sum += (a.x - 0.5) * (b.x - 0.5);
    }
    EXPECT_LT(std::abs(sum / seeds * 12.0), 0.04);
}

TEST(Sequence, SobolConvergesFasterThanChance) {
    EXPECT_LT(discrepancy([](uint i) { return sobol_owen(i, 5); }, 1024), 0.008);
    // A smooth integral: error at 1024 points, averaged over seeds; chance would give 0.009.
    double error = 0.0;
    for (uint seed = 0; seed < 32; ++seed) {
        double sum = 0.0;
        for (uint i = 0; i < 1024; ++i) {
            const vec2 p = sobol_owen(i, seed);
            sum += p.x * p.y;
        }
        error += std::abs(sum / 1024.0 - 0.25) / 32.0;
    }
    EXPECT_LT(error, 2e-4);
}

TEST(Sequence, PixelsHaveDifferentSeeds) {
    std::set<uint> seen;
    for (uint y = 0; y < 64; ++y) {
        for (uint x = 0; x < 64; ++x) seen.insert(pixel_seed(uvec2(x, y), 1u));
    }
    EXPECT_GE(seen.size(), 64u * 64u - 2u);
    EXPECT_NE(pixel_seed(uvec2(1, 2), 1u), pixel_seed(uvec2(2, 1), 1u));
    EXPECT_NE(pixel_seed(uvec2(1, 2), 1u), pixel_seed(uvec2(1, 2), 2u));
}

}  // namespace
}  // namespace candela::shading
