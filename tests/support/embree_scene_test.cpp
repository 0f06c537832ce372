// SPDX-License-Identifier: MIT
#include "support/embree_scene.hpp"

#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "support/scenes.hpp"

namespace estampe::test {
namespace {

TEST(EmbreeScene, MeetsWhatIsThere)
{
    Scene scene = scene_of(shapes::plane(2.0F, 2.0F));
    const Index box = add_object(scene, shapes::box({1.0F, 1.0F, 1.0F}), glm::vec3(1.0F), {0.0, 2.0, 0.0});
    const EmbreeScene rays(scene);
    const auto hit = rays.first_hit({0.2, 10.0, 0.3}, {0, -1, 0});
    ASSERT_TRUE(hit.has_value());
    EXPECT_EQ(hit->node, box);
    EXPECT_NEAR(hit->distance_m, 7.0, 1e-5);
    EXPECT_NEAR(hit->normal.y, 1.0, 1e-6);
    EXPECT_FALSE(rays.first_hit({0.2, 10.0, 0.3}, {0, -1, 0}, 6.9));
    EXPECT_TRUE(rays.is_blocked({0.2, 1.0, 0.3}, {0, -1, 0}));
    EXPECT_FALSE(rays.is_blocked({1.5, 1.0, 0.3}, {0, -1, 0}));
    EXPECT_TRUE(rays.is_between({0.2, 10.0, 0.3}, {0.2, 1.0, 0.3}));
    EXPECT_FALSE(rays.is_between({0.2, 10.0, 0.3}, {0.2, 3.1, 0.3}));
}

TEST(EmbreeScene, TakesOnlyWhatCounts)
{
    const Scene scene = scene_of(shapes::plane(2.0F, 2.0F));
    const EmbreeScene rays(scene, 0.0, [](const PosedPrimitive&) { return false; });
    EXPECT_FALSE(rays.is_blocked({0.0, 1.0, 0.0}, {0, -1, 0}));
}

} // namespace
} // namespace estampe::test
