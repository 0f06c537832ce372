// SPDX-License-Identifier: MIT
#include "features/common/style_tables.hpp"

#include <gtest/gtest.h>

namespace estampe::features {
namespace {

const Terrain* const no_ground = nullptr;

Terrain windy_ground()
{
    TerrainDescription ground = parse_terrain("[terrain]\nheight = 0\n", "flat.toml");
    ground.wind = {.towards_deg = 30.0F, .speed_m_per_s = 11.0F};
    return Terrain(ground);
}

void expect_all(const StyleTables& style, const wind::Wind& wind)
{
    EXPECT_EQ(style.hatch.wind, wind);
    EXPECT_EQ(style.clouds.wind, wind);
    EXPECT_EQ(style.smoke.wind, wind);
    EXPECT_EQ(style.particles.wind, wind);
    EXPECT_EQ(style.wind.towards_deg, wind.towards_deg);
    EXPECT_EQ(style.wind.speed_m_per_s, wind.speed_m_per_s);
}

TEST(SharedSections, OneWindReachesAllThatItMoves)
{
    StyleTables style;
    style.wind.towards_deg = -45.0F;
    style.wind.speed_m_per_s = 7.0F;
    StyleTables room;
    expect_all(with_shared_sections(style, no_ground, room), {.speed_m_per_s = 7.0F, .towards_deg = -45.0F});
    EXPECT_EQ(&with_shared_sections(style, no_ground, style), &style);
}

TEST(SharedSections, TheDefaultWindCopiesNothing)
{
    const StyleTables style;
    StyleTables room;
    EXPECT_EQ(&with_shared_sections(style, no_ground, room), &style);
}

TEST(SharedSections, OverATerrainItIsTheTerrainsUnlessTheStyleSaysSo)
{
    const Terrain ground = windy_ground();
    StyleTables style;
    StyleTables room;
    expect_all(with_shared_sections(style, &ground, room), {.speed_m_per_s = 11.0F, .towards_deg = 30.0F});
    style.wind.from = wind::WindSource::style;
    EXPECT_EQ(&with_shared_sections(style, &ground, room), &style);
}

TEST(SharedSections, ASpeedOfItsOwnGoesBeforeThatOfTheWind)
{
    EXPECT_EQ(wind::speed_m_per_s({.speed_m_per_s = 3.0F}, -1.0F), 3.0F);
    EXPECT_EQ(wind::speed_m_per_s({.speed_m_per_s = 3.0F}, 0.0F), 0.0F);
    EXPECT_EQ(wind::speed_m_per_s({.speed_m_per_s = 3.0F}, 9.0F), 9.0F);
}

TEST(SharedSections, FadingWithDistanceReachesPaintAndHatching)
{
    StyleTables style;
    style.haze.tint = 0.5F;
    style.haze.tint_color = {0.1F, 0.2F, 0.3F};
    style.haze.tint_distance_m = 40.0F;
    style.haze.hatching = 0.25F;
    style.haze.hatching_distance_m = 70.0F;
    StyleTables room;
    const StyleTables& told = with_shared_sections(style, no_ground, room);
    EXPECT_EQ(told.wash.air, 0.5F);
    EXPECT_EQ(told.wash.air_color, style.haze.tint_color);
    EXPECT_EQ(told.wash.air_distance_m, 40.0F);
    EXPECT_EQ(told.hatch.fade, 0.25F);
    EXPECT_EQ(told.hatch.fade_distance_m, 70.0F);
}

} // namespace
} // namespace estampe::features
