// SPDX-License-Identifier: MIT
#include "scene/mending/repair.hpp"

#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

namespace estampe {
namespace {

Primitive inside_out(Primitive primitive)
{
    for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        std::swap(primitive.indices[i], primitive.indices[i + 1]);
    }
    for (glm::vec3& normal : primitive.normals) {
        normal = -normal;
    }
    return primitive;
}

double volume_m3(const Primitive& primitive)
{
    double volume = 0.0;
    for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        const auto corner = [&](size_t k) {
            return glm::dvec3(primitive.positions[primitive.indices[i + k]]);
        };
        volume += glm::dot(corner(0), glm::cross(corner(1), corner(2))) / 6.0;
    }
    return volume;
}

Scene scene_of_meshes(const std::vector<Primitive>& primitives)
{
    Scene scene;
    for (const Primitive& primitive : primitives) {
        scene.meshes.push_back({.name = "thing", .primitives = {primitive}, .morph_weights = {}});
        scene.nodes.emplace_back().mesh = static_cast<Index>(scene.meshes.size() - 1);
        scene.roots.push_back(static_cast<Index>(scene.nodes.size() - 1));
    }
    return scene;
}

const Primitive& first(const Scene& scene)
{
    return scene.meshes[0].primitives[0];
}

TEST(TurnOutside, MarksOfEdgesTurnWithTheirTriangles)
{
    Primitive ball = inside_out(shapes::sphere(1.0F, 16, 8));
    ball.edge_marks.assign(ball.indices.size() / 3, 1); // marks the edge from the first corner to the second
    Scene scene = scene_of_meshes({ball});
    turn_outside(scene);
    EXPECT_EQ(first(scene).edge_marks[7], 4) << "from the last corner to the first";
    EXPECT_EQ(first(scene).indices[21], ball.indices[21]);
    EXPECT_EQ(first(scene).indices[23], ball.indices[22]);
}

TEST(TurnOutside, WhatIsInsideOutIsTurnedWithItsNormals)
{
    Scene scene = scene_of_meshes({inside_out(shapes::sphere(1.0F, 16, 8))});
    EXPECT_LT(volume_m3(first(scene)), 0.0);
    turn_outside(scene);
    EXPECT_GT(volume_m3(first(scene)), 3.5);
    for (const uint32_t i : first(scene).indices) {
        EXPECT_GT(glm::dot(first(scene).normals[i], first(scene).positions[i]), 0.9F);
    }
    ASSERT_EQ(scene.warnings.size(), 1U);
    EXPECT_EQ(scene.warnings[0], "mesh \"thing\": 1 closed piece was inside out, turned over");
}

TEST(TurnOutside, NormalsThatPointOutAlreadyStay)
{
    Primitive wound_wrong = inside_out(shapes::sphere(1.0F, 16, 8));
    for (glm::vec3& normal : wound_wrong.normals) {
        normal = -normal;
    }
    Scene scene = scene_of_meshes({wound_wrong});
    turn_outside(scene);
    EXPECT_GT(volume_m3(first(scene)), 3.5);
    EXPECT_GT(glm::dot(first(scene).normals[20], first(scene).positions[20]), 0.9F);
}

TEST(TurnOutside, WhatIsRightOrOpenStays)
{
    Scene scene = scene_of_meshes({shapes::torus(1.0F, 0.4F), inside_out(shapes::plane(1.0F, 1.0F, 4))});
    const std::vector<Mesh> before = scene.meshes;
    turn_outside(scene);
    EXPECT_EQ(first(scene).indices, before[0].primitives[0].indices);
    EXPECT_EQ(scene.meshes[1].primitives[0].indices, before[1].primitives[0].indices);
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(TurnOutside, TrianglesThatHaveCollapsedToASideDoNotOpenAPiece)
{
    Primitive ball = inside_out(shapes::sphere(1.0F, 16, 8));
    ball.indices.insert(ball.indices.end(), {ball.indices[30], ball.indices[30], ball.indices[31]});
    Scene scene = scene_of_meshes({ball});
    turn_outside(scene);
    EXPECT_GT(volume_m3(first(scene)), 3.5);
}

TEST(TurnOutside, ARoomWithThingsInItStaysAndOneAllInsideOutDoesNot)
{
    const Primitive room = inside_out(shapes::box({8.0F, 6.0F, 8.0F}));
    Primitive ball = shapes::sphere(1.0F, 16, 8);
    for (glm::vec3& position : ball.positions) {
        position.y += 3.0F;
    }
    Scene furnished = scene_of_meshes({room, ball});
    turn_outside(furnished);
    EXPECT_LT(volume_m3(first(furnished)), 0.0);
    Scene all_wrong = scene_of_meshes({room, inside_out(ball)});
    turn_outside(all_wrong);
    EXPECT_GT(volume_m3(first(all_wrong)), 0.0);
    EXPECT_GT(volume_m3(all_wrong.meshes[1].primitives[0]), 0.0);
}

} // namespace
} // namespace estampe
