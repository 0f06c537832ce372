// SPDX-License-Identifier: MIT
#include "techniques/tam/painted/painted_strokes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "techniques/tam/stroke.hpp"

namespace estampe::tam {
namespace {

constexpr uint32_t size_px = 128;

/// Draws a straight line of a given width, in texels, into an image that wraps.
void line(Gray8& image, glm::vec2 from, glm::vec2 to, float width_px)
{
    const glm::vec2 along = glm::normalize(to - from);
    const float length = glm::length(to - from);
    for (int y = -40; y < 168; ++y) {
        for (int x = -40; x < 168; ++x) {
            const glm::vec2 place = glm::vec2(x, y) + 0.5F - from;
            const float reach = glm::dot(place, along);
            const float across = std::abs(along.x * place.y - along.y * place.x);
            if (reach >= 0.0F && reach <= length && across <= 0.5F * width_px) {
                image[size_t{static_cast<uint32_t>(y) % size_px} * size_px +
                      static_cast<uint32_t>(x) % size_px] = 255;
            }
        }
    }
}

Gray8 paper()
{
    return Gray8(size_t{size_px} * size_px);
}

float length_px(const PaintedStroke& stroke)
{
    return glm::length(stroke.points.back() - stroke.points.front()) * static_cast<float>(size_px);
}

/// Length from tip to tip: the centre line ends half a width before each tip.
float whole_length_px(const PaintedStroke& stroke)
{
    return length_px(stroke) + stroke.half_px.front() + stroke.half_px.back();
}

float mean_width_px(const PaintedStroke& stroke)
{
    return 2.0F * std::accumulate(stroke.half_px.begin(), stroke.half_px.end(), 0.0F) /
           static_cast<float>(stroke.half_px.size());
}

TEST(PaintedStrokes, FindsALineWithItsLengthAndWidth)
{
    for (const float width_px : {2.0F, 3.0F, 6.0F}) {
        Gray8 image = paper();
        line(image, {20.0F, 30.0F}, {90.0F, 55.0F}, width_px);
        const std::vector<PaintedStroke> strokes = find_strokes({}, image, size_px);
        ASSERT_EQ(strokes.size(), 1U) << width_px;
        EXPECT_NEAR(whole_length_px(strokes[0]), 74.3F, 3.0F);
        EXPECT_NEAR(mean_width_px(strokes[0]), width_px, 0.2F * width_px);
    }
}

TEST(PaintedStrokes, FindsALineAcrossTheEdge)
{
    Gray8 image = paper();
    line(image, {100.0F, 60.0F}, {160.0F, 64.0F}, 3.0F);
    const std::vector<PaintedStroke> strokes = find_strokes({}, image, size_px);
    ASSERT_EQ(strokes.size(), 1U);
    EXPECT_NEAR(whole_length_px(strokes[0]), 60.1F, 3.0F);
}

TEST(PaintedStrokes, TellsLinesThatCrossApart)
{
    Gray8 image = paper();
    line(image, {20.0F, 40.0F}, {100.0F, 60.0F}, 3.0F);
    line(image, {50.0F, 20.0F}, {70.0F, 90.0F}, 3.0F);
    const std::vector<PaintedStroke> strokes = find_strokes({}, image, size_px);
    ASSERT_GE(strokes.size(), 2U);
    EXPECT_GT(length_px(strokes[0]), 70.0F);
    EXPECT_GT(length_px(strokes[1]), 60.0F);
}

TEST(PaintedStrokes, FollowsAStrokeOverLighterOnes)
{
    Gray8 lighter = paper();
    for (int i = 0; i < 9; ++i) {
        const float y = 8.0F + 13.0F * static_cast<float>(i);
        line(lighter, {0.0F, y}, {127.0F, y + 3.0F}, 3.0F);
    }
    Gray8 darker = lighter;
    line(darker, {40.0F, 12.0F}, {62.0F, 110.0F}, 3.0F);
    const std::vector<PaintedStroke> strokes = find_strokes(lighter, darker, size_px);
    ASSERT_GE(strokes.size(), 1U);
    EXPECT_GT(length_px(strokes[0]), 90.0F);
}

TEST(PaintedStrokes, ThinsToLinesThatTouchTheSameThings)
{
    Gray8 image = paper();
    line(image, {20.0F, 40.0F}, {100.0F, 60.0F}, 7.0F);
    std::vector<uint8_t> mask(image.size());
    std::transform(image.begin(), image.end(), mask.begin(), [](uint8_t texel) { return texel > 0 ? 1 : 0; });
    const std::vector<uint8_t> before = mask;
    thin(mask, size_px);
    size_t left = 0;
    for (size_t texel = 0; texel < mask.size(); ++texel) {
        EXPECT_LE(mask[texel], before[texel]);
        left += mask[texel];
    }
    EXPECT_NEAR(static_cast<double>(left), 78.0, 8.0);
}

TEST(PaintedStrokes, CopesWithNoise)
{
    Gray8 image = paper();
    Random random(9);
    std::generate(image.begin(), image.end(), [&] { return static_cast<uint8_t>(random.bits()); });
    for (const PaintedStroke& stroke : find_strokes({}, image, size_px)) {
        ASSERT_EQ(stroke.points.size(), stroke.half_px.size());
        ASSERT_GE(stroke.points.size(), 3U);
    }
    EXPECT_TRUE(find_strokes({}, paper(), size_px).empty());
    static_cast<void>(find_strokes({}, Gray8(size_t{size_px} * size_px, 255), size_px));
}

} // namespace
} // namespace estampe::tam
