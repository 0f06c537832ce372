// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "support/scenes.hpp"
#include "techniques/pose/mesh_data.hpp"

namespace estampe::pose {
namespace {

Scene four_boxes()
{
    Scene scene = test::scene_of(shapes::box({1.0F, 1.0F, 1.0F}));
    for (int i = 1; i < 4; ++i) {
        test::add_object(scene, shapes::box({1.0F, 1.0F, 1.0F}), glm::vec3(1.0F), {2.0 * i, 0.0, 0.0});
    }
    return scene;
}

TEST(Casters, AreOneRunWhereAllAreAlike)
{
    const MeshData meshes = build_meshes(four_boxes(), 4);
    ASSERT_EQ(meshes.casters.size(), 1U);
    EXPECT_EQ(meshes.casters[0].range.first, meshes.opaque.first);
    EXPECT_EQ(meshes.casters[0].range.count, meshes.opaque.count);
    EXPECT_EQ(meshes.casters[0].groups, all_groups);
    EXPECT_TRUE(has_plain_links(meshes));
}

TEST(Casters, WhatThrowsNoShadowIsInNoRun)
{
    Scene scene = four_boxes();
    scene.nodes[1].links.casts_for = 0;
    scene.nodes[2].links.casts_for = 0b10;
    scene.materials[3].links.casts_for = 0b10;
    scene.materials[0].alpha_mode = AlphaMode::mask;
    const MeshData meshes = build_meshes(scene, 4);
    EXPECT_FALSE(has_plain_links(meshes));
    ASSERT_EQ(meshes.casters.size(), 2U);
    std::vector<uint32_t> drawn;
    for (const CasterRun& run : meshes.casters) {
        EXPECT_EQ(run.groups, run.masked ? all_groups : 0b10);
        for (uint32_t i = run.range.first; i < run.range.first + run.range.count; ++i) {
            const uint32_t draw = meshes.triangles[i].w & shared::triangle_draw_mask;
            EXPECT_EQ(meshes.draws[draw].groups >> 16U, run.groups);
            drawn.push_back(meshes.sources[draw].node);
        }
    }
    EXPECT_EQ(std::count(drawn.begin(), drawn.end(), 1U), 0);
    EXPECT_EQ(drawn.size(), 3U * 12U);
    EXPECT_EQ(meshes.opaque.count + meshes.masked.count, 4U * 12U);
    const PoseData pose = pose_meshes(meshes, scene, pose_scene(scene, 0.0));
    EXPECT_NEAR(pose.casters.max.x, 6.5, 1e-5);
    scene.nodes[3].links.casts_for = 0;
    const PoseData fewer = pose_meshes(build_meshes(scene, 4), scene, pose_scene(scene, 0.0));
    EXPECT_NEAR(fewer.casters.max.x, 4.5, 1e-5);
}

} // namespace
} // namespace estampe::pose
