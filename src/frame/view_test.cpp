// SPDX-License-Identifier: MIT
#include "frame/view.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace estampe::frame {
namespace {

/// A row of places one metre apart, from one metre on.
std::vector<glm::vec3> row(int count)
{
    std::vector<glm::vec3> places;
    for (int i = 1; i <= count; ++i) {
        places.emplace_back(0.0F, 0.0F, static_cast<float>(i));
    }
    return places;
}

TEST(Nearby, IsWhereTheNearestFifthEnds)
{
    EXPECT_NEAR(nearby(row(1000), glm::vec3(0.0F)), 200.0F, 2.0F);
    EXPECT_NEAR(nearby(row(50000), glm::vec3(0.0F)), 10000.0F, 30.0F);
    EXPECT_EQ(nearby({}, glm::vec3(0.0F)), 0.0F);
}

TEST(Nearby, ChangesAsLittleAsTheEyeMoves)
{
    const std::vector<glm::vec3> places = row(2000);
    float before = nearby(places, glm::vec3(0.0F));
    for (int step = 1; step < 200; ++step) {
        const float now = nearby(places, {0.0F, 0.0F, 0.5F * static_cast<float>(step)});
        EXPECT_LE(std::abs(now - before), 0.5F + 1e-3F);
        before = now;
    }
}

} // namespace
} // namespace estampe::frame
