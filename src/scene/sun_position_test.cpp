// SPDX-License-Identifier: MIT
// The position of the sun, compared with published values and with the known solstices and equinoxes.
#include "scene/light_sources.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <estampe/error.hpp>

namespace estampe {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

/// The greatest elevation of the sun, sampled every half minute.
double highest_deg(const Date& date, double latitude_deg, double longitude_deg)
{
    double highest = -90.0;
    for (double hours = -12.0; hours < 36.0; hours += 1.0 / 120.0) {
        const SunPosition sun = sun_position(date, hours, latitude_deg, longitude_deg);
        highest = std::max(highest, sun.elevation_rad / degree);
    }
    return highest;
}

TEST(SunPosition, DeclinationOfMeeusExample)
{
    // Example 24.a: 1992 October 13, 0 h: declination -7.78507 degrees. Example 27.b: the equation of time of
    // that moment is 13 min 42.7 s.
    const SunPosition sun = sun_position({1992, 10, 13}, 0.0, 0.0, 0.0);
    EXPECT_NEAR(sun.declination_rad / degree, -7.78507, 0.001);
    EXPECT_NEAR(sun.equation_of_time_hours * 3600.0, 13 * 60 + 42.7, 2.0);
}

TEST(SunPosition, ExampleOfTheSolarPositionAlgorithmsReport)
{
    // Reda and Andreas, NREL/TP-560-34302: 2003 October 17, 12:30:30, seven hours behind universal time;
    // zenith angle 50.11162 including refraction, azimuth 194.34024 degrees.
    const SunPosition sun = sun_position({2003, 10, 17}, 12.0 + 30.5 / 60.0 + 7.0, 39.742476, -105.1786);
    const double seen_rad = sun.elevation_rad + refraction_rad(sun.elevation_rad);
    EXPECT_NEAR(90.0 - seen_rad / degree, 50.11162, 0.02);
    EXPECT_NEAR(sun.azimuth_rad / degree, 194.34024, 0.02);
}

TEST(SunPosition, NoonOfTheSolsticesByLatitude)
{
    for (const double latitude : {-33.9, 0.0, 44.84, 60.0}) {
        EXPECT_NEAR(highest_deg({2026, 6, 21}, latitude, 11.6), 90.0 - std::abs(latitude - 23.44), 0.05);
        EXPECT_NEAR(highest_deg({2026, 12, 21}, latitude, -70.0), 90.0 - std::abs(latitude + 23.44), 0.05);
    }
}

TEST(SunPosition, EquinoxRisesDueEastAndSetsDueWest)
{
    // 2026 March 20, 14:46 universal time.
    for (const double latitude : {-40.0, 10.0, 51.5}) {
        const SunPosition rising = sun_position_by_sundial({2026, 3, 20}, 6.0, latitude);
        EXPECT_NEAR(rising.azimuth_rad / degree, 90.0, 0.3);
        EXPECT_NEAR(rising.elevation_rad / degree, 0.0, 0.2);
        const SunPosition setting = sun_position_by_sundial({2026, 3, 20}, 18.0, latitude);
        EXPECT_NEAR(setting.azimuth_rad / degree, 270.0, 0.3);
        EXPECT_NEAR(setting.elevation_rad / degree, 0.0, 0.2);
    }
    EXPECT_NEAR(sun_position({2026, 3, 20}, 14.0 + 46.0 / 60.0, 0.0, 0.0).declination_rad / degree, 0.0,
                0.01);
}

TEST(SunPosition, NeitherSetsNorRisesBeyondThePolarCircles)
{
    for (double hour = 0.0; hour < 24.0; hour += 0.5) {
        EXPECT_GT(sun_position({2026, 6, 21}, hour, 70.0, 25.0).elevation_rad, 0.0);
        EXPECT_LT(sun_position({2026, 6, 21}, hour, -70.0, 25.0).elevation_rad, 0.0);
    }
    // At the pole the sun circles at constant elevation.
    EXPECT_NEAR(sun_position({2026, 6, 21}, 3.0, 90.0, 0.0).elevation_rad / degree, 23.44, 0.01);
    EXPECT_NEAR(sun_position({2026, 6, 21}, 17.0, 90.0, 0.0).elevation_rad / degree, 23.44, 0.01);
}

TEST(SunPosition, SundialAndClockAgree)
{
    const double longitude = 11.62;
    for (const Date& date : {Date{2026, 2, 11}, Date{2026, 11, 3}}) {
        for (const double hour : {5.0, 9.5, 12.0, 16.25}) {
            const SunPosition sundial = sun_position_by_sundial(date, hour, 44.84);
            const double clock = hour - sundial.equation_of_time_hours - longitude / 15.0;
            const SunPosition sun = sun_position(date, clock, 44.84, longitude);
            EXPECT_NEAR(sun.azimuth_rad, sundial.azimuth_rad, 5e-4);
            EXPECT_NEAR(sun.elevation_rad, sundial.elevation_rad, 5e-4);
        }
        EXPECT_NEAR(sun_position_by_sundial(date, 12.0, 44.84).azimuth_rad, std::numbers::pi, 1e-9);
    }
}

TEST(SunPosition, GoesRoundByEastSouthAndWestInTheNorth)
{
    const Date date{2026, 9, 1};
    const auto azimuth = [&](double hour, double latitude) {
        return sun_position_by_sundial(date, hour, latitude).azimuth_rad / degree;
    };
    EXPECT_GT(azimuth(9.0, 45.0), 90.0);
    EXPECT_LT(azimuth(9.0, 45.0), 180.0);
    EXPECT_GT(azimuth(15.0, 45.0), 180.0);
    EXPECT_LT(azimuth(15.0, 45.0), 270.0);
    EXPECT_GT(azimuth(9.0, -45.0), 0.0);
    EXPECT_LT(azimuth(9.0, -45.0), 90.0);
    EXPECT_NEAR(std::remainder(azimuth(12.0, -45.0), 360.0), 0.0, 1e-9);
}

TEST(SunPosition, AirBendsLightMostAtTheHorizon)
{
    EXPECT_NEAR(refraction_rad(0.0) / degree * 60.0, 28.98, 0.1) << "minutes of arc, from the true height";
    EXPECT_NEAR(refraction_rad(10.0 * degree) / degree * 60.0, 5.3, 0.15);
    EXPECT_NEAR(refraction_rad(45.0 * degree) / degree * 60.0, 1.0, 0.03);
    EXPECT_NEAR(refraction_rad(90.0 * degree), 0.0, 1e-5);
    for (double deg = -90.0; deg < 90.0; deg += 0.25) {
        EXPECT_GE(refraction_rad(deg * degree), 0.0);
        EXPECT_LT(refraction_rad(deg * degree), 0.8 * degree);
    }
}

TEST(SunPosition, LowSunIsWeakAndRed)
{
    EXPECT_NEAR(sunlight_through_air(90.0 * degree, 0.06).x, 1.0, 1e-3);
    glm::dvec3 before(0.0);
    for (double deg = 0.0; deg <= 90.0; deg += 1.0) {
        const glm::dvec3 light = sunlight_through_air(deg * degree, 0.06);
        EXPECT_GE(light.x, light.y);
        EXPECT_GE(light.y, light.z);
        EXPECT_TRUE(glm::all(glm::greaterThanEqual(light, before)));
        EXPECT_TRUE(glm::all(glm::greaterThan(light, sunlight_through_air(deg * degree, 0.3) - 1e-12)));
        before = light;
    }
    // At 30 degrees the air mass is two (Kasten and Young's table: 1.9942), one more than overhead.
    EXPECT_NEAR(-std::log(sunlight_through_air(30.0 * degree, 0.0).y),
                0.9942 * 0.008735 * std::pow(0.55, -4.08), 1e-4);
}

TEST(SunPosition, DatesThatAreNoneAreRefused)
{
    EXPECT_EQ(parse_date("2028-02-29").day, 29);
    EXPECT_EQ(parse_date("1583-12-01").month, 12);
    for (const char* text :
         {"", "2026", "2026-13-01", "2026-02-29", "2100-02-29", "1500-01-01", "26-06-21", "2026-06-31",
          "2026/06/21", "2026-6-21", "2026-00-10", "20 6-06-21", "2026-06-2x", "2026-06-211", "-026-06-21"}) {
        EXPECT_THROW(static_cast<void>(parse_date(text)), Error) << text;
    }
}

} // namespace
} // namespace estampe
