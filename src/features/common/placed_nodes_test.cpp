// SPDX-License-Identifier: MIT
#include "features/common/placed_nodes.hpp"

#include <limits>

#include <gtest/gtest.h>

#include <estampe/error.hpp>

#include "scene/static_triangles.hpp"

namespace estampe::features {
namespace {

NodePlace at(Index node, double x)
{
    return {node, {.translation = {x, 0.0, 0.0}}};
}

void place(PlacedNodes& nodes, const NodePlace& one, double time_s)
{
    nodes.place(std::span(&one, 1), time_s);
}

double x_at(const PlacedNodes& nodes, double time_s)
{
    Scene scene;
    scene.nodes.resize(3);
    nodes.put(scene, time_s);
    return scene.nodes[1].transform.translation.x;
}

TEST(PlacedNodes, StandOnTheStraightWayBetweenWhatWasSaid)
{
    PlacedNodes nodes;
    EXPECT_TRUE(nodes.empty());
    place(nodes, at(1, 2.0), 1.0);
    place(nodes, at(1, 6.0), 3.0);
    EXPECT_DOUBLE_EQ(x_at(nodes, 0.0), 2.0);
    EXPECT_DOUBLE_EQ(x_at(nodes, 1.0), 2.0);
    EXPECT_DOUBLE_EQ(x_at(nodes, 1.5), 3.0);
    EXPECT_DOUBLE_EQ(x_at(nodes, 3.0), 6.0);
    EXPECT_DOUBLE_EQ(x_at(nodes, 99.0), 6.0);
}

TEST(PlacedNodes, GoingBackForgetsWhatCameLater)
{
    PlacedNodes nodes;
    place(nodes, at(1, 2.0), 1.0);
    place(nodes, at(1, 6.0), 3.0);
    place(nodes, at(2, 1.0), 3.0);
    place(nodes, at(1, 4.0), 2.0);
    EXPECT_DOUBLE_EQ(x_at(nodes, 5.0), 4.0);
    EXPECT_DOUBLE_EQ(x_at(nodes, 1.0), 2.0);
}

TEST(PlacedNodes, RememberForAWhile)
{
    PlacedNodes nodes;
    for (int i = 0; i <= 100; ++i) {
        place(nodes, at(1, i), i);
    }
    EXPECT_DOUBLE_EQ(x_at(nodes, 100.0 - PlacedNodes::remembered_s), 100.0 - PlacedNodes::remembered_s);
    EXPECT_GT(x_at(nodes, 0.0), 80.0);
}

TEST(PlacedNodes, AreTakenOutOfTheAnimationsHands)
{
    Scene scene;
    scene.nodes.resize(3);
    scene.roots = {0, 1, 2};
    scene.animations.push_back(
        {.name = "walk",
         .channels = {{.node = 1, .times_s = {0.0F, 1.0F}, .values = {0, 0, 0, 9, 9, 9}}},
         .duration_s = 1.0F});
    const NodePlace moving = at(1, 5.0);
    EXPECT_FALSE(take_over(scene, std::span(&moving, 1))) << "it moved before";
    scene.nodes[1].transform.translation = {5.0, 0.0, 0.0};
    EXPECT_DOUBLE_EQ(pose_scene(scene, 0.5).world_from_node[1][3].x, 5.0);
    const NodePlace standing = at(2, 5.0);
    scene.nodes[2].mesh = 0;
    EXPECT_TRUE(take_over(scene, std::span(&standing, 1)));
    EXPECT_TRUE(moving_nodes(scene)[2]);
    EXPECT_FALSE(moving_nodes(scene)[0]);
    EXPECT_FALSE(take_over(scene, std::span(&standing, 1)));
}

TEST(PlacedNodes, BadPlacesAreErrors)
{
    const NodePlace far = at(7, 0.0);
    EXPECT_THROW(check_places(std::span(&far, 1), 7, 0.0), Error);
    const NodePlace nowhere = at(1, std::numeric_limits<double>::quiet_NaN());
    EXPECT_THROW(check_places(std::span(&nowhere, 1), 7, 0.0), Error);
    const NodePlace good = at(1, 0.0);
    EXPECT_THROW(check_places(std::span(&good, 1), 7, std::numeric_limits<double>::infinity()), Error);
    EXPECT_NO_THROW(check_places(std::span(&good, 1), 7, 0.0));
}

} // namespace
} // namespace estampe::features
