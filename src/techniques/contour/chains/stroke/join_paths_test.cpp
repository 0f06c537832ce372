// SPDX-License-Identifier: MIT
#include "techniques/contour/chains/stroke/line_paths.hpp"

#include <gtest/gtest.h>

namespace estampe::contour {
namespace {

LinePath straight(const glm::vec2& from, const glm::vec2& to, float width_px = 2.0F)
{
    LinePath path;
    for (int i = 0; i <= 4; ++i) {
        path.points.push_back({glm::mix(from, to, 0.25F * static_cast<float>(i)), width_px});
    }
    return path;
}

TEST(JoinPaths, ASquareBecomesOneRingThatStartsWithinASide)
{
    const std::vector<LinePath> joined = join_paths({straight({0, 0}, {40, 0}), straight({40, 40}, {40, 0}),
                                                     straight({40, 40}, {0, 40}), straight({0, 0}, {0, 40})});
    ASSERT_EQ(joined.size(), 1U);
    EXPECT_TRUE(joined[0].is_closed);
    EXPECT_EQ(joined[0].points.front().page_px, joined[0].points.back().page_px);
    EXPECT_EQ(joined[0].points.size(), 17U);
    EXPECT_EQ(joined[0].points.front().page_px, glm::vec2(20, 0));
    for (size_t i = 1; i < joined[0].points.size(); ++i) {
        EXPECT_NEAR(glm::distance(joined[0].points[i - 1].page_px, joined[0].points[i].page_px), 10.0F,
                    1e-3F);
    }
}

TEST(JoinPaths, OfThreeEndsThoseThatEncloseTheThirdAreJoined)
{
    const std::vector<LinePath> joined =
        join_paths({straight({0, 0}, {40, 0}), straight({0, 0}, {30, 30}), straight({0, 40}, {0.5F, 0.5F})});
    ASSERT_EQ(joined.size(), 2U);
    EXPECT_EQ(joined[0].points.size() + joined[1].points.size(), 14U);
    const LinePath& longer = joined[0].points.size() > 5 ? joined[0] : joined[1];
    EXPECT_NE(longer.points.front().page_px, glm::vec2(30, 30));
    EXPECT_NE(longer.points.back().page_px, glm::vec2(30, 30));
}

TEST(JoinPaths, WhatLiesAllAroundOrDiffersStaysApart)
{
    EXPECT_EQ(
        join_paths({straight({0, 0}, {40, 0}), straight({0, 0}, {-20, 30}), straight({0, 0}, {-20, -30})})
            .size(),
        3U);
    EXPECT_EQ(join_paths({straight({0, 0}, {40, 0}), straight({0, 0}, {0, 40}, 4.0F)}).size(), 2U);
    LinePath other = straight({0, 0}, {0, 40});
    other.ink = 3;
    EXPECT_EQ(join_paths({straight({0, 0}, {40, 0}), other}).size(), 2U);
}

TEST(JoinPaths, WithRoundedCornersALineGoesStraightOn)
{
    const std::vector<LinePath> joined = join_paths({straight({-40, 0}, {0, 0}), straight({0, 0}, {0, 40}),
                                                     straight({0, 0}, {40, 10}), straight({0, -40}, {0, 0})},
                                                    rounded_corners);
    ASSERT_EQ(joined.size(), 2U);
    for (const LinePath& path : joined) {
        EXPECT_EQ(path.points.size(), 9U);
        EXPECT_GT(glm::distance(path.points.front().page_px, path.points.back().page_px), 79.0F);
    }
}

TEST(JoinPaths, WithRoundedCornersOnlyLinesOfOneKindAreJoined)
{
    LinePath crease = straight({0, 0}, {40, 0});
    crease.kind = shared::line_crease;
    EXPECT_EQ(join_paths({straight({-40, 0}, {0, 0}), crease}, rounded_corners).size(), 2U);
    EXPECT_EQ(join_paths({straight({-40, 0}, {0, 0}), crease}).size(), 1U);
    const LinePath finer = straight({0, 0}, {40, 0}, 1.5F);
    EXPECT_EQ(join_paths({straight({-40, 0}, {0, 0}), finer}, rounded_corners).size(), 1U);
    EXPECT_EQ(join_paths({straight({-40, 0}, {0, 0}), finer}).size(), 2U);
}

TEST(JoinPaths, AShortPathJoinsWhatIsAtItsEndsWhateverTheBend)
{
    LinePath end_of_slab = straight({40, 0}, {40, 4});
    end_of_slab.kind = shared::line_crease;
    const std::vector<LinePath> slab{straight({0, 0}, {40, 0}), end_of_slab, straight({40, 4}, {0, 4})};
    EXPECT_EQ(join_paths(slab, rounded_corners).size(), 3U);
    JoinRule rule = rounded_corners;
    rule.shortest_px = 6.0F;
    const std::vector<LinePath> joined = join_paths(slab, rule);
    ASSERT_EQ(joined.size(), 1U);
    EXPECT_EQ(joined[0].kind, straight({0, 0}, {40, 0}).kind);
    EXPECT_EQ(joined[0].points.size(), 13U);
}

} // namespace
} // namespace estampe::contour
