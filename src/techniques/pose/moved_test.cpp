// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "support/scenes.hpp"
#include "techniques/pose/mesh_data.hpp"

namespace estampe::pose {
namespace {

TEST(MovedPlaces, HoldBeforeAndAfterOfWhatMovedAlone)
{
    Scene scene = test::scene_of(shapes::box({1.0F, 1.0F, 1.0F}));
    const Index mover = test::add_object(scene, shapes::box({1.0F, 1.0F, 1.0F}), glm::vec3(1.0F), {4, 0, 0});
    const MeshData meshes = build_meshes(scene, static_cast<Index>(scene.materials.size()));
    const PoseData before = pose_meshes(meshes, scene, pose_scene(scene, 0.0));
    EXPECT_TRUE(moved_places(meshes, before, before).empty());
    scene.nodes[mover].transform.translation.x = 6.0;
    const PoseData now = pose_meshes(meshes, scene, pose_scene(scene, 0.0));
    const auto moved = moved_places(meshes, before, now);
    ASSERT_EQ(moved.size(), 1U);
    EXPECT_NEAR(moved[0].min.x + meshes.anchor.x, 3.5, 1e-6);
    EXPECT_NEAR(moved[0].max.x + meshes.anchor.x, 6.5, 1e-6);
}

TEST(MovedPlaces, HoldASkinnedBodyWhereverItsJointsPutIt)
{
    Scene scene = test::scene_of(shapes::box({1.0F, 1.0F, 1.0F}));
    Primitive& body = scene.meshes[0].primitives[0];
    body.joints_0.assign(body.positions.size(), glm::u16vec4(1, 0, 0, 0));
    body.weights_0.assign(body.positions.size(), glm::vec4(1, 0, 0, 0));
    scene.nodes.push_back({});
    scene.nodes.push_back({});
    scene.roots.insert(scene.roots.end(), {1, 2});
    scene.skins.push_back({.joints = {1, 2}, .joint_from_bind = {glm::mat4(1.0F), glm::mat4(1.0F)}});
    scene.nodes[0].skin = 0;
    const MeshData meshes = build_meshes(scene, static_cast<Index>(scene.materials.size()));
    const PoseData before = pose_meshes(meshes, scene, pose_scene(scene, 0.0));
    scene.nodes[2].transform.translation.z = 3.0;
    const auto moved = moved_places(meshes, before, pose_meshes(meshes, scene, pose_scene(scene, 0.0)));
    ASSERT_EQ(moved.size(), 1U);
    EXPECT_LE(moved[0].min.z + meshes.anchor.z, -0.5 + 1e-6);
    EXPECT_GE(moved[0].max.z + meshes.anchor.z, 3.5 - 1e-6);
}

} // namespace
} // namespace estampe::pose
