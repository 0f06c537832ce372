// SPDX-License-Identifier: MIT
// The light of a time of day: its direction and strength, and the lights that it leaves unchanged.
#include "core/color.hpp"
#include "techniques/light/daylight.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include <estampe/error.hpp>

namespace estampe::light {
namespace {

SunStyle at_hour(float hour)
{
    SunStyle style;
    style.by = SunBy::place;
    style.date = "2026-03-20";
    style.hour = hour;
    return style;
}

Daylight light_at(float hour)
{
    return daylight_of(at_hour(hour)).value();
}

/// A directional light of the scene, its fill, and a lamp.
Lighting scene_lighting()
{
    Lighting lighting;
    lighting.records.resize(3);
    lighting.records[0].type = shared::light_directional;
    lighting.records[0].direction = {1.0F, 0.0F, 0.0F};
    lighting.records[0].color = glm::vec3(0.8F);
    lighting.records[1] = lighting.records[0];
    lighting.records[2].type = shared::light_point;
    lighting.records[2].color = glm::vec3(7.0F);
    lighting.directional_count = 2;
    lighting.ambient = glm::vec3(0.15F);
    return lighting;
}

TEST(Daylight, NoneWhereTheSunStandsByDirection)
{
    EXPECT_FALSE(daylight_of({}));
}

TEST(Daylight, ComesFromEastSouthAndWestOfTheScenesNorth)
{
    // By default north is -z, so east is +x and south +z.
    EXPECT_GT(light_at(8.0F).towards_sun.x, 0.5);
    EXPECT_GT(light_at(12.0F).towards_sun.z, 0.6);
    EXPECT_NEAR(light_at(12.0F).towards_sun.x, 0.0, 1e-6);
    EXPECT_NEAR(light_at(12.0F).towards_sun.y, std::cos(glm::radians(44.84)), 2e-3) << "on an equinox";
    EXPECT_LT(light_at(16.0F).towards_sun.x, -0.5);
    SunStyle style = at_hour(8.0F);
    style.north_deg = 90.0F; // +x; so east is +z
    EXPECT_GT(daylight_of(style)->towards_sun.z, 0.5);
    style = at_hour(12.0F);
    style.latitude_deg = -44.84F;
    EXPECT_LT(daylight_of(style)->towards_sun.z, -0.6) << "in the south the sun is in the north at noon";
}

TEST(Daylight, ClockOfAZoneKnowsLongitude)
{
    SunStyle style = at_hour(12.0F);
    style.clock = Clock::zone;
    style.utc_offset_hours = 1.0F;
    style.longitude_deg = 15.0F;
    const double bearing_of_noon =
        std::atan2(daylight_of(style)->towards_sun.x, daylight_of(style)->towards_sun.z);
    // On 20 March the clock is 7.5 minutes ahead of a sundial, nearly 2 degrees.
    EXPECT_GT(bearing_of_noon, 0.02);
    EXPECT_LT(bearing_of_noon, 0.06);
    style.longitude_deg = 30.0F;
    EXPECT_LT(std::atan2(daylight_of(style)->towards_sun.x, daylight_of(style)->towards_sun.z), -0.2);
}

TEST(Daylight, WeakensAndWarmsTowardsTheEveningAndNeverJumps)
{
    EXPECT_NEAR(luminance(light_at(12.0F).sun), 1.0F, 0.1F);
    Daylight before = light_at(12.0F);
    for (int step = 1; step <= 4320; ++step) { // steps of ten seconds
        const Daylight now = light_at(12.0F + static_cast<float>(step) / 360.0F);
        EXPECT_LE(luminance(now.sun), luminance(before.sun) + 1e-5F);
        EXPECT_GE(luminance(now.moon), luminance(before.moon) - 1e-5F);
        if (now.elevation_rad > 0.0) {
            EXPECT_GE(now.sun.x / now.sun.z, before.sun.x / before.sun.z - 1e-4F) << "redder";
        }
        EXPECT_LT(glm::length(now.sun - before.sun), 0.015F);
        EXPECT_LT(glm::length(now.moon - before.moon), 0.015F);
        EXPECT_LT(glm::length(now.ambient - before.ambient), 0.015F);
        EXPECT_LT(glm::length(now.towards_sun - before.towards_sun), 0.01);
        EXPECT_GT(now.towards_sun.y, 0.05) << "no light from below";
        EXPECT_GT(now.towards_moon.y, 0.05);
        before = now;
    }
    EXPECT_EQ(luminance(before.sun), 0.0F) << "midnight";
    EXPECT_NEAR(luminance(before.moon), SunStyle().moon, 1e-4F);
    EXPECT_GT(before.moon.z, before.moon.x);
    EXPECT_LT(luminance(before.ambient), 0.6F);
}

TEST(Daylight, StandsForTheScenesDirectionalLightsAndLeavesLamps)
{
    const LightStyle style{.fill = 0.25F};
    Lighting noon = scene_lighting();
    set_daylight(noon, light_at(12.0F), style);
    ASSERT_EQ(noon.directional_count, 2U) << "the sun and its fill";
    ASSERT_EQ(noon.records.size(), 3U);
    EXPECT_NEAR(luminance(noon.records[0].color) + luminance(noon.records[1].color), 1.0F, 0.1F);
    EXPECT_NEAR(noon.records[1].color.x / noon.records[0].color.x, 0.25F, 1e-5F);
    EXPECT_NEAR(glm::dot(noon.towards_sun, light_at(12.0F).towards_sun), 1.0, 1e-6);
    EXPECT_EQ(noon.records[2].color.x, 7.0F);

    Lighting night = scene_lighting();
    set_daylight(night, light_at(23.5F), style);
    EXPECT_NEAR(glm::dot(night.towards_sun, light_at(23.5F).towards_moon), 1.0, 1e-6)
        << "the strongest comes first";
    EXPECT_LT(luminance(night.ambient), 0.6F * 0.15F);
    EXPECT_EQ(night.records.back().color.x, 7.0F);
}

TEST(Daylight, StaysOutOfRoomsAndScenesThatAskForTheirOwnLights)
{
    Lighting room = scene_lighting();
    room.indoors = true;
    set_daylight(room, light_at(20.0F), {});
    EXPECT_EQ(room.records[0].color.x, 0.8F);
    Lighting own = scene_lighting();
    set_daylight(own, light_at(20.0F), {.source = LightSource::scene});
    EXPECT_EQ(own.records[0].color.x, 0.8F);
    EXPECT_EQ(own.ambient.x, 0.15F);
}

TEST(Daylight, MoonlessNightKeepsABlackSun)
{
    SunStyle style = at_hour(0.5F);
    style.moon = 0.0F;
    Lighting night = scene_lighting();
    set_daylight(night, daylight_of(style).value(), {});
    EXPECT_GE(night.directional_count, 1U);
    EXPECT_EQ(luminance(night.records[0].color), 0.0F);
}

TEST(Daylight, DateThatIsNoneIsNamedByItsKey)
{
    SunStyle style = at_hour(12.0F);
    style.date = "2026-02-30";
    try {
        static_cast<void>(daylight_of(style));
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("sun.date"), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("2026-02-30"), std::string::npos) << error.what();
    }
}

} // namespace
} // namespace estampe::light
