// SPDX-License-Identifier: MIT
#include "features/common/wind.hpp"

#include <gtest/gtest.h>

namespace estampe::features {
namespace {

const std::optional<Terrain> no_ground;

Terrain windy_ground()
{
    TerrainDescription ground;
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

TEST(Wind, OneWindReachesAllThatItMoves)
{
    StyleTables style;
    style.wind.towards_deg = -45.0F;
    style.wind.speed_m_per_s = 7.0F;
    StyleTables room;
    expect_all(with_wind(style, no_ground, room), {.speed_m_per_s = 7.0F, .towards_deg = -45.0F});
    EXPECT_EQ(&with_wind(style, no_ground, style), &style);
}

TEST(Wind, TheDefaultWindCopiesNothing)
{
    const StyleTables style;
    StyleTables room;
    EXPECT_EQ(&with_wind(style, no_ground, room), &style);
}

TEST(Wind, OverATerrainItIsTheTerrainsUnlessTheStyleSaysSo)
{
    StyleTables style;
    StyleTables room;
    expect_all(with_wind(style, windy_ground(), room), {.speed_m_per_s = 11.0F, .towards_deg = 30.0F});
    style.wind.from = wind::WindSource::style;
    EXPECT_EQ(&with_wind(style, windy_ground(), room), &style);
}

TEST(Wind, ASpeedOfItsOwnGoesBeforeThatOfTheWind)
{
    EXPECT_EQ(wind::speed_m_per_s({.speed_m_per_s = 3.0F}, -1.0F), 3.0F);
    EXPECT_EQ(wind::speed_m_per_s({.speed_m_per_s = 3.0F}, 0.0F), 0.0F);
    EXPECT_EQ(wind::speed_m_per_s({.speed_m_per_s = 3.0F}, 9.0F), 9.0F);
}

} // namespace
} // namespace estampe::features
