// SPDX-License-Identifier: MIT
#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "scene/up_axis.hpp"

namespace estampe {
namespace {

Scene scene_of(Primitive primitive)
{
    Scene scene;
    scene.materials.emplace_back();
    scene.meshes.emplace_back().primitives.push_back(std::move(primitive));
    scene.nodes.push_back({.mesh = 0});
    scene.roots = {0};
    return scene;
}

/// Converts a scene from y up to z up, like an exporter that keeps Blender's axes.
Scene z_up(Scene scene)
{
    scene.nodes[0].transform.rotation = glm::angleAxis(std::numbers::pi / 2.0, glm::dvec3(1.0, 0.0, 0.0));
    return scene;
}

/// A gentle hill, open below.
Primitive terrain()
{
    Primitive ground = shapes::plane(10.0F, 10.0F, 20);
    for (glm::vec3& p : ground.positions) {
        p.y = 5.0F + 0.6F * std::cos(0.5F * p.x) * std::sin(0.6F * p.z);
    }
    return ground;
}

/// Floor, ceiling and three walls that face inwards; open towards +z.
Primitive open_room()
{
    Primitive room = shapes::box({2.0F, 2.0F, 2.0F});
    Primitive inside = room;
    inside.indices.clear();
    for (size_t i = 0; i + 2 < room.indices.size(); i += 3) {
        if (room.normals[room.indices[i]].z < 0.5F) {
            inside.indices.insert(inside.indices.end(),
                                  {room.indices[i], room.indices[i + 2], room.indices[i + 1]});
        }
    }
    for (glm::vec3& p : inside.positions) {
        p += glm::vec3(0.0F, 7.0F, 0.0F);
    }
    return inside;
}

TEST(UpAxis, SolidsWithABaseStandOnIt)
{
    EXPECT_EQ(guess_up_axis(scene_of(shapes::cone(1.0F, 2.0F))), UpAxis::y);
    EXPECT_EQ(guess_up_axis(z_up(scene_of(shapes::cone(1.0F, 2.0F)))), UpAxis::z);
    EXPECT_EQ(guess_up_axis(scene_of(shapes::stairs(1.0F, 0.2F, 0.3F, 5))), UpAxis::y);
}

TEST(UpAxis, TerrainFacesTheSky)
{
    EXPECT_EQ(guess_up_axis(scene_of(terrain())), UpAxis::y);
    EXPECT_EQ(guess_up_axis(z_up(scene_of(terrain()))), UpAxis::z);
}

TEST(UpAxis, WhatStandsOnTheOriginIsUpright)
{
    Scene ball = scene_of(shapes::sphere(1.0F));
    ball.nodes[0].transform.translation = {7.0, 1.0, 3.0};
    EXPECT_EQ(guess_up_axis(ball), UpAxis::y);
    ball.nodes[0].transform.translation = {7.0, 3.0, 1.0};
    EXPECT_EQ(guess_up_axis(ball), UpAxis::z);
}

TEST(UpAxis, NothingIsSaidWithoutEvidence)
{
    EXPECT_EQ(guess_up_axis(scene_of(shapes::sphere(1.0F))), std::nullopt);
    EXPECT_EQ(guess_up_axis(z_up(scene_of(shapes::torus(1.0F, 0.3F)))), std::nullopt);
    Scene cube = scene_of(shapes::box(glm::vec3(1.0F)));
    cube.nodes[0].transform.translation = {0.3, 4.0, 5.0};
    EXPECT_EQ(guess_up_axis(cube), std::nullopt);
    EXPECT_EQ(guess_up_axis(Scene{}), std::nullopt);
}

TEST(UpAxis, ABackWallIsNoFloor)
{
    EXPECT_NE(guess_up_axis(scene_of(open_room())), UpAxis::z);
}

/// Mirroring reverses the winding of triangles, but does not turn the solid inside out.
TEST(UpAxis, AMirroredSolidStandsAsItsOriginal)
{
    Scene hill = scene_of(terrain());
    hill.nodes[0].transform.scale = {-1.0, 1.0, 1.0};
    EXPECT_EQ(guess_up_axis(hill), UpAxis::y);
}

} // namespace
} // namespace estampe
