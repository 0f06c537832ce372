// SPDX-License-Identifier: MIT
#include "techniques/shadow/sun/sun_map.hpp"

#include <gtest/gtest.h>

namespace estampe::shadow {
namespace {

TEST(SunView, HoldsEveryCornerOfTheCasters)
{
    const Bounds casters{.min = {-3, 0, 100}, .max = {7, 20, 140}};
    const glm::dvec3 anchor(2, 10, 120);
    for (const glm::dvec3 sun : {glm::dvec3(0, 1, 0), glm::dvec3(1, 0.2, 0), glm::dvec3(-0.3, 0.5, 0.9)}) {
        const glm::dvec3 towards_sun = glm::normalize(sun);
        const SunView view = sun_view(casters, anchor, towards_sun, 1024);
        for (int i = 0; i < 8; ++i) {
            const glm::dvec3 corner((i & 1) != 0 ? 7 : -3, (i & 2) != 0 ? 20 : 0, (i & 4) != 0 ? 140 : 100);
            const glm::vec4 clip = view.clip_from_anchor * glm::vec4(corner - anchor, 1.0F);
            EXPECT_FLOAT_EQ(clip.w, 1.0F);
            EXPECT_LT(std::abs(clip.x), 1.0F);
            EXPECT_LT(std::abs(clip.y), 1.0F);
            EXPECT_GT(clip.z, 0.0F);
            EXPECT_LT(clip.z, 1.0F);
        }
        const glm::vec4 origin = view.clip_from_anchor * glm::vec4(0, 0, 0, 1);
        const glm::vec4 nearer = view.clip_from_anchor * glm::vec4(towards_sun, 1.0F);
        EXPECT_NEAR(nearer.z - origin.z, 1.0F / view.depth_m, 1e-6F);
        EXPECT_NEAR(nearer.x, origin.x, 1e-5F);
    }
}

TEST(SunView, StandsWithoutCasters)
{
    const SunView view = sun_view(Bounds{}, glm::dvec3(0), glm::dvec3(0, 1, 0), 512);
    EXPECT_GT(view.texel_m, 0.0F);
    EXPECT_NEAR((view.clip_from_anchor * glm::vec4(0, 0, 0, 1)).z, 0.5F, 1e-6F);
}

} // namespace
} // namespace estampe::shadow
