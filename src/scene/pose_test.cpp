// SPDX-License-Identifier: MIT
#include "scene/pose.hpp"

#include <cmath>
#include <limits>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace estampe {
namespace {

Scene one_node()
{
    Scene scene;
    scene.materials.emplace_back();
    scene.nodes.emplace_back();
    scene.roots = {0};
    return scene;
}

Scene animated(AnimationChannel channel, float duration_s)
{
    Scene scene = one_node();
    channel.node = 0;
    scene.animations.push_back({.name = "", .channels = {std::move(channel)}, .duration_s = duration_s});
    return scene;
}

glm::dvec3 place(const Scene& scene, double time_s)
{
    return glm::dvec3(pose_scene(scene, time_s).world_from_node[0][3]);
}

void expect_place(const glm::dvec3& actual, const glm::dvec3& wanted, double tolerance = 1e-6)
{
    EXPECT_NEAR(actual.x, wanted.x, tolerance);
    EXPECT_NEAR(actual.y, wanted.y, tolerance);
    EXPECT_NEAR(actual.z, wanted.z, tolerance);
}

TEST(Transform, ScalesThenTurnsThenMoves)
{
    Transform transform;
    transform.translation = {10.0, 0.0, 0.0};
    transform.rotation = glm::angleAxis(glm::radians(90.0), glm::dvec3(0.0, 0.0, 1.0));
    transform.scale = {2.0, 3.0, 4.0};
    expect_place(glm::dvec3(transform.matrix() * glm::dvec4(1.0, 1.0, 1.0, 1.0)), {7.0, 2.0, 4.0});
}

TEST(Pose, StepHoldsUntilTheNextKey)
{
    const Scene scene = animated({.path = AnimatedPath::translation,
                                  .interpolation = Interpolation::step,
                                  .times_s = {0.0F, 1.0F, 2.0F},
                                  .values = {1, 0, 0, 5, 0, 0, 9, 0, 0}},
                                 2.0F);
    EXPECT_DOUBLE_EQ(place(scene, 0.999).x, 1.0);
    EXPECT_DOUBLE_EQ(place(scene, 1.0).x, 5.0);
    EXPECT_DOUBLE_EQ(place(scene, 1.999).x, 5.0);
}

TEST(Pose, LinearHoldsBeforeTheFirstKeyAndAfterTheLast)
{
    const Scene scene = animated({.times_s = {1.0F, 3.0F}, .values = {0, 0, 0, 4, 2, -6}}, 5.0F);
    expect_place(place(scene, 0.5), {0.0, 0.0, 0.0});
    expect_place(place(scene, 1.5), {1.0, 0.5, -1.5});
    expect_place(place(scene, 4.5), {4.0, 2.0, -6.0});
}

TEST(Pose, LoopsByDurationBothWays)
{
    const Scene scene = animated({.times_s = {0.0F, 2.0F}, .values = {0, 0, 0, 2, 0, 0}}, 2.0F);
    EXPECT_NEAR(place(scene, 2.5).x, 0.5, 1e-6);
    EXPECT_NEAR(place(scene, 200001.25).x, 1.25, 1e-6);
    EXPECT_NEAR(place(scene, -0.5).x, 1.5, 1e-6);
    EXPECT_NEAR(place(scene, std::numeric_limits<double>::infinity()).x, 0.0, 1e-6);
}

TEST(Pose, RotationTakesTheShortWay)
{
    const float half = std::sqrt(0.5F);
    const Scene scene = animated(
        {.path = AnimatedPath::rotation, .times_s = {0.0F, 1.0F}, .values = {0, 0, 0, 1, 0, -half, 0, -half}},
        1.5F);
    const glm::dmat4 world = pose_scene(scene, 1.0 / 3.0).world_from_node[0];
    const double angle = glm::radians(30.0);
    expect_place(glm::dvec3(world * glm::dvec4(0, 0, 1, 0)), {std::sin(angle), 0.0, std::cos(angle)});
}

TEST(Pose, CubicSplineIsHermite)
{
    // Keys at 0 s and 2 s: values 1 and 3, out-tangent 4 per second, in-tangent -2 per second.
    const Scene scene = animated({.interpolation = Interpolation::cubic_spline,
                                  .times_s = {0.0F, 2.0F},
                                  .values = {9, 0, 0, 1, 0, 0, 4, 0, 0, -2, 0, 0, 3, 0, 0, 9, 0, 0}},
                                 3.0F);
    EXPECT_NEAR(place(scene, 0.0).x, 1.0, 1e-6);
    // t = 1/2: 0.5 * 1 + 2 * 0.125 * 4 + 0.5 * 3 + 2 * -0.125 * -2
    EXPECT_NEAR(place(scene, 1.0).x, 3.5, 1e-6);
    // t = 1/4: 0.84375 * 1 + 2 * 0.140625 * 4 + 0.15625 * 3 + 2 * -0.046875 * -2
    EXPECT_NEAR(place(scene, 0.5).x, 2.625, 1e-6);
    EXPECT_NEAR(place(scene, 2.5).x, 3.0, 1e-6);
}

TEST(Pose, ChannelsAndParentsCombine)
{
    Scene scene = one_node();
    scene.nodes.resize(3);
    scene.roots = {2};
    scene.nodes[2].children = {0, 1};
    scene.nodes[0].parent = scene.nodes[1].parent = 2;
    scene.nodes[1].matrix = glm::translate(glm::dmat4(1.0), {0.0, 0.0, 7.0});
    scene.animations.resize(2);
    scene.animations[1].duration_s = 1.0F;
    scene.animations[1].channels = {
        {.node = 2, .path = AnimatedPath::scale, .times_s = {0.0F}, .values = {2, 2, 2}},
        {.node = 0, .path = AnimatedPath::translation, .times_s = {0.0F, 1.0F}, .values = {0, 0, 0, 1, 0, 0}},
        {.node = 1, .path = AnimatedPath::translation, .times_s = {0.0F}, .values = {50, 50, 50}},
        {.node = 0, .path = AnimatedPath::scale, .times_s = {0.0F, 1.0F}, .values = {1, 1}},
        {.node = 99, .path = AnimatedPath::scale, .times_s = {0.0F}, .values = {1, 1, 1}},
    };
    const ScenePose pose = pose_scene(scene, 0.5, 1);
    expect_place(glm::dvec3(pose.world_from_node[0][3]), {1.0, 0.0, 0.0});
    expect_place(glm::dvec3(pose.world_from_node[1][3]), {0.0, 0.0, 14.0});
    expect_place(glm::dvec3(pose_scene(scene, 0.5, no_index).world_from_node[0][3]), {0.0, 0.0, 0.0});
}

Scene with_triangle()
{
    Scene scene = one_node();
    Primitive primitive;
    primitive.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    primitive.normals.assign(3, {0, 0, 1});
    primitive.indices = {0, 1, 2};
    scene.meshes.push_back({.name = "", .primitives = {primitive}, .morph_weights = {}});
    scene.nodes[0].mesh = 0;
    return scene;
}

TEST(Bounds, MorphTargetsAddByWeight)
{
    Scene scene = with_triangle();
    Primitive& primitive = scene.meshes[0].primitives[0];
    primitive.morph_targets.resize(2);
    primitive.morph_targets[0].position_offsets = {{0, 0, 0}, {2, 0, 0}, {0, 0, 0}};
    primitive.morph_targets[1].position_offsets = {{0, 0, -4}, {0, 0, 0}, {0, 0, 0}};
    scene.meshes[0].morph_weights = {0.5F};
    scene.animations.push_back(
        {.name = "",
         .channels =
             {{.node = 0, .path = AnimatedPath::weights, .times_s = {0, 1}, .values = {0, 0, 1, 0.5F}}},
         .duration_s = 2.0F});
    const Bounds rest = scene_bounds(scene, pose_scene(scene, 0.0, no_index));
    expect_place(rest.min, {0, 0, 0});
    expect_place(rest.max, {2, 1, 0});
    const Bounds moved = scene_bounds(scene, pose_scene(scene, 1.0));
    expect_place(moved.min, {0, 0, -2});
    expect_place(moved.max, {3, 1, 0});
}

TEST(Bounds, InstancesEachCount)
{
    Scene scene = with_triangle();
    scene.nodes[0].transform.scale = glm::dvec3(2.0);
    scene.nodes[0].instances = {glm::mat4(1.0F), glm::translate(glm::mat4(1.0F), {10, 0, 0})};
    const Bounds bounds = scene_bounds(scene, pose_scene(scene, 0.0));
    expect_place(bounds.max, {22, 2, 0});
}

TEST(Bounds, SkinOfEightInfluencesMovesVerticesAndNotTheNode)
{
    Scene scene = with_triangle();
    scene.nodes.resize(10);
    scene.nodes[0].transform.translation = {1000, 0, 0};
    scene.nodes[0].skin = 0;
    scene.skins.resize(1);
    for (Index joint = 0; joint < 8; ++joint) {
        scene.roots.push_back(joint + 1);
        scene.nodes[joint + 1].transform.translation = {0.0, 0.0, static_cast<double>(joint)};
        scene.skins[0].joints.push_back(joint + 1);
        scene.skins[0].joint_from_bind.push_back(glm::translate(glm::mat4(1.0F), {0, 0, 1}));
    }
    Primitive& primitive = scene.meshes[0].primitives[0];
    primitive.joints_0.assign(3, {0, 1, 2, 3});
    primitive.joints_1.assign(3, {4, 5, 6, 7});
    primitive.weights_0.assign(3, glm::vec4(0.125F));
    primitive.weights_1.assign(3, glm::vec4(0.125F));
    primitive.weights_0[1] = {0, 1, 0, 0};
    primitive.weights_1[1] = glm::vec4(0.0F);
    const ScenePose pose = pose_scene(scene, 0.0);
    const Bounds bounds = scene_bounds(scene, pose);
    expect_place(bounds.min, {0, 0, 2});
    expect_place(bounds.max, {1, 1, 4.5});
    const std::vector<glm::mat4> matrices = skin_matrices(scene, pose, 0);
    ASSERT_EQ(matrices.size(), 8U);
    EXPECT_FLOAT_EQ(matrices[7][3].z, 8.0F);
    EXPECT_TRUE(skin_matrices(scene, pose, 1).empty());
}

TEST(Posed, SamplesAreEverySoManiethVertexOfAll)
{
    Scene scene = one_node();
    Primitive strip;
    for (int i = 0; i < 37; ++i) {
        strip.positions.emplace_back(static_cast<float>(i), 0.25F * static_cast<float>(i), 0.0F);
    }
    strip.morph_targets.push_back({.position_offsets = std::vector<glm::vec3>(37)});
    for (int i = 0; i < 37; ++i) {
        strip.morph_targets[0].position_offsets[static_cast<size_t>(i)].z = static_cast<float>(i * i);
    }
    scene.meshes.push_back({.primitives = {strip}});
    scene.nodes[0].mesh = 0;
    ScenePose pose = pose_scene(scene, 0.0);
    pose.morph_weights[0] = {0.5F};
    std::vector<glm::dvec3> all;
    visit_posed(scene, pose, [&](const PosedPrimitive& posed) {
        all.assign(posed.positions.begin(), posed.positions.end());
    });
    ASSERT_EQ(all.size(), 37U);
    visit_posed_samples(scene, pose, 5, [&](const PosedPrimitive& posed) {
        ASSERT_EQ(posed.positions.size(), 6U); // every seventh
        for (size_t i = 0; i < posed.positions.size(); ++i) {
            EXPECT_EQ(posed.positions[i], all[7 * i]) << i;
        }
    });
}

TEST(Bounds, EmptySceneIsEmpty)
{
    EXPECT_TRUE(scene_bounds(Scene{}, pose_scene(Scene{}, 1.0)).empty());
}

} // namespace
} // namespace estampe
