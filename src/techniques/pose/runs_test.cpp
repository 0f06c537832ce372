// SPDX-License-Identifier: MIT
#include "techniques/pose/pose.hpp"

#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "scene/pose.hpp"
#include "support/scenes.hpp"

namespace estampe::pose {
namespace {

constexpr uint32_t box_vertices = 24;

/// Boxes in a row, each a draw call.
struct Row {
    explicit Row(int count)
    {
        for (int i = 0; i < count; ++i) {
            test::add_object(scene, shapes::box(glm::vec3(1.0F)), glm::vec3(1.0F), {2.0 * i, 0.0, 0.0});
        }
        meshes = build_meshes(scene, static_cast<Index>(scene.materials.size()));
        before = posed();
    }

    [[nodiscard]] PoseData posed() const { return pose_meshes(meshes, scene, pose_scene(scene, 0.0)); }

    [[nodiscard]] std::vector<VertexRun> runs(std::span<const uint32_t> written_over = {}) const
    {
        const VertexRuns runs = runs_to_pose(meshes, &before, posed(), written_over);
        return {runs.begin(), runs.end()};
    }

    Scene scene;
    MeshData meshes;
    PoseData before;
};

TEST(RunsToPose, AreAllWhereNothingIsKnownAndNoneWhereNothingMoved)
{
    const Row row(5);
    const VertexRuns all = runs_to_pose(row.meshes, nullptr, row.before, {});
    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(all[0], (VertexRun{0, static_cast<uint32_t>(row.meshes.draw_of_vertex.size())}));
    EXPECT_TRUE(row.runs().empty());
}

TEST(RunsToPose, HoldWhatMovedAndWhatWasWrittenOver)
{
    Row row(6);
    row.scene.nodes[1].transform.translation.y = 1.0;
    row.scene.nodes[2].transform.translation.y = 1.0;
    const std::vector<uint32_t> sheets{4};
    EXPECT_EQ(row.runs(sheets),
              (std::vector<VertexRun>{{box_vertices, 2 * box_vertices}, {4 * box_vertices, box_vertices}}));
}

TEST(RunsToPose, HoldWhatIsBetweenTheNearestWhereThereAreMany)
{
    // Every third box moves, and two that are nearer to each other.
    Row row(40);
    std::vector<uint32_t> moved;
    for (uint32_t i = 0; i < 40; i += 3) {
        moved.push_back(i);
    }
    moved.push_back(38);
    for (const uint32_t node : moved) {
        row.scene.nodes[node].transform.translation.y = 1.0;
    }
    const std::vector<VertexRun> runs = row.runs();
    EXPECT_EQ(runs.size(), 8U);
    for (const uint32_t node : moved) {
        EXPECT_TRUE(std::ranges::any_of(runs, [&](const VertexRun& run) {
            return run.first <= node * box_vertices && run.first + run.count >= (node + 1) * box_vertices;
        })) << node;
    }
    for (size_t i = 1; i < runs.size(); ++i) {
        EXPECT_GT(runs[i].first, runs[i - 1].first + runs[i - 1].count);
    }
    const VertexRun& last = runs.back();
    EXPECT_EQ(last.first + last.count, 40 * box_vertices);
}

TEST(RunsToPose, HoldMorphsAndSkinsThatMove)
{
    Scene scene;
    Primitive box = shapes::box(glm::vec3(1.0F));
    test::add_object(scene, box, glm::vec3(1.0F));
    Primitive morphing = box;
    morphing.morph_targets.push_back({.position_offsets = box.positions});
    test::add_object(scene, morphing, glm::vec3(1.0F), {2.0, 0.0, 0.0});
    scene.meshes[1].morph_weights = {0.5F};
    Primitive skinned = box;
    skinned.joints_0.assign(box.positions.size(), glm::u16vec4(0));
    skinned.weights_0.assign(box.positions.size(), {1.0F, 0.0F, 0.0F, 0.0F});
    test::add_object(scene, skinned, glm::vec3(1.0F));
    scene.nodes[2].skin = 0;
    scene.nodes.push_back({});
    scene.roots.push_back(3);
    scene.skins.push_back({.joints = {3}, .joint_from_bind = {glm::mat4(1.0F)}});
    const MeshData meshes = build_meshes(scene, static_cast<Index>(scene.materials.size()));
    const PoseData before = pose_meshes(meshes, scene, pose_scene(scene, 0.0));
    const auto runs = [&] {
        const PoseData now = pose_meshes(meshes, scene, pose_scene(scene, 0.0));
        const VertexRuns found = runs_to_pose(meshes, &before, now, {});
        return std::vector<VertexRun>(found.begin(), found.end());
    };
    EXPECT_TRUE(runs().empty());
    scene.meshes[1].morph_weights = {0.75F};
    EXPECT_EQ(runs(), (std::vector<VertexRun>{{box_vertices, box_vertices}}));
    scene.meshes[1].morph_weights = {0.5F};
    scene.nodes[3].transform.translation.x = 1.0;
    EXPECT_EQ(runs(), (std::vector<VertexRun>{{2 * box_vertices, box_vertices}}));
}

} // namespace
} // namespace estampe::pose
