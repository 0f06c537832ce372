// SPDX-License-Identifier: MIT
#include "features/lines/lines.hpp"

#include <gtest/gtest.h>

namespace estampe::features {
namespace {

const paper::Window clip_window{{0.0F, 0.0F}, {20.0F, 10.0F}};

VectorStroke stroke_of(std::vector<VectorPoint> points)
{
    return {.points = std::move(points)};
}

TEST(PageClip, WhatLiesOnThePageIsLeftAlone)
{
    VectorStroke ring = stroke_of({{{1, 1}, 1}, {{5, 1}, 1}, {{5, 5}, 1}, {{1, 1}, 1}});
    ring.is_closed = true;
    const auto parts = clipped(ring, clip_window);
    ASSERT_EQ(parts.size(), 1U);
    EXPECT_TRUE(parts[0].is_closed);
    EXPECT_EQ(parts[0].points, ring.points);
}

TEST(PageClip, AStrokeThatLeavesAndComesBackFallsApart)
{
    const auto parts = clipped(
        stroke_of({{{-10, 5}, 0}, {{10, 5}, 1}, {{10, 15}, 1}, {{15, 15}, 1}, {{15, 5}, 1}, {{30, 5}, 2}}),
        clip_window);
    ASSERT_EQ(parts.size(), 2U);
    EXPECT_EQ(parts[0].points, (std::vector<VectorPoint>{{{0, 5}, 0.5F}, {{10, 5}, 1}, {{10, 10}, 1}}));
    ASSERT_EQ(parts[1].points.size(), 3U);
    EXPECT_EQ(parts[1].points[0].page_mm, glm::vec2(15, 10));
    EXPECT_EQ(parts[1].points[2].page_mm, glm::vec2(20, 5));
    EXPECT_NEAR(parts[1].points[2].width_mm, 1.333F, 0.01F);
}

TEST(PageClip, APieceMayCrossThePageWhole)
{
    const auto parts = clipped(stroke_of({{{-10, -10}, 1}, {{30, 30}, 1}}), clip_window);
    ASSERT_EQ(parts.size(), 1U);
    EXPECT_EQ(parts[0].points.front().page_mm, glm::vec2(0, 0));
    EXPECT_EQ(parts[0].points.back().page_mm, glm::vec2(10, 10));
}

TEST(PageClip, AMarginIsLeftBlank)
{
    const paper::Window window{{2.0F, 1.0F}, {18.0F, 9.0F}};
    const auto parts = clipped(stroke_of({{{0, 5}, 1}, {{20, 5}, 1}}), window);
    ASSERT_EQ(parts.size(), 1U);
    EXPECT_EQ(parts[0].points.front().page_mm, glm::vec2(2, 5));
    EXPECT_EQ(parts[0].points.back().page_mm, glm::vec2(18, 5));
    EXPECT_TRUE(clipped(stroke_of({{{1, 0.5F}, 1}, {{15, 0.5F}, 1}}), window).empty());
}

TEST(PageClip, NothingIsLeftBesideThePage)
{
    EXPECT_TRUE(clipped(stroke_of({{{-10, 5}, 1}, {{-1, 5}, 1}}), clip_window).empty());
    EXPECT_TRUE(clipped(stroke_of({{{-5, 5}, 1}, {{10, 20}, 1}}), clip_window).empty());
    EXPECT_TRUE(clipped(stroke_of({{{5, 5}, 1}, {{5, 5}, 1}}), clip_window).empty());
}

} // namespace
} // namespace estampe::features
