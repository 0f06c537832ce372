// SPDX-License-Identifier: MIT
#include "scene/up_axis.hpp"

#include <array>

#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "support/scenes.hpp"

namespace estampe {
namespace {

struct Turn {
    UpAxis up;
    glm::dvec3 axis;  ///< axis of the file that points up
    glm::dvec3 front; ///< axis of the file that becomes +z
};

constexpr std::array<Turn, 6> turns{{{UpAxis::x, {1, 0, 0}, {0, 0, 1}},
                                     {UpAxis::y, {0, 1, 0}, {0, 0, 1}},
                                     {UpAxis::z, {0, 0, 1}, {0, -1, 0}},
                                     {UpAxis::minus_x, {-1, 0, 0}, {0, 0, 1}},
                                     {UpAxis::minus_y, {0, -1, 0}, {0, 0, 1}},
                                     {UpAxis::minus_z, {0, 0, -1}, {0, 1, 0}}}};

TEST(TurnUp, BringsTheAxisToYAndTheFrontToZ)
{
    for (const Turn& turn : turns) {
        SCOPED_TRACE(static_cast<int>(turn.up));
        Scene scene = test::scene_of(shapes::box({1, 1, 1}));
        turn_up(scene, turn.up);
        const glm::dmat4 world = pose_scene(scene, 0.0).world_from_node[0];
        EXPECT_EQ(glm::dvec3(world * glm::dvec4(turn.axis, 0.0)), glm::dvec3(0, 1, 0));
        EXPECT_EQ(glm::dvec3(world * glm::dvec4(turn.front, 0.0)), glm::dvec3(0, 0, 1));
        EXPECT_GT(glm::determinant(world), 0.0);
    }
}

TEST(TurnUp, CamerasLightsAndAnimationsTurnToo)
{
    Scene scene = test::scene_of(shapes::box({1, 1, 1}));
    test::add_sun(scene, {0, 0, 1});
    scene.cameras.push_back({.name = "above"});
    scene.nodes.push_back({.name = "above", .camera = 0});
    scene.nodes.back().transform.translation = {0, 0, 5};
    scene.roots.push_back(static_cast<Index>(scene.nodes.size() - 1));
    scene.animations.push_back({.name = "rise", .duration_s = 1.0F});
    scene.animations[0].channels.push_back(
        {.node = 0, .times_s = {0.0F, 1.0F}, .values = {0, 0, 0, 0, 0, 2}});
    turn_up(scene, UpAxis::z);
    const ScenePose pose = pose_scene(scene, 0.5);
    EXPECT_LT(glm::length(glm::dvec3(pose.world_from_node[0][3]) - glm::dvec3(0, 1, 0)), 1e-6);
    EXPECT_LT(glm::length(glm::dvec3(pose.world_from_node[1][2]) - glm::dvec3(0, 1, 0)), 1e-6) << "the sun";
    const Camera camera = scene_camera(scene, pose, "above");
    EXPECT_LT(glm::length(camera.eye - glm::dvec3(0, 5, 0)), 1e-9);
    EXPECT_LT(glm::length(glm::normalize(camera.target - camera.eye) - glm::dvec3(0, -1, 0)), 1e-9);
}

TEST(TurnUp, LeavesASceneWithYUpAsItIs)
{
    Scene scene = test::scene_of(shapes::box({1, 1, 1}));
    turn_up(scene, UpAxis::y);
    EXPECT_EQ(scene.nodes.size(), 1U);
}

} // namespace
} // namespace estampe
