// SPDX-License-Identifier: MIT
// Compares posed vertices with the CPU's, and tests the front side of posed triangles.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <tuple>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/packing.hpp>
#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "gpu/resources.hpp"
#include "scene/pose.hpp"
#include "support/drawing.hpp"
#include "support/gpu_device.hpp"
#include "support/scenes.hpp"

namespace estampe::pose {
namespace {

glm::dvec3 decode_normal(uint32_t packed)
{
    const glm::dvec2 e(glm::unpackSnorm2x16(packed));
    const double z = 1.0 - std::abs(e.x) - std::abs(e.y);
    const double fold = std::max(-z, 0.0);
    return glm::normalize(
        glm::dvec3(e.x + (e.x >= 0.0 ? -fold : fold), e.y + (e.y >= 0.0 ? -fold : fold), z));
}

/// The normal of the posed surface: perpendicular to two posed tangents.
glm::dvec3 turned(const glm::dmat3& linear, const glm::dvec3& normal)
{
    return glm::normalize(glm::inverse(glm::transpose(linear)) * normal);
}

Scene posed_scene()
{
    Scene scene;
    test::add_object(scene, shapes::torus(1.0F, 0.3F, 12, 8), glm::vec3(1.0F), {1.0, 2.0, 3.0});
    scene.nodes.back().transform.rotation = glm::angleAxis(0.7, glm::normalize(glm::dvec3(1, 2, 3)));
    scene.nodes.back().transform.scale = {2.0, 0.5, -1.0};
    return scene;
}

Scene morphing_scene()
{
    Primitive ball = shapes::sphere(1.0F, 10, 6);
    for (int target = 0; target < 2; ++target) {
        MorphTarget& offsets = ball.morph_targets.emplace_back();
        for (const glm::vec3& p : ball.positions) {
            offsets.position_offsets.push_back(target == 0 ? glm::vec3(0.0F, p.x * p.x, 0.0F) : 0.3F * p);
            offsets.normal_offsets.push_back(target == 0 ? glm::vec3(-p.x, 0.0F, 0.1F) : glm::vec3(0.0F));
        }
    }
    Scene scene = test::scene_of(std::move(ball));
    scene.meshes[0].morph_weights = {0.5F, 0.25F};
    scene.animations.push_back({.channels = {{.node = 0,
                                              .path = AnimatedPath::weights,
                                              .times_s = {0.0F, 1.0F},
                                              .values = {0.0F, 0.0F, 1.0F, 2.0F}}},
                                .duration_s = 1.0F});
    return scene;
}

Scene instanced_scene()
{
    Scene scene = test::scene_of(shapes::box({1.0F, 2.0F, 3.0F}));
    scene.nodes[0].transform.translation = {-4.0, 1.0, 0.0};
    for (int i = 0; i < 5; ++i) {
        const glm::mat4 place = glm::translate(glm::mat4(1.0F), glm::vec3(3 * i, 0, -i));
        scene.nodes[0].instances.push_back(
            glm::rotate(place, 0.4F * static_cast<float>(i), {0.0F, 1.0F, 0.0F}));
    }
    return scene;
}

/// A cylinder bent by eight joints, each vertex by all of them.
Scene skinned_scene()
{
    std::mt19937 random(7);
    Primitive tube = shapes::cylinder(0.5F, 4.0F, 12);
    for (size_t i = 0; i < tube.positions.size(); ++i) {
        glm::vec4 weights[2];
        uint32_t left = 65535; // 16 bits hold these weights exactly
        for (uint32_t k = 0; k < 8; ++k) {
            const uint32_t part = k < 7 ? std::uniform_int_distribution<uint32_t>(1, left / 2)(random) : left;
            weights[k / 4][static_cast<int>(k % 4)] = static_cast<float>(part) / 65535.0F;
            left -= part;
        }
        tube.joints_0.emplace_back(0, 1, 2, 3);
        tube.joints_1.emplace_back(4, 5, 6, 7);
        tube.weights_0.push_back(weights[0]);
        tube.weights_1.push_back(weights[1]);
    }
    Scene scene = test::scene_of(std::move(tube));
    scene.skins.emplace_back();
    scene.nodes[0].skin = 0;
    scene.nodes[0].transform.translation = {50.0, 0.0, 0.0}; // no effect: the joints place a skinned mesh
    for (Index joint = 1; joint <= 8; ++joint) {
        const double height = 0.5 * (joint - 1);
        scene.skins[0].joints.push_back(joint);
        scene.skins[0].joint_from_bind.push_back(
            glm::translate(glm::mat4(1.0F), glm::vec3(0.0, -height, 0.0)));
        scene.nodes.push_back({.parent = joint == 1 ? no_index : joint - 1,
                               .transform = {.translation = {0.1, joint == 1 ? 0.0 : 0.5, 0.0},
                                             .rotation = glm::angleAxis(0.05 * joint, glm::dvec3(0, 0, 1))}});
        if (joint > 1) {
            scene.nodes[joint - 1].children.push_back(joint);
        }
    }
    scene.roots.push_back(1);
    scene.animations.push_back({.channels = {{.node = 1,
                                              .path = AnimatedPath::translation,
                                              .times_s = {0.0F, 1.0F},
                                              .values = {0.0F, 0.0F, 0.0F, 3.0F, -2.0F, 1.0F}}},
                                .duration_s = 1.0F});
    return scene;
}

/// Linear part of a vertex's transform, in double precision.
glm::dmat3 vertex_linear(const Scene& scene, const ScenePose& pose, const PosedPrimitive& posed,
                         size_t vertex, uint32_t instance)
{
    const std::vector<glm::mat4> joints = skin_matrices(scene, pose, posed.node);
    const Primitive& primitive = *posed.primitive;
    if (joints.empty()) {
        const auto& instances = scene.nodes[posed.node].instances;
        const glm::dmat3 node(pose.world_from_node[posed.node]);
        return instances.empty() ? node : node * glm::dmat3(instances[instance]);
    }
    glm::dmat3 sum(0.0);
    for (int k = 0; k < 4; ++k) {
        sum += static_cast<double>(primitive.weights_0[vertex][k]) *
               glm::dmat3(joints[primitive.joints_0[vertex][k]]);
        sum += static_cast<double>(primitive.weights_1[vertex][k]) *
               glm::dmat3(joints[primitive.joints_1[vertex][k]]);
    }
    return sum;
}

glm::dvec3 morphed_normal(const PosedPrimitive& posed, const ScenePose& pose, size_t vertex)
{
    glm::dvec3 normal(posed.primitive->normals[vertex]);
    for (size_t target = 0; target < posed.primitive->morph_targets.size(); ++target) {
        normal += static_cast<double>(pose.morph_weights[posed.node][target]) *
                  glm::dvec3(posed.primitive->morph_targets[target].normal_offsets[vertex]);
    }
    return normal;
}

void expect_posed(const Scene& scene, double time_s)
{
    test::Drawing drawing(scene, {}, {16, 16}, time_s);
    const ScenePose pose = pose_scene(scene, time_s);
    const auto actual = drawing.posed();
    size_t next = 0;
    size_t visit = 0;
    double worst_position = 0.0;
    double worst_normal = 0.0;
    visit_posed(scene, pose, [&](const PosedPrimitive& posed) {
        const size_t copies = std::max<size_t>(scene.nodes[posed.node].instances.size(), 1);
        const auto instance = static_cast<uint32_t>(visit++ % copies);
        for (size_t i = 0; i < posed.positions.size(); ++i, ++next) {
            ASSERT_LT(next, actual.size());
            const glm::dvec3 wanted = posed.positions[i] - drawing.layout.anchor;
            const double size = std::max(glm::length(wanted), drawing.layout.bounds.radius());
            worst_position =
                std::max(worst_position, glm::distance(glm::dvec3(actual[next].position), wanted) / size);
            const glm::dvec3 normal =
                turned(vertex_linear(scene, pose, posed, i, instance), morphed_normal(posed, pose, i));
            worst_normal = std::max(worst_normal, glm::distance(decode_normal(actual[next].normal), normal));
        }
    });
    EXPECT_EQ(next + 4, actual.size()) << "the ground has the last four";
    EXPECT_LT(worst_position, 1e-5);
    EXPECT_LT(worst_normal, 1e-3);
}

TEST(PosedMeshes, PlacesTurnsAndMirrors)
{
    expect_posed(posed_scene(), 0.0);
}

TEST(PosedMeshes, Morphs)
{
    expect_posed(morphing_scene(), 0.0);
    expect_posed(morphing_scene(), 0.6);
}

TEST(PosedMeshes, Instances)
{
    expect_posed(instanced_scene(), 0.0);
}

TEST(PosedMeshes, SkinsWithEightInfluences)
{
    expect_posed(skinned_scene(), 0.0);
    expect_posed(skinned_scene(), 0.5);
}

TEST(PosedMeshes, OfWhatMovedIsThatOfAll)
{
    // Boxes that stand still, then rise, each at its own time, and then stand still again.
    Scene scene = morphing_scene();
    for (uint32_t i = 0; i < 12; ++i) {
        const Index box =
            test::add_object(scene, shapes::box(glm::vec3(1.0F)), glm::vec3(1.0F), {2.0 * i, 0, 0});
        const auto at_s = static_cast<float>(i % 3);
        scene.animations[0].channels.push_back({.node = box,
                                                .path = AnimatedPath::translation,
                                                .times_s = {at_s, at_s + 1.0F},
                                                .values = {0, 0, 0, 0, 1, static_cast<float>(i)}});
    }
    scene.animations[0].duration_s = 3.0F;
    MeshData meshes = build_meshes(scene, static_cast<Index>(scene.materials.size()));
    MeshBuffers buffers = upload_meshes(test::shared_device(), meshes);
    for (const double time_s : {0.0, 0.5, 0.7, 1.5, 1.5, 2.5, 0.0}) {
        const PoseData now = pose_meshes(meshes, scene, pose_scene(scene, time_s));
        std::ignore = upload_pose(test::shared_device(), buffers, meshes, now);
        swap_posed(buffers);
        gpu::Graph graph;
        const gpu::BufferId posed = add_pose_of_moved(
            graph, buffers, meshes, now, {}, gpu::import_whole(graph, "draws", buffers.draws),
            gpu::import_whole(graph, "rest vertices", buffers.rest_vertices));
        const auto actual = test::run_and_read_as<shared::PosedVertex>(graph, posed);
        keep_posed(buffers);
        const auto wanted = test::Drawing(scene, {}, {16, 16}, time_s).posed();
        ASSERT_EQ(actual.size(), wanted.size());
        EXPECT_EQ(std::memcmp(actual.data(), wanted.data(), std::as_bytes(std::span(wanted)).size()), 0)
            << time_s;
    }
}

/// Sums over the page: the number of covered pixels, and their depth.
std::pair<int, double> seen(const Scene& scene, double time_s = 0.0)
{
    test::Drawing drawing(scene, {.eye = {4.0, 5.0, 9.0}}, {120, 90}, time_s);
    const test::SurfacePixels surface = drawing.surface();
    double sum = 0.0;
    int count = 0;
    int away = 0;
    for (size_t i = 0; i < surface.depth.size(); ++i) {
        sum += static_cast<double>(surface.depth[i]);
        count += surface.depth[i] > 0.0F ? 1 : 0;
        if (surface.depth[i] > 0.0F) {
            const size_t row = i / 120;
            const glm::dvec3 point =
                drawing.point_at({static_cast<double>(i % 120) + 0.5, static_cast<double>(row) + 0.5},
                                 static_cast<double>(surface.depth[i]));
            away += glm::dot(glm::dvec3(drawing.globals.eye_anchor) - point,
                             glm::dvec3(surface.smooth_normal[i])) < 0.0
                        ? 1
                        : 0;
        }
    }
    EXPECT_EQ(away, 0) << "normals that point away from the eye";
    return {count, sum};
}

Scene one_sided_box(const glm::dvec3& scale, bool skinned)
{
    Primitive box = shapes::box({2.0F, 2.0F, 2.0F});
    if (skinned) {
        box.joints_0.assign(box.positions.size(), glm::u16vec4(0));
        box.weights_0.assign(box.positions.size(), {1.0F, 0.0F, 0.0F, 0.0F});
    }
    Scene scene = test::scene_of(std::move(box));
    scene.materials[0].double_sided = false;
    scene.nodes[0].transform.scale = scale;
    if (skinned) {
        scene.nodes[0].transform.scale = glm::dvec3(1.0);
        scene.nodes[0].skin = 0;
        scene.nodes.push_back({.transform = {.scale = scale}});
        scene.roots.push_back(1);
        scene.skins.push_back({.joints = {1}, .joint_from_bind = {glm::mat4(1.0F)}});
    }
    return scene;
}

TEST(PosedMeshes, AMirroredBoxShowsItsOutside)
{
    const auto [count, depth] = seen(one_sided_box(glm::dvec3(1.0), false));
    EXPECT_GT(count, 500);
    for (const glm::dvec3 scale : {glm::dvec3(-1, 1, 1), glm::dvec3(1, 1, -1), glm::dvec3(-1, 1, -1)}) {
        for (const bool skinned : {false, true}) {
            const auto [mirrored_count, mirrored_depth] = seen(one_sided_box(scale, skinned));
            EXPECT_NEAR(mirrored_count, count, 2) << (skinned ? "skinned" : "rigid");
            EXPECT_NEAR(mirrored_depth, depth, 1e-3 * depth) << (skinned ? "skinned" : "rigid");
        }
    }
}

TEST(PosedMeshes, ABoxThatMirrorsItselfInTimeShowsItsOutside)
{
    const auto [count, depth] = seen(one_sided_box(glm::dvec3(1.0), false));
    for (const bool skinned : {false, true}) {
        Scene scene = one_sided_box(glm::dvec3(1.0), skinned);
        scene.animations.push_back({.channels = {{.node = skinned ? 1U : 0U,
                                                  .path = AnimatedPath::scale,
                                                  .interpolation = Interpolation::step,
                                                  .times_s = {0.0F, 1.0F, 2.0F},
                                                  .values = {1, 1, 1, -1, 1, 1, 1, 1, 1}}},
                                    .duration_s = 3.0F});
        for (const double time_s : {0.5, 1.5, 2.5}) {
            const auto [count_then, depth_then] = seen(scene, time_s);
            EXPECT_NEAR(count_then, count, 2) << (skinned ? "skinned, " : "rigid, ") << time_s << " s";
            EXPECT_NEAR(depth_then, depth, 1e-3 * depth) << (skinned ? "skinned, " : "rigid, ") << time_s;
        }
        // One renderer draws all times, so that mirrored triangles also turn back.
        const auto at = [](double time_s) {
            return test::shared_renderer().render({.eye = {4.0, 5.0, 9.0}}, {},
                                                  {.width = 120, .height = 90, .time_s = time_s});
        };
        test::shared_renderer().set_scene(scene);
        const Image mirrored = at(1.5);
        const Image back = at(2.5);
        test::shared_renderer().set_scene(scene);
        EXPECT_EQ(at(0.5), back);
        EXPECT_EQ(at(1.5), mirrored);
    }
}

} // namespace
} // namespace estampe::pose
