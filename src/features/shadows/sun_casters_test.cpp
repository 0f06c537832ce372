// SPDX-License-Identifier: MIT
#include "features/shadows/sun.hpp"

#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

namespace estampe::features {
namespace {

/// Boxes of 1 m in a row along x, 4 m apart.
Scene row_of_boxes(int count)
{
    Scene scene;
    scene.materials.emplace_back();
    scene.meshes.push_back({.primitives = {shapes::box({1.0F, 1.0F, 1.0F})}});
    for (int i = 0; i < count; ++i) {
        Node& node = scene.nodes.emplace_back();
        node.mesh = 0;
        node.transform.translation = {4.0 * i, 0.5, 0.0};
        scene.roots.push_back(static_cast<Index>(i));
    }
    return scene;
}

struct Seen {
    explicit Seen(int count)
        : scene(row_of_boxes(count)), layout(pose::build_meshes(scene, 1)),
          still(still_casters(layout, scene))
    {
        // From straight above: x to the right, z down, 16 texels per metre.
        clipmap.view.right = {1.0F, 0.0F, 0.0F};
        clipmap.view.down = {0.0F, 0.0F, 1.0F};
        clipmap.finest_m = 1.0 / 16.0;
        clipmap.size = 64;
        clipmap.level_count = 4;
    }

    /// The batches for a piece of a level, centred at a place.
    [[nodiscard]] std::vector<raster::Batch> about(double x_m, uint32_t level, glm::uvec2 size,
                                                   size_t most = 24) const
    {
        const double texel_m = clipmap.finest_m * (1U << level);
        const double at = (x_m - layout.anchor.x) / texel_m;
        const double across = -layout.anchor.z / texel_m;
        const shadow::Piece piece{.level = level,
                                  .low = {static_cast<int>(at) - static_cast<int>(size.x / 2),
                                          static_cast<int>(across) - static_cast<int>(size.y / 2)},
                                  .size = size};
        std::vector<raster::Batch> batches;
        add_casters_within(piece, clipmap, layout.anchor, still, all_groups, most, batches);
        return batches;
    }

    Scene scene;
    pose::MeshData layout;
    std::vector<StillCaster> still;
    shadow::Clipmap clipmap;
};

TEST(SunCasters, OnlyWhatAPieceShowsIsDrawnIntoIt)
{
    const Seen seen(8);
    ASSERT_EQ(seen.still.size(), 8U);
    EXPECT_NEAR(seen.still[3].place.min.x, 11.5, 1e-6);
    const auto one = seen.about(12.0, 0, {16, 16});
    ASSERT_EQ(one.size(), 1U);
    EXPECT_EQ(one[0].first_triangle, seen.still[3].range.first);
    EXPECT_EQ(one[0].triangle_count, 12U);
    EXPECT_TRUE(seen.about(14.0, 0, {16, 16}).empty()) << "between two";
    EXPECT_FALSE(seen.about(13.1, 0, {16, 16}).empty()) << "next to one";
    const auto all = seen.about(14.0, 3, {64, 64});
    ASSERT_EQ(all.size(), 1U) << "what follows on is one batch";
    EXPECT_EQ(all[0].triangle_count, 96U);
    const auto three = seen.about(12.0, 1, {64, 64});
    ASSERT_EQ(three.size(), 1U);
    EXPECT_EQ(three[0].triangle_count, 36U);
}

TEST(SunCasters, TooManyBatchesAreDrawnTogether)
{
    Seen seen(8);
    for (size_t i = 1; i < seen.still.size(); i += 2) {
        seen.still[i].place = {.min = {900.0, 0.0, 0.0}, .max = {901.0, 1.0, 1.0}};
    }
    EXPECT_EQ(seen.about(14.0, 3, {64, 64}).size(), 4U);
    const auto two = seen.about(14.0, 3, {64, 64}, 2);
    ASSERT_EQ(two.size(), 2U);
    EXPECT_EQ(two[0].triangle_count + two[1].triangle_count, 6U * 12U);
    EXPECT_EQ(seen.about(14.0, 3, {64, 64}, 1).front().triangle_count, 7U * 12U);
}

TEST(SunCasters, WhatThrowsNoShadowIsNotDrawnWithItsNeighbours)
{
    Seen seen(3);
    seen.still[1].groups = 0;
    const auto apart = seen.about(4.0, 3, {64, 64}, 1);
    ASSERT_EQ(apart.size(), 2U);
    EXPECT_EQ(apart[0].triangle_count + apart[1].triangle_count, 24U);
    seen.still.erase(seen.still.begin() + 1); // now that box is no static caster
    EXPECT_EQ(seen.about(4.0, 3, {64, 64}, 1).size(), 2U);
}

TEST(SunCasters, TwoSidedThingsAreNotTakenForPlainOnes)
{
    for (const bool is_apart : {false, true}) {
        Seen seen(3);
        ASSERT_TRUE(seen.still[0].range.plain);
        seen.still[2].range.plain = false;
        if (is_apart) {
            seen.still[1].place = {.min = {900.0, 0.0, 0.0}, .max = {901.0, 1.0, 1.0}};
        }
        const auto together = seen.about(4.0, 3, {64, 64}, 1);
        ASSERT_EQ(together.size(), 1U);
        EXPECT_FALSE(together[0].plain);
    }
}

TEST(SunCasters, WhatMayMoveIsNotAmongThem)
{
    Scene scene = row_of_boxes(3);
    scene.animations.push_back(
        {.name = "slide",
         .channels = {{.node = 1, .times_s = {0.0F, 1.0F}, .values = {0, 0, 0, 9, 9, 9}}},
         .duration_s = 1.0F});
    const pose::MeshData layout = pose::build_meshes(scene, 1);
    EXPECT_EQ(still_casters(layout, scene).size(), 2U);
}

} // namespace
} // namespace estampe::features
