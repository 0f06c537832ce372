// SPDX-License-Identifier: MIT
// Crossings of known curves with the pixel grid, linked into strokes again.
#include "techniques/hatch/trace/trace.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include <glm/gtc/packing.hpp>
#include <gtest/gtest.h>

namespace estampe::hatch {
namespace {

constexpr glm::uvec2 size_px(64, 48);

using Height = std::function<float(glm::vec2)>;
using Width = std::function<float(glm::vec2)>;

/// Adds crossings where `height` passes zero between pixels and `width` says that there is a line.
void cross(const Height& height, const Width& width, uint32_t draw, int number,
           std::vector<shared::Crossing>& crossings)
{
    for (uint32_t y = 0; y < size_px.y; ++y) {
        for (uint32_t x = 0; x < size_px.x; ++x) {
            const glm::vec2 here = glm::vec2(x, y) + 0.5F;
            for (uint32_t side = 0; side < 2; ++side) {
                const glm::vec2 beside = here + (side == 0 ? glm::vec2(1, 0) : glm::vec2(0, 1));
                const float a = height(here);
                const float b = height(beside);
                const float share = a / (a - b);
                const float width_px = width(glm::mix(here, beside, share));
                const bool is_on_page = x + 1 - side < size_px.x && y + side < size_px.y;
                if (!is_on_page || (a < 0.0F) == (b < 0.0F) || width_px <= 0.0F) {
                    continue;
                }
                crossings.push_back(
                    {.edge = 2 * (y * size_px.x + x) + side,
                     .draw = draw + 1,
                     .line = 3,
                     .number = number,
                     .place_and_width = static_cast<uint32_t>(std::lround(share * 65535.0F)) |
                                        static_cast<uint32_t>(glm::packHalf1x16(width_px)) << 16U});
            }
        }
    }
}

float one(glm::vec2)
{
    return 1.0F;
}

Height circle(glm::vec2 middle, float radius)
{
    return [=](glm::vec2 p) { return glm::distance(p, middle) - radius; };
}

TEST(Trace, ACircleIsOneClosedStroke)
{
    std::vector<shared::Crossing> crossings;
    cross(circle({30.2F, 24.7F}, 15.0F), one, 5, 1, crossings);
    const std::vector<TracedStroke> strokes = string_crossings(crossings, size_px);
    ASSERT_EQ(strokes.size(), 1U);
    EXPECT_TRUE(strokes[0].is_closed);
    EXPECT_EQ(strokes[0].draw, 5U);
    EXPECT_EQ(strokes[0].family, 3U);
    float length = 0.0F;
    for (size_t i = 0; i < strokes[0].points.size(); ++i) {
        const TracedPoint& point = strokes[0].points[i];
        EXPECT_NEAR(glm::distance(point.page_px, glm::vec2(30.2F, 24.7F)), 15.0F, 0.02F);
        EXPECT_EQ(point.width_px, 1.0F);
        length += i > 0 ? glm::distance(point.page_px, strokes[0].points[i - 1].page_px) : 0.0F;
    }
    EXPECT_NEAR(length, 94.25F, 0.5F);
}

TEST(Trace, AGapMakesTwoEndsAndThePageToo)
{
    std::vector<shared::Crossing> crossings;
    cross([](glm::vec2 p) { return p.y - 20.3F - 0.2F * p.x; },
          [](glm::vec2 p) { return std::abs(p.x - 30.0F) < 4.0F ? 0.0F : 0.5F; }, 0, 1, crossings);
    const std::vector<TracedStroke> strokes = string_crossings(crossings, size_px);
    ASSERT_EQ(strokes.size(), 2U);
    for (const TracedStroke& stroke : strokes) {
        EXPECT_FALSE(stroke.is_closed);
        const auto [low, high] = std::minmax(stroke.points.front().page_px.x, stroke.points.back().page_px.x);
        EXPECT_NEAR(low, low < 30.0F ? 0.5F : 34.0F, 1.0F);
        EXPECT_NEAR(high, high < 30.0F ? 26.0F : 63.5F, 1.0F);
    }
}

TEST(Trace, LinesOfOtherNumbersAndDrawsAreOther)
{
    std::vector<shared::Crossing> crossings;
    cross([](glm::vec2 p) { return p.y - 20.3F; }, one, 0, 1, crossings);
    cross([](glm::vec2 p) { return p.y - 20.4F; }, one, 0, 3, crossings);
    cross([](glm::vec2 p) { return p.y - 20.6F; }, one, 1, 1, crossings);
    const std::vector<TracedStroke> strokes = string_crossings(crossings, size_px);
    ASSERT_EQ(strokes.size(), 3U);
    for (const TracedStroke& stroke : strokes) {
        EXPECT_NEAR(std::abs(stroke.points.front().page_px.x - stroke.points.back().page_px.x), 63.0F, 0.01F);
    }
}

TEST(Trace, OrderOfTheListDoesNotMatter)
{
    std::vector<shared::Crossing> crossings;
    for (int i = 0; i < 8; ++i) {
        cross(circle({20.0F + 3.0F * static_cast<float>(i), 24.0F}, 9.3F), one, 0, i % 2, crossings);
    }
    const std::vector<TracedStroke> first = string_crossings(crossings, size_px);
    std::shuffle(crossings.begin(), crossings.end(), std::mt19937(1));
    const std::vector<TracedStroke> second = string_crossings(crossings, size_px);
    ASSERT_EQ(first.size(), second.size());
    for (size_t i = 0; i < first.size(); ++i) {
        ASSERT_EQ(first[i].points.size(), second[i].points.size());
        for (size_t k = 0; k < first[i].points.size(); ++k) {
            EXPECT_EQ(first[i].points[k].page_px, second[i].points[k].page_px);
        }
    }
}

TEST(Trace, NoCrossingsNoStrokes)
{
    EXPECT_TRUE(string_crossings({}, size_px).empty());
}

} // namespace
} // namespace estampe::hatch
