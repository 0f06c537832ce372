// SPDX-License-Identifier: MIT
// A transformed mesh has the transformed outline: a mesh placed by a node, a joint or an instance has the
// same lines as one whose vertices were transformed beforehand.
#include <functional>
#include <random>

#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "features/lines/lines.hpp"
#include "scene/pose.hpp"
#include "support/drawing.hpp"
#include "support/scenes.hpp"
#include "techniques/contour/chains/chains_test_scene.hpp"

namespace estampe::contour {
namespace {

constexpr glm::uvec2 turned_page_px{160, 120};

/// A copy in which each triangle has its own vertices and one normal.
Primitive flat_shaded(const Primitive& smooth)
{
    Primitive flat;
    for (size_t i = 0; i + 2 < smooth.indices.size(); i += 3) {
        const glm::vec3 a = smooth.positions[smooth.indices[i]];
        const glm::vec3 b = smooth.positions[smooth.indices[i + 1]];
        const glm::vec3 c = smooth.positions[smooth.indices[i + 2]];
        const glm::vec3 across = glm::cross(b - a, c - a);
        if (!(glm::length(across) > 1e-6F)) {
            continue;
        }
        for (const glm::vec3& corner : {a, b, c}) {
            flat.indices.push_back(static_cast<uint32_t>(flat.positions.size()));
            flat.positions.push_back(corner);
            flat.normals.push_back(glm::normalize(across));
        }
    }
    return flat;
}

/// The primitive with vertices transformed by `turn`; mirroring also reverses the winding.
Primitive placed_beforehand(Primitive primitive, const glm::dmat4& turn)
{
    const bool is_mirroring = glm::determinant(glm::dmat3(turn)) < 0.0;
    const glm::dmat3 turn_normal = glm::transpose(glm::inverse(glm::dmat3(turn)));
    for (glm::vec3& position : primitive.positions) {
        position = glm::vec3(turn * glm::dvec4(position, 1.0));
    }
    for (glm::vec3& normal : primitive.normals) {
        normal = glm::vec3(glm::normalize(turn_normal * glm::dvec3(normal)));
    }
    for (size_t i = 0; is_mirroring && i + 2 < primitive.indices.size(); i += 3) {
        std::swap(primitive.indices[i], primitive.indices[i + 1]);
    }
    return primitive;
}

Scene by_node(const Primitive& primitive, const glm::dmat4& turn)
{
    Scene scene = test::scene_of(primitive);
    scene.nodes[0].matrix = turn;
    return scene;
}

Scene by_instance(const Primitive& primitive, const glm::dmat4& turn)
{
    Scene scene = test::scene_of(primitive);
    scene.nodes[0].instances = {glm::mat4(turn)};
    return scene;
}

Scene by_joint(const Primitive& primitive, const glm::dmat4& turn)
{
    Primitive skinned = primitive;
    skinned.joints_0.assign(skinned.positions.size(), glm::u16vec4(0));
    skinned.weights_0.assign(skinned.positions.size(), glm::vec4(1.0F, 0.0F, 0.0F, 0.0F));
    Scene scene = test::scene_of(skinned);
    const auto joint = static_cast<Index>(scene.nodes.size());
    scene.nodes.emplace_back().matrix = turn;
    scene.roots.push_back(joint);
    scene.skins.push_back({.name = "skin", .joints = {joint}, .joint_from_bind = {glm::mat4(1.0F)}});
    scene.nodes[0].skin = 0;
    return scene;
}

/// Number of segments in the outlines and creases of a scene.
uint32_t segments_of(const Scene& scene)
{
    test::Drawing drawing(scene, view_from_above(), turned_page_px);
    return drawing.chain_sizes({.intersection = {.enabled = false}})[shared::list_segments].count;
}

glm::dmat4 random_turn(std::mt19937& random)
{
    std::normal_distribution<double> normal;
    const glm::dquat turn(normal(random), normal(random), normal(random), normal(random));
    return glm::mat4_cast(glm::normalize(turn));
}

using Placing = std::function<Scene(const Primitive&, const glm::dmat4&)>;

void expect_same_lines(const Primitive& primitive, const std::vector<Placing>& placings,
                       const glm::dmat4& mirroring, int turn_count)
{
    std::mt19937 random(7);
    for (int i = 0; i < turn_count; ++i) {
        const glm::dmat4 turn = random_turn(random) * mirroring;
        const auto expected =
            static_cast<double>(segments_of(test::scene_of(placed_beforehand(primitive, turn))));
        EXPECT_GT(expected, 8.0);
        for (size_t placing = 0; placing < placings.size(); ++placing) {
            // Rounding may differ for a triangle that is seen edge-on.
            EXPECT_NEAR(static_cast<double>(segments_of(placings[placing](primitive, turn))), expected, 2.0)
                << "placing " << placing << ", turn " << i;
        }
    }
}

const glm::dmat4 as_it_is(1.0);
const glm::dmat4 mirrored = glm::scale(glm::dmat4(1.0), glm::dvec3(-1.0, 1.0, 1.0));

TEST(TurnedMesh, AFlatOneHasTheLinesOfTheMeshTurned)
{
    expect_same_lines(flat_shaded(shapes::sphere(1.2F, 10, 6)), {by_node, by_instance, by_joint}, as_it_is,
                      50);
}

TEST(TurnedMesh, ASmoothOneHasTheLinesOfTheMeshTurned)
{
    expect_same_lines(shapes::torus(1.0F, 0.4F, 20, 10), {by_node, by_joint}, as_it_is, 50);
}

TEST(TurnedMesh, AMirroredOneHasTheLinesOfTheMeshMirrored)
{
    expect_same_lines(flat_shaded(shapes::torus(1.0F, 0.4F, 12, 8)), {by_node}, mirrored, 10);
    expect_same_lines(shapes::torus(1.0F, 0.4F, 20, 10), {by_node, by_joint}, mirrored, 10);
}

} // namespace
} // namespace estampe::contour
