// SPDX-License-Identifier: MIT
// Paling of the scene's shadow on the blank ground.
#include <cmath>

#include <gtest/gtest.h>

#include "techniques/light/light.hpp"

namespace estampe::light {
namespace {

const Bounds box{.min = {9.0, 2.0, -1.0}, .max = {11.0, 5.0, 1.0}};
const glm::dvec3 anchor(4.0, 1.0, 2.0);
constexpr float most = 0.6F;

float share_at(const Paling& paling, const glm::dvec3& point)
{
    return glm::dot(paling.share_per_m, glm::vec3(point - anchor)) + paling.share_at_anchor;
}

TEST(Paling, GrowsFromTheMiddleToWhereTheTopsShadowEnds)
{
    const glm::dvec3 towards_sun = glm::normalize(glm::dvec3(-1.0, 1.5, 0.0));
    const Paling paling = ground_paling(box, anchor, towards_sun, most);
    EXPECT_NEAR(share_at(paling, {10.0, 2.0, 0.0}), 0.0F, 1e-6F);
    // The box is three metres high; its shadow reaches two metres beyond its edge.
    EXPECT_NEAR(share_at(paling, {13.0, 2.0, 0.7}), most, 1e-5F);
    EXPECT_NEAR(share_at(paling, {11.5, 2.0, -3.0}), 0.5F * most, 1e-5F);
    EXPECT_LT(share_at(paling, {9.0, 2.0, 0.0}), 0.0F) << "towards the sun it is cut off";
}

TEST(Paling, IsNoneWhereShadowsHaveNoWayOrNoEnd)
{
    for (const glm::dvec3& sun : {glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(1.0, 0.0, 0.0)}) {
        const Paling paling = ground_paling(box, anchor, sun, most);
        EXPECT_EQ(paling.share_per_m, glm::vec3(0.0F));
        EXPECT_EQ(paling.share_at_anchor, 0.0F);
    }
    EXPECT_EQ(ground_paling({}, anchor, {0.6, 0.8, 0.0}, most).share_at_anchor, 0.0F);
}

} // namespace
} // namespace estampe::light
