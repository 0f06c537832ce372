// SPDX-License-Identifier: MIT
#include "temple/weather.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace temple {
namespace {

TEST(Weather, IsContinuousAndWithinItsBounds)
{
    for (const uint64_t seed : {1U, 2U, 9U}) {
        const WeatherTimeline timeline(seed, {.hours_a_minute = 1.2F});
        constexpr double step_s = 0.05;
        Weather before = timeline.at(0.0);
        for (int i = 1; i < 6000; ++i) {
            const Weather now = timeline.at(step_s * i);
            ASSERT_GE(now.wind_m_per_s, calm_m_per_s);
            ASSERT_LE(now.wind_m_per_s, strongest_m_per_s);
            ASSERT_LT(std::abs(now.wind_m_per_s - before.wind_m_per_s), 0.5F) << i;
            for (const auto share : {&Weather::gusts, &Weather::dust, &Weather::clouds}) {
                ASSERT_GE(now.*share, 0.0F);
                ASSERT_LE(now.*share, 1.0F);
                ASSERT_LT(std::abs(now.*share - before.*share), 0.06F) << i;
            }
            const float strength = now.tornado.strength;
            ASSERT_LT(std::abs(strength - before.tornado.strength), 0.03F) << i;
            if (strength > 0.0F && before.tornado.strength > 0.0F) {
                ASSERT_LT(glm::distance(now.tornado.foot_m, before.tornado.foot_m), 25.0F * 0.05F) << i;
            }
            ASSERT_LT(std::abs(*now.hour - *before.hour), 0.01F);
            before = now;
        }
    }
}

TEST(Weather, StormsRiseCloseTheViewAndPass)
{
    for (const uint64_t seed : {1U, 2U, 9U}) {
        const WeatherTimeline timeline(seed, {});
        EXPECT_LT(timeline.at(0.0).dust, 0.01F);
        EXPECT_LT(timeline.at(20.0).dust, 0.01F);
        EXPECT_GT(timeline.at(38.0).dust, 0.99F);
        EXPECT_LT(timeline.at(60.0).dust, 0.05F) << "within a minute's film";
        // Further storms come and go.
        int storms = 0;
        bool is_in = false;
        for (double time_s = 0.0; time_s < 600.0; time_s += 0.5) {
            const float dust = timeline.at(time_s).dust;
            storms += !is_in && dust > 0.5F ? 1 : 0;
            is_in = is_in ? dust > 0.02F : dust > 0.5F;
        }
        EXPECT_GE(storms, 7);
        EXPECT_LE(storms, 9);
    }
}

TEST(Weather, ATornadoComesBeforeTheStormAndGoesInIt)
{
    const WeatherTimeline timeline(1, {});
    EXPECT_EQ(timeline.at(5.0).tornado.strength, 0.0F);
    EXPECT_GT(timeline.at(26.0).tornado.strength, 0.95F);
    EXPECT_EQ(timeline.at(50.0).tornado.strength, 0.0F);
    const glm::vec2 walked = timeline.at(40.0).tornado.foot_m - timeline.at(20.0).tornado.foot_m;
    EXPECT_GT(glm::dot(walked, wind_way()), 40.0F) << "with the wind";
}

TEST(Weather, TheWindHasBlownAsFarAsItsSpeedSays)
{
    const WeatherTimeline timeline(3, {});
    double way_m = timeline.at(30.0).blown_m;
    constexpr double step_s = 0.01;
    for (int i = 0; i < 1500; ++i) {
        way_m += step_s * static_cast<double>(timeline.at(30.0 + (i + 0.5) * step_s).wind_m_per_s);
    }
    EXPECT_NEAR(timeline.at(45.0).blown_m, way_m, 0.05);
}

TEST(Weather, IsWhatItIsToldToBe)
{
    const auto told = [](WeatherKind kind) { return WeatherTimeline(1, {.kind = kind}); };
    for (const double time_s : {0.0, 12.0, 38.0, 200.0}) {
        const Weather calm = told(WeatherKind::calm).at(time_s);
        EXPECT_EQ(calm.dust, 0.0F);
        EXPECT_EQ(calm.gusts, 0.0F);
        EXPECT_EQ(calm.wind_m_per_s, calm_m_per_s);
        EXPECT_GE(told(WeatherKind::gusts).at(time_s).gusts, 0.3F);
        EXPECT_EQ(told(WeatherKind::gusts).at(time_s).dust, 0.0F);
        EXPECT_EQ(told(WeatherKind::storm).at(time_s).dust, 1.0F);
        EXPECT_EQ(told(WeatherKind::tornado).at(time_s).tornado.strength, 1.0F);
        EXPECT_FALSE(calm.hour);
    }
    EXPECT_EQ(weather_named("tornado"), WeatherKind::tornado);
    EXPECT_FALSE(weather_named("fog"));
    EXPECT_EQ(WeatherTimeline(1, {.hour = 8.5F}).at(100.0).hour, 8.5F);
    EXPECT_GT(*WeatherTimeline(1, {.hour = 8.5F, .hours_a_minute = 1.2F}).at(100.0).hour, 9.0F);
}

TEST(Weather, TheSunStandsForFourPicturesOfAFilmAndFallsBackByNoMore)
{
    constexpr double hours_a_s = 1.2 / 60.0;
    constexpr double picture_s = 1.0 / 24.0;
    const WeatherTimeline timeline(1, {.hour = 9.0F, .hours_a_minute = 1.2F});
    EXPECT_EQ(timeline.at(0.0).hour, 9.0F);
    for (int i = 0; i < 1440; ++i) {
        const float hour = *timeline.at(i * picture_s).hour;
        EXPECT_EQ(hour == *timeline.at((i + 1) * picture_s).hour, i % 4 != 3) << i;
        EXPECT_NEAR(hour, 9.0 + hours_a_s * (i - i % 4) * picture_s, 1e-6) << i;
    }
}

TEST(Weather, IsTheSameForTheSameSeed)
{
    for (const double time_s : {3.0, 71.3, 500.0}) {
        EXPECT_EQ(WeatherTimeline(4, {}).at(time_s).wind_m_per_s,
                  WeatherTimeline(4, {}).at(time_s).wind_m_per_s);
    }
    EXPECT_NE(WeatherTimeline(4, {}).at(71.3).gusts, WeatherTimeline(5, {}).at(71.3).gusts);
}

} // namespace
} // namespace temple
