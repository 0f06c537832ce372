// SPDX-License-Identifier: MIT
#include "techniques/terrain/trails/trails.hpp"

#include <estampe/error.hpp>
#include <estampe/terrain.hpp>
#include <gtest/gtest.h>

namespace estampe::terrain {
namespace {

TEST(Track, IsReadAndWritten)
{
    const TerrainTrack track =
        parse_track("0,0 3,4 10,-2.5 pace=2 start=-1.5 stride=0.5 foot=0.25 depth=0.1", "rider", "a:1:1");
    EXPECT_EQ(track.path_m.size(), 3U);
    EXPECT_EQ(track.path_m[2], glm::dvec2(10.0, -2.5));
    EXPECT_EQ(track.pace_m_per_s, 2.0);
    EXPECT_EQ(track.start_s, -1.5);
    EXPECT_EQ(parse_track(track_text(track), "rider", ""), track);
    EXPECT_EQ(track_text(parse_track("0,0 1,1", "plain", "")), "0,0 1,1");
    const std::string toml =
        "[terrain]\nheight = 0\n[tracks]\nrider = \"0,0 5,5\"\n[trails]\nextent_m = 20\n";
    const TerrainDescription terrain = parse_terrain(toml, "test.toml");
    EXPECT_EQ(terrain.tracks.at(0).name, "rider");
    EXPECT_EQ(terrain.trails.extent_m, 20.0F);
    const TerrainDescription again = parse_terrain(terrain_toml(terrain), "again.toml");
    EXPECT_EQ(again.tracks, terrain.tracks);
    EXPECT_EQ(again.trails, terrain.trails);
}

TEST(Track, SaysWhatIsWrong)
{
    for (const auto& [text, expected] : {std::pair("0,0", "goes nowhere"),
                                         {"1,1 1,1", "goes nowhere"},
                                         {"0,0 here", "\"here\" is no place"},
                                         {"0,0 1,a", "\"1,a\" is no number"},
                                         {"0,0 nan,1", "is no number"},
                                         {"0,0 1,1 speed=3", "is nothing that a track has"},
                                         {"0,0 1,1 pace=0", "is not from 0.01 to 100"},
                                         {"0,0 1e9,1", "is longer than"}}) {
        try {
            static_cast<void>(parse_track(text, "rider", "test.toml:3:5"));
            ADD_FAILURE() << text;
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
            EXPECT_NE(std::string(error.what()).find("test.toml:3:5"), std::string::npos) << error.what();
        }
    }
}

/// Footprints are left and right in turn, a stride apart, at the walker's pace; without a start time the last
/// one is pressed at time 0.
TEST(Track, IsWalked)
{
    const std::vector<TimedStamp> steps = stamps_of(parse_track("0,0 20,0", "rider", ""));
    ASSERT_EQ(steps.size(), 27U);
    for (size_t i = 0; i < steps.size(); ++i) {
        const glm::dvec2 middle = 0.5 * (steps[i].stamp.from_m + steps[i].stamp.to_m);
        EXPECT_NEAR(middle.x, 0.75 * static_cast<double>(i), 0.06);
        EXPECT_NEAR(middle.y, i % 2 == 0 ? 0.14 : -0.14, 0.045);
        EXPECT_NEAR(steps[i].time_s, -20.0 / 1.4 + 0.75 * static_cast<double>(i) / 1.4, 1e-9);
    }
    const std::vector<TimedStamp> turned = stamps_of(parse_track("0,0 0,9 start=3 pace=1", "rider", ""));
    EXPECT_NEAR(turned[4].stamp.from_m.x, -0.14, 0.06) << "left of one who walks along z is -x";
    EXPECT_NEAR(turned[4].time_s, 6.0, 1e-9);
}

TEST(Track, IsDragged)
{
    const std::vector<TimedStamp> parts = stamps_of(parse_track("0,0 5,5 4,9 drag=0.4", "sledge", ""));
    for (size_t i = 1; i < parts.size(); ++i) {
        EXPECT_NEAR(glm::length(parts[i].stamp.from_m - parts[i - 1].stamp.to_m), 0.0, 1e-9);
        EXPECT_EQ(parts[i].stamp.from_radius_m, 0.2F);
    }
    EXPECT_NEAR(glm::length(parts.back().stamp.to_m - glm::dvec2(4.0, 9.0)), 0.0, 0.4);
}

} // namespace
} // namespace estampe::terrain
