// SPDX-License-Identifier: MIT
#include "scene/light_sources.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace estampe {
namespace {

/// A spot with full light within 0.2 radians of straight down, and none beyond 0.6.
SpotBeam spot(SpotShape shape)
{
    const float outer = std::cos(0.6F);
    const float scale = 1.0F / (std::cos(0.2F) - outer);
    return {.shape = shape, .cone_scale = scale, .cone_offset = -outer * scale};
}

TEST(LampLight, LeavesAConeByTheAngleAndAPyramidByThatToItsNearestSide)
{
    const SpotBeam cone = spot(SpotShape::cone);
    const SpotBeam pyramid = spot(SpotShape::pyramid);
    EXPECT_EQ(share_along(cone, {0, -1, 0}), 1.0F);
    EXPECT_EQ(share_along(cone, {0, 1, 0}), 0.0F);
    const glm::vec3 to_a_side(std::sin(0.4F), -std::cos(0.4F), 0.0F);
    const float half_way = (std::cos(0.4F) - std::cos(0.6F)) / (std::cos(0.2F) - std::cos(0.6F));
    EXPECT_NEAR(share_along(cone, to_a_side), half_way * half_way, 1e-5F);
    EXPECT_NEAR(share_along(pyramid, to_a_side), half_way * half_way, 1e-5F);
    // Towards a corner of the pyramid, where the angles to both axes are 0.5 radians.
    const glm::vec3 to_a_corner = glm::normalize(glm::vec3(std::tan(0.5F), -1.0F, std::tan(0.5F)));
    EXPECT_EQ(share_along(cone, to_a_corner), 0.0F);
    EXPECT_GT(share_along(pyramid, to_a_corner), 0.0F);
}

TEST(LampLight, WeakensToNothingAtItsRange)
{
    EXPECT_EQ(weakened(LightFalloff::inverse_square, 0.0F, 4.0F), 0.25F);
    EXPECT_EQ(weakened(LightFalloff::inverse_square, 4.0F, 4.0F), 0.25F * (1.0F - 1.0F / 16.0F));
    EXPECT_EQ(weakened(LightFalloff::inverse_square, 2.0F, 4.0F), 0.0F);
    EXPECT_EQ(weakened(LightFalloff::unit_volume, 4.0F, 4.0F), 0.75F);
    EXPECT_EQ(weakened(LightFalloff::unit_volume, 2.0F, 9.0F), 0.0F);
}

} // namespace
} // namespace estampe
