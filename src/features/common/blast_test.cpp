// SPDX-License-Identifier: MIT
#include "features/common/blast.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace estampe::features {
namespace {

const Blast blast{.centre = {1.0, 2.0, -3.0}, .at_s = 2.0, .start_m3 = 0.5, .growth = 8.0, .rate_per_s = 5.0};

TEST(Blast, GrowsFromItsVolumeByItsFactor)
{
    EXPECT_EQ(blast.volume_m3(-1.0), 0.5);
    EXPECT_EQ(blast.volume_m3(2.0), 0.5);
    EXPECT_NEAR(blast.volume_m3(100.0), 4.0, 1e-9);
    // Numbers of the law itself: the excess of the temperature decays, and heat is kept.
    for (const double after_s : {0.01, 0.2, 1.0}) {
        const double temperature = 1.0 + 7.0 * std::exp(-5.0 * after_s);
        EXPECT_NEAR(blast.volume_m3(2.0 + after_s), 0.5 * 8.0 / temperature, 1e-12);
        const double rate =
            (blast.volume_m3(2.0 + after_s + 1e-6) / blast.volume_m3(2.0 + after_s) - 1.0) / 1e-6;
        EXPECT_NEAR(rate, 5.0 * (1.0 - 1.0 / temperature), 1e-3);
        EXPECT_LT(rate, 5.0);
    }
}

TEST(Blast, KeepsTheVolumeBetweenSpheres)
{
    const glm::dvec3 way = glm::normalize(glm::dvec3(1.0, -2.0, 0.5));
    const auto radius_after = [&](double radius_m) {
        const glm::dvec3 away = blast.pushed(blast.centre + radius_m * way, 0.0, 3.0) - blast.centre;
        EXPECT_NEAR(glm::dot(glm::normalize(away), way), 1.0, 1e-12);
        return glm::length(away);
    };
    const double gained = blast.volume_m3(3.0) - 0.5;
    for (const double radius_m : {0.6, 1.0, 5.0, 40.0}) {
        const double before = 4.0 / 3.0 * std::numbers::pi * std::pow(radius_m, 3.0);
        const double now = 4.0 / 3.0 * std::numbers::pi * std::pow(radius_after(radius_m), 3.0);
        EXPECT_NEAR(now - before, gained, 1e-9 * now) << radius_m;
    }
    EXPECT_NEAR(std::pow(radius_after(0.2) / 0.2, 3.0), blast.volume_m3(3.0) / 0.5, 1e-9)
        << "within the ball";
    // Far away the push falls with the square of the distance.
    EXPECT_NEAR((radius_after(50.0) - 50.0) / (radius_after(100.0) - 100.0), 4.0, 1e-3);
}

TEST(Blast, PushesNothingBeforeItsTimeOrTwice)
{
    const glm::dvec3 place(1.5, 2.5, -3.0);
    EXPECT_EQ(blast.pushed(place, 0.0, 2.0), place);
    EXPECT_EQ(blast.pushed(blast.centre, 0.0, 9.0), blast.centre);
    const glm::dvec3 at_once = blast.pushed(place, 0.0, 4.0);
    const glm::dvec3 in_two = blast.pushed(blast.pushed(place, 0.0, 2.3), 2.3, 4.0);
    EXPECT_LT(glm::distance(at_once, in_two), 1e-12);
}

} // namespace
} // namespace estampe::features
