// SPDX-License-Identifier: MIT
#include "drawing.hpp"

#include <gtest/gtest.h>

#include <estampe/error.hpp>

namespace estampe::app {
namespace {

/// An animation that moves a node along x to `to` in `duration_s`.
Animation move(const std::string& name, Index node, float to, float duration_s)
{
    Animation animation{.name = name, .duration_s = duration_s};
    animation.channels.push_back(
        {.node = node, .times_s = {0.0F, duration_s}, .values = {0.0F, 0.0F, 0.0F, to, 0.0F, 0.0F}});
    return animation;
}

Scene two_nodes()
{
    Scene scene;
    scene.nodes.resize(2);
    scene.nodes[0].name = "door";
    scene.roots = {0, 1};
    return scene;
}

DrawOptions asking_for(const std::string& animation)
{
    DrawOptions draw;
    draw.animation = animation;
    return draw;
}

TEST(Animations, AllPlayTogether)
{
    Scene scene = two_nodes();
    scene.animations = {move("open", 0, 2.0F, 1.0F), move("drive", 1, 8.0F, 4.0F)};
    EXPECT_TRUE(add_all_animations(scene));
    EXPECT_TRUE(scene.warnings.empty());
    const Index all = choose_animation(asking_for("all"), scene);
    ASSERT_EQ(all, 2U);
    EXPECT_EQ(scene.animations[all].duration_s, 4.0F);
    const ScenePose early = pose_scene(scene, 0.5, all);
    EXPECT_NEAR(early.world_from_node[0][3].x, 1.0, 1e-6);
    EXPECT_NEAR(early.world_from_node[1][3].x, 1.0, 1e-6);
    const ScenePose late = pose_scene(scene, 3.0, all);
    EXPECT_NEAR(late.world_from_node[0][3].x, 2.0, 1e-6) << "the shorter one stays where it ended";
    EXPECT_NEAR(late.world_from_node[1][3].x, 6.0, 1e-6);
}

TEST(Animations, WhereTwoMoveTheSameTheFirstCounts)
{
    Scene scene = two_nodes();
    scene.animations = {move("walk", 0, 2.0F, 1.0F), move("run", 0, 8.0F, 1.0F)};
    EXPECT_FALSE(add_all_animations(scene));
    ASSERT_EQ(scene.warnings.size(), 1U);
    EXPECT_NE(scene.warnings[0].find("\"door\""), std::string::npos) << scene.warnings[0];
    EXPECT_NEAR(pose_scene(scene, 0.5, 2).world_from_node[0][3].x, 1.0, 1e-6);
}

TEST(Animations, AreChosenByNameAndNumberAndAll)
{
    Scene scene = two_nodes();
    EXPECT_THROW(static_cast<void>(choose_animation(asking_for("all"), scene)), Error);
    scene.animations = {move("open", 0, 2.0F, 1.0F)};
    add_all_animations(scene);
    EXPECT_EQ(scene.animations.size(), 1U);
    EXPECT_EQ(choose_animation(asking_for("all"), scene), 0U);
    scene.animations.push_back(move("all", 1, 8.0F, 4.0F));
    add_all_animations(scene);
    EXPECT_EQ(scene.animations.size(), 2U) << "one of the file that is called so is meant";
    EXPECT_EQ(choose_animation(asking_for("all"), scene), 1U);
    EXPECT_EQ(choose_animation(asking_for("1"), scene), 1U);
    EXPECT_THROW(static_cast<void>(choose_animation(asking_for("close"), scene)), Error);
}

TEST(Animations, ANoteNamesTheOthersOfSeveral)
{
    Scene scene = two_nodes();
    scene.animations = {move("open", 0, 2.0F, 1.0F)};
    EXPECT_EQ(note_of_animations({}, scene), "");
    scene.animations.push_back(move("drive", 1, 8.0F, 4.0F));
    scene.animations.push_back(move("", 1, 8.0F, 4.0F));
    const std::string note = note_of_animations({}, scene);
    EXPECT_NE(note.find("plays animation \"open\" of 3"), std::string::npos) << note;
    EXPECT_NE(note.find("\"drive\", 2"), std::string::npos) << note;
    EXPECT_EQ(note_of_animations(asking_for("open"), scene), "");
}

} // namespace
} // namespace estampe::app
