// SPDX-License-Identifier: MIT
#include "techniques/shadow/atlas.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace estampe::shadow {
namespace {

LocalLight spot(float half_angle_rad)
{
    const glm::vec3 beam = glm::normalize(glm::vec3(1.0F, -2.0F, 0.5F));
    return {.position = {1.0F, 4.0F, -2.0F},
            .range_m = 10.0F,
            .beam = beam,
            .side = glm::normalize(glm::cross(beam, glm::vec3(0, 1, 0))),
            .half_angle_rad = half_angle_rad};
}

glm::vec3 ndc(const LocalView& view, const glm::vec3& point)
{
    const glm::vec4 clip = view.clip_from_anchor * glm::vec4(point, 1.0F);
    return glm::vec3(clip) / clip.w;
}

TEST(LocalView, ASpotsMapIsFilledByItsPyramid)
{
    const LocalLight light = spot(0.6F);
    const shared::LocalShadow shadow = local_shadow(light, 256, 128);
    const auto views = local_views(light, shadow);
    ASSERT_EQ(views.size(), 1U);
    EXPECT_EQ(views[0].first_texel, 128U);
    const float side = std::tan(0.6F);
    for (const glm::vec2 corner : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1)}) {
        const glm::vec3 point =
            light.position + 3.0F * (light.beam + side * (corner.x * shadow.right + corner.y * shadow.down));
        const glm::vec3 seen = ndc(views[0], point);
        EXPECT_NEAR(seen.x, corner.x * 252.0F / 256.0F, 1e-5F);
        EXPECT_NEAR(seen.y, corner.y * 252.0F / 256.0F, 1e-5F);
        EXPECT_NEAR(seen.z, shadow.near_m / 3.0F, 1e-6F);
    }
}

TEST(LocalView, SixMapsSeeEveryDirectionOnce)
{
    const LocalLight light{.position = {3.0F, -1.0F, 2.0F}, .range_m = 5.0F};
    const shared::LocalShadow shadow = local_shadow(light, 64, 0);
    const auto views = local_views(light, shadow);
    ASSERT_EQ(views.size(), 6U);
    std::mt19937 random(1);
    std::normal_distribution<float> normal;
    for (int i = 0; i < 500; ++i) {
        const glm::vec3 way(normal(random), normal(random), normal(random));
        int seen = 0;
        for (const LocalView& view : views) {
            const glm::vec4 clip = view.clip_from_anchor * glm::vec4(light.position + way, 1.0F);
            // Two maps see the margin of two texels on each side.
            const float inner = clip.w * 60.0F / 64.0F;
            seen += clip.w > 0.0F && std::abs(clip.x) <= inner && std::abs(clip.y) <= inner ? 1 : 0;
        }
        EXPECT_EQ(seen, 1);
    }
    EXPECT_EQ(views[5].first_texel, 5U * 64U * 64U);
}

TEST(LocalView, AWideSpotTakesSixMaps)
{
    EXPECT_FALSE(spot(0.8F).is_cube());
    EXPECT_TRUE(spot(1.5F).is_cube());
    EXPECT_TRUE(LocalLight{}.is_cube());
}

} // namespace
} // namespace estampe::shadow
