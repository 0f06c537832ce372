// SPDX-License-Identifier: MIT
#include "frame/page.hpp"

#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <estampe/error.hpp>

#include "features/common/style_tables.hpp"

namespace estampe::frame {
namespace {

bool holds(const features::PixelRect& outer, const features::PixelRect& inner)
{
    return glm::all(glm::lessThanEqual(outer.from_px, inner.from_px)) &&
           glm::all(glm::greaterThanEqual(outer.from_px + outer.size_px, inner.from_px + inner.size_px));
}

/// `rect` with the overlap around it, clamped to the page.
features::PixelRect with_overlap(const features::PixelRect& rect, uint32_t overlap, glm::uvec2 page_px)
{
    const glm::uvec2 from = rect.from_px - glm::min(rect.from_px, glm::uvec2(overlap));
    return {from, glm::min(rect.from_px + rect.size_px + overlap, page_px) - from};
}

TEST(Tiles, TogetherAreThePageAndHaveWhatTheyHangOn)
{
    std::mt19937 random(7);
    const auto number = [&](uint32_t least, uint32_t most) {
        return std::uniform_int_distribution<uint32_t>(least, most)(random);
    };
    for (int round = 0; round < 300; ++round) {
        const glm::uvec2 page(number(1, 200), number(1, 200));
        const uint32_t overlap = number(0, 12);
        const uint32_t most = number(2 * overlap + 1, 90);
        std::vector<int> kept(size_t{page.x} * page.y, 0);
        const std::vector<Tile> tiles = tiles_of(page, most, overlap);
        for (const Tile& tile : tiles) {
            EXPECT_EQ(tile.drawn.size_px, tiles.front().drawn.size_px);
            EXPECT_LE(std::max(tile.drawn.size_px.x, tile.drawn.size_px.y), most);
            EXPECT_TRUE(holds({.size_px = page}, tile.drawn));
            EXPECT_TRUE(holds(tile.drawn, with_overlap(tile.kept, overlap, page)));
            for (uint32_t y = 0; y < tile.kept.size_px.y; ++y) {
                for (uint32_t x = 0; x < tile.kept.size_px.x; ++x) {
                    ++kept[size_t{tile.kept.from_px.y + y} * page.x + tile.kept.from_px.x + x];
                }
            }
        }
        EXPECT_EQ(std::ranges::count(kept, 1), static_cast<std::ptrdiff_t>(kept.size()));
    }
}

TEST(Tiles, AreNotMadeWhereNothingOfThemWouldBeLeft)
{
    EXPECT_THROW(std::ignore = tiles_of({100, 100}, 20, 10), Error);
    EXPECT_NO_THROW(std::ignore = tiles_of({100, 100}, 21, 10));
}

TEST(Tiles, ACropPutsPlacesOfThePageWhereTheTileHasThem)
{
    const glm::uvec2 page(640, 480);
    const features::PixelRect part{.from_px = {96, 300}, .size_px = {128, 64}};
    for (const glm::dvec2 place_px : {glm::dvec2(96.0, 300.0), glm::dvec2(150.25, 320.5)}) {
        const glm::dvec2 ndc = 2.0 * place_px / glm::dvec2(page) - 1.0;
        const glm::dvec4 clip = features::crop_of(part, page) * glm::dvec4(3.0 * ndc, 1.0, 3.0);
        const glm::dvec2 in_tile_px = 0.5 * (glm::dvec2(clip) / clip.w + 1.0) * glm::dvec2(part.size_px);
        EXPECT_NEAR(in_tile_px.x, place_px.x - 96.0, 1e-9);
        EXPECT_NEAR(in_tile_px.y, place_px.y - 300.0, 1e-9);
    }
    EXPECT_EQ(features::crop_of({.size_px = page}, page), glm::dmat4(1.0));
}

TEST(Tiles, ASurveyIsAsFineAsItMayBeAndHoldsThePage)
{
    EXPECT_EQ(survey_of({640, 480}, 16384, 1U << 24U).shrink, 1U);
    const features::Survey survey = survey_of({12000, 17001}, 16384, 1U << 24U);
    EXPECT_EQ(survey.shrink, 4U);
    EXPECT_EQ(survey.size_px(), glm::uvec2(3000, 4251));
    EXPECT_EQ(survey.part.size_px, glm::uvec2(12000, 17004));
    EXPECT_EQ(survey_of({17000, 64}, 16384, 1U << 24U).shrink, 2U);
}

TEST(Tiles, OverlapAsFarAsInkRuns)
{
    features::StyleTables style;
    style.contour.enabled = false;
    style.hatch.halo_mm = style.sky.halo_mm = 0.0F;
    const uint32_t least = overlap_px(style, 10.0F);
    EXPECT_LT(least, 8U);
    style.hatch.overrun_mm = 1.0F;
    EXPECT_GE(overlap_px(style, 10.0F), least + 10U);
    const uint32_t with_overrun = overlap_px(style, 10.0F);
    style.hatch.loose_mm = 2.0F;
    EXPECT_GE(overlap_px(style, 10.0F), with_overrun + 20U);
    style.hatch.loose_mm = 0.0F;
    style.bleed = {.enabled = true, .width_mm = 1.0F};
    EXPECT_GE(overlap_px(style, 10.0F), with_overrun + 12U);
    EXPECT_GT(overlap_px(style, 20.0F), overlap_px(style, 10.0F));
    const uint32_t with_bleed = overlap_px(style, 10.0F);
    style.sky.halo_mm = 3.0F;
    EXPECT_GE(overlap_px(style, 10.0F), with_bleed + 30U);
    const uint32_t with_halo = overlap_px(style, 10.0F);
    style.hatch.groups = 4;
    style.hatch.group_area_mm2 = 4.0F;
    EXPECT_GE(overlap_px(style, 10.0F), with_halo + 80U);
}

} // namespace
} // namespace estampe::frame
