// SPDX-License-Identifier: MIT
#include "techniques/motion_blur/motion_blur.hpp"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace estampe::motion_blur {
namespace {

/// One draw call of two triangles with areas of 3 to 1, and another draw call of one far smaller triangle.
const std::vector<glm::vec3> places{{0, 0, 0}, {3, 0, 0}, {0, 1, 0},     {5, 0, 0},    {6, 0, 0},
                                    {5, 1, 0}, {9, 0, 0}, {9.01F, 0, 0}, {9, 0.01F, 0}};
const std::vector<glm::uvec4> triangles{{0, 1, 2, 0}, {3, 4, 5, 0}, {6, 7, 8, 1}};
const std::vector<uint32_t> all{0, 1, 2};

TEST(Smear, SpreadsItsSeedsByAreaOverEachDraw)
{
    const std::vector<shared::SmearSeed> seeds = spread_seeds(all, triangles, places);
    ASSERT_EQ(seeds.size(), smear_seed_count);
    std::array<double, 3> count{};
    for (const shared::SmearSeed& seed : seeds) {
        count.at(seed.triangle) += 1.0;
        EXPECT_GE(std::min(seed.weight.x, seed.weight.y), 0.0F);
        EXPECT_LE(seed.weight.x + seed.weight.y, 1.0F);
    }
    EXPECT_NEAR(count[0] / count[1], 3.0, 0.05);
    EXPECT_EQ(count[2], smear_seed_count / 2.0) << "a small draw has as many";
}

TEST(Smear, SpreadsSeedsAlikeTwice)
{
    const std::vector<shared::SmearSeed> seeds = spread_seeds(all, triangles, places);
    const std::vector<shared::SmearSeed> again = spread_seeds(all, triangles, places);
    ASSERT_EQ(seeds.size(), again.size());
    for (size_t i = 0; i < seeds.size(); ++i) {
        EXPECT_EQ(seeds[i].weight, again[i].weight);
        EXPECT_EQ(seeds[i].number, i);
    }
}

TEST(Smear, HasNoSeedsWhereThereIsNoArea)
{
    EXPECT_TRUE(spread_seeds({}, triangles, places).empty());
    const std::vector<glm::vec3> flat(9, glm::vec3(1.0F));
    EXPECT_TRUE(spread_seeds(all, triangles, flat).empty());
}

TEST(Smear, HasAFewSeedsOfEachOfManyDraws)
{
    std::vector<glm::uvec4> many;
    std::vector<uint32_t> of;
    for (uint32_t draw = 0; draw < 1000; ++draw) {
        many.emplace_back(0, 1, 2, draw);
        of.push_back(draw);
    }
    EXPECT_EQ(spread_seeds(of, many, places).size(), 4000U);
}

} // namespace
} // namespace estampe::motion_blur
