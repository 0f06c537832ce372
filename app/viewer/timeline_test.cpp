// SPDX-License-Identifier: MIT
#include "viewer/studio.hpp"

#include <gtest/gtest.h>

namespace estampe::viewer {
namespace {

TEST(Timeline, LoopsOrStopsAtItsEnd)
{
    Timeline time{.time_s = 1.5, .length_s = 2.0, .speed = 2.0, .is_playing = true};
    time.advance(0.5);
    EXPECT_NEAR(time.time_s, 0.5, 1e-12);
    time.loops = false;
    time.advance(5.0);
    EXPECT_EQ(time.time_s, 2.0);
    EXPECT_FALSE(time.is_playing);
    time.toggle_playing();
    EXPECT_EQ(time.time_s, 0.0) << "it begins again";
}

TEST(Timeline, StandsStillWhereNothingMovesOrPlays)
{
    Timeline time{.time_s = 0.3};
    time.toggle_playing();
    time.advance(1.0);
    EXPECT_EQ(time.time_s, 0.3);
    time.length_s = 1.0;
    time.advance(1.0);
    EXPECT_EQ(time.time_s, 0.3);
    time.seek(7.0);
    EXPECT_EQ(time.time_s, 1.0);
}

TEST(Timeline, WhatHasNoEndIsNotRepeated)
{
    Timeline time{.is_endless = true};
    time.toggle_playing();
    for (int i = 0; i < 100; ++i) {
        time.advance(0.25);
    }
    EXPECT_EQ(time.time_s, 25.0);
    EXPECT_TRUE(time.is_playing);
    time.seek(-1.0);
    EXPECT_EQ(time.time_s, 0.0);
    time.seek(1e6);
    EXPECT_EQ(time.time_s, 1e6);
}

} // namespace
} // namespace estampe::viewer
