// SPDX-License-Identifier: MIT
#include "techniques/focus/focus.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace estampe::focus {
namespace {

const Window window{.min_px = {10.0F, 20.0F}, .max_px = {410.0F, 320.0F}};
constexpr float pixels_per_mm = 2.0F;

FocusStyle drawn()
{
    FocusStyle style;
    style.enabled = true;
    return style;
}

TEST(FocusLines, AreNoneUnlessWanted)
{
    EXPECT_TRUE(focus_lines({}, window, pixels_per_mm, 0.0).empty());
}

TEST(FocusLines, LieEachInItsTurnAndLeaveTheOvalFree)
{
    FocusStyle style = drawn();
    style.ragged = 0.0F;
    style.clear = 0.5F;
    const auto lines = focus_lines(style, window, pixels_per_mm, 0.0);
    ASSERT_GT(lines.size(), 100U);
    for (size_t i = 0; i < lines.size(); ++i) {
        const shared::FocusLine& line = lines[i];
        float turns = std::atan2(line.outwards.y, line.outwards.x) / 6.2831853F;
        turns = turns < 0.0F ? turns + 1.0F : turns;
        EXPECT_EQ(static_cast<size_t>(turns * static_cast<float>(lines.size())), i);
        const glm::vec2 tip = line.tip_px * line.outwards;
        EXPECT_NEAR(glm::length(tip / glm::vec2(200.0F, 150.0F)), 0.5F, 1e-3F);
        EXPECT_GE(line.end_px, 250.0F);
    }
}

TEST(FocusLines, AreAsFarApartAsAsked)
{
    FocusStyle style = drawn();
    style.spacing_mm = 2.0F;
    const size_t count = focus_lines(style, window, pixels_per_mm, 0.0).size();
    style.spacing_mm = 4.0F;
    const size_t half = focus_lines(style, window, pixels_per_mm, 0.0).size();
    EXPECT_NEAR(static_cast<double>(count) / static_cast<double>(half), 2.0, 0.02);
    EXPECT_NEAR(static_cast<double>(count), 6.2831853 * 225.0 / 4.0, 1.0);
}

TEST(FocusLines, AreTheSameUntilTheyAreDrawnAnew)
{
    FocusStyle style = drawn();
    const auto tips = [&](double time_s) {
        std::vector<float> all;
        for (const shared::FocusLine& line : focus_lines(style, window, pixels_per_mm, time_s)) {
            all.push_back(line.tip_px);
        }
        return all;
    };
    EXPECT_EQ(tips(0.0), tips(5.0));
    style.redraws_per_s = 12.0F;
    EXPECT_EQ(tips(0.0), tips(1.0 / 24.0));
    EXPECT_NE(tips(0.0), tips(2.0 / 24.0));
    EXPECT_EQ(tips(2.0 / 24.0), tips(3.0 / 24.0));
}

TEST(FocusLines, PointWhereTheyAreTold)
{
    FocusStyle style = drawn();
    style.x = 0.25F;
    style.y = 1.0F;
    EXPECT_EQ(middle_px(style, window), glm::vec2(110.0F, 320.0F));
    for (const shared::FocusLine& line : focus_lines(style, window, pixels_per_mm, 0.0)) {
        EXPECT_GE(line.end_px, glm::length(glm::vec2(300.0F, 300.0F)));
    }
}

} // namespace
} // namespace estampe::focus
