// SPDX-License-Identifier: MIT
// The subject of a picture excludes far strays; only characters are viewed at eye level.
#include "scene/view_analysis/subject.hpp"

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "scene/view_analysis/view_analysis.hpp"
#include "support/scenes.hpp"

namespace estampe {
namespace {

constexpr double strays_aspect = 1.5;

Camera framed(const Scene& scene)
{
    return framing_camera(scene, pose_scene(scene, 0.0), strays_aspect);
}

Bounds kept(const Scene& scene)
{
    const ScenePose pose = pose_scene(scene, 0.0);
    return bounds_without_strays(scene, pose, scene_bounds(scene, pose));
}

void expect_same_view(const Camera& a, const Camera& b, double tolerance_m)
{
    EXPECT_LT(glm::distance(a.eye, b.eye), tolerance_m);
    EXPECT_LT(glm::distance(a.target, b.target), tolerance_m);
}

Scene ball()
{
    return test::scene_of(shapes::sphere(1.0F));
}

/// `primitive` with additional vertices that no triangle uses.
Primitive with_loose_vertices(Primitive primitive, std::initializer_list<glm::vec3> places)
{
    for (const glm::vec3& place : places) {
        primitive.positions.push_back(place);
        primitive.normals.push_back({0.0F, 1.0F, 0.0F});
        if (!primitive.uvs[0].empty())
            primitive.uvs[0].emplace_back(0.0F);
        if (!primitive.uvs[1].empty())
            primitive.uvs[1].emplace_back(0.0F);
    }
    return primitive;
}

TEST(Strays, ALesserObjectFarAwayDoesNotShrinkTheSubject)
{
    const Camera alone = framed(ball());
    for (const glm::dvec3 place : {glm::dvec3(200, 0, 0), glm::dvec3(-90, 150, 40), glm::dvec3(0, 0, -1e6)}) {
        Scene scene = ball();
        test::add_object(scene, shapes::box({1.0F, 1.0F, 1.0F}), glm::vec3(1.0F), place);
        expect_same_view(framed(scene), alone, 0.05);
    }
}

TEST(Strays, AFewVerticesFarAwayDoNotShrinkTheSubject)
{
    const Camera alone = framed(ball());
    const Scene loose =
        test::scene_of(with_loose_vertices(shapes::sphere(1.0F), {{150, 3, 0}, {0, -900, 20}, {1e5, 0, 0}}));
    expect_same_view(framed(loose), alone, 0.05);

    Primitive spiky = with_loose_vertices(shapes::sphere(1.0F, 64, 32), {{0, 400, 100}});
    spiky.indices.insert(spiky.indices.end(), {0, 1, static_cast<uint32_t>(spiky.positions.size() - 1)});
    EXPECT_LT(kept(test::scene_of(spiky)).radius(), 2.0) << "a broken vertex of a mesh";
}

TEST(Strays, PointsOfAScanThatFlewAwayAreNotTheSubject)
{
    Primitive points;
    points.topology = Topology::points;
    for (int i = 0; i < 5000; ++i) {
        const double turn = 2.399963 * i;
        const double height = 1.0 - 2.0 * (i + 0.5) / 5000.0;
        const double width = std::sqrt(1.0 - height * height);
        points.positions.emplace_back(width * std::cos(turn), height, width * std::sin(turn));
        points.indices.push_back(static_cast<uint32_t>(i));
    }
    for (const glm::vec3 place : {glm::vec3(300, 0, 0), glm::vec3(0, 50, -900)}) {
        points.indices.push_back(static_cast<uint32_t>(points.positions.size()));
        points.positions.push_back(place);
    }
    EXPECT_NEAR(kept(test::scene_of(points)).radius(), std::sqrt(3.0), 0.05);
}

TEST(Strays, WhatBelongsTogetherIsKeptWhole)
{
    Scene row;
    for (int i = 0; i < 30; ++i)
        test::add_object(row, shapes::box({1, 1, 1}), glm::vec3(1.0F), {8.0 * i, 0, 0});
    EXPECT_NEAR(kept(row).max.x, 232.5, 1e-3) << "a row of equal things";

    Scene near = ball();
    test::add_object(near, shapes::box({0.2F, 0.2F, 0.2F}), glm::vec3(1.0F), {9.0, 0, 0});
    EXPECT_NEAR(kept(near).max.x, 9.1, 1e-3) << "not far";

    Scene three;
    for (int i = -1; i <= 1; ++i)
        test::add_object(three, shapes::box({1, 1, 1}), glm::vec3(1.0F), {300.0 * i, 0, 0});
    EXPECT_NEAR(kept(three).max.x, 300.5, 1e-3) << "none of the three is a stray";

    Scene hall = test::scene_of(shapes::box({60, 20, 60}));
    test::add_object(hall, shapes::sphere(0.5F, 64, 32), glm::vec3(1.0F), {0, 1.0, 0});
    EXPECT_NEAR(kept(hall).max.x, 30.0, 1e-3) << "the room around a small thing";
}

TEST(HugeFloor, IsLeftOutWhereItIsOneMeshWithWhatStandsOnIt)
{
    const Primitive thing = shapes::sphere(0.6F);
    Scene alone = test::scene_of(thing);
    alone.nodes[0].transform.translation.y = 0.6;
    const Camera expected = framed(alone);
    for (const float side : {20.0F, 300.0F}) {
        SCOPED_TRACE(side);
        Primitive merged = shapes::plane(side, side, 4);
        shapes::append(merged, thing, glm::translate(glm::mat4(1.0F), {0.0F, 0.6F, 0.0F}));
        const Camera camera = framed(test::scene_of(merged));
        EXPECT_LT(glm::distance(camera.eye, camera.target),
                  1.3 * glm::distance(expected.eye, expected.target));
    }
}

/// A person made of boxes and spheres, 1.8 m high, who faces +z.
Scene person()
{
    Scene scene = test::scene_of(shapes::box({0.45F, 0.6F, 0.22F}));
    scene.nodes[0].transform.translation = {0, 0.8, 0};
    const auto add = [&](const Primitive& part, const glm::dvec3& place) {
        test::add_object(scene, part, glm::vec3(1.0F), place);
    };
    add(shapes::sphere(0.12F), {0, 1.68, 0.01});
    add(shapes::cylinder(0.05F, 0.2F), {0, 1.4, 0});
    for (const double side : {-1.0, 1.0}) {
        add(shapes::box({0.14F, 0.82F, 0.16F}), {side * 0.12, 0.0, 0});
        add(shapes::box({0.1F, 0.6F, 0.1F}), {side * 0.28, 0.8, 0});
    }
    return scene;
}

std::optional<double> eyes_of(const Scene& scene)
{
    return eye_level(scene, surface_cloud(scene, pose_scene(scene, 0.0)));
}

TEST(Figures, ArePicturedFromTheHeightOfTheirEyesAndTheirFront)
{
    const Scene scene = person();
    ASSERT_TRUE(eyes_of(scene));
    EXPECT_NEAR(*eyes_of(scene), 1.65, 0.12);
    for (const double page_aspect : {16.0 / 9.0, 1.0, 0.5}) {
        SCOPED_TRACE(page_aspect);
        const Camera camera = framing_camera(scene, pose_scene(scene, 0.0), page_aspect);
        EXPECT_NEAR(camera.eye.y, 1.65, 0.3);
        const glm::dvec3 back = glm::normalize(camera.eye - camera.target);
        EXPECT_GT(back.z, 0.9) << "the front";
        EXPECT_LT(back.z, 0.99) << "a little aside, so that it is no flat elevation";
    }
}

TEST(Figures, OrdinaryThingsAreNone)
{
    EXPECT_FALSE(eyes_of(test::scene_of(shapes::cylinder(0.25F, 1.7F))));
    EXPECT_FALSE(eyes_of(test::scene_of(shapes::box({0.6F, 1.8F, 0.4F})))) << "a cupboard";
    EXPECT_FALSE(eyes_of(test::scene_of(shapes::sphere(1.0F))));
    Scene lamp = test::scene_of(shapes::cylinder(0.03F, 1.5F));
    test::add_object(lamp, shapes::cylinder(0.2F, 0.04F), glm::vec3(1.0F));
    test::add_object(lamp, shapes::cone(0.25F, 0.3F), glm::vec3(1.0F), {0, 1.5, 0});
    EXPECT_FALSE(eyes_of(lamp)) << "a body of revolution";
    Scene chair = test::scene_of(shapes::box({0.45F, 0.05F, 0.45F}));
    chair.nodes[0].transform.translation = {0, 0.4, 0};
    test::add_object(chair, shapes::box({0.45F, 0.5F, 0.04F}), glm::vec3(1.0F), {0, 0.45, -0.2});
    for (const double x : {-0.2, 0.2}) {
        for (const double z : {-0.2, 0.2})
            test::add_object(chair, shapes::box({0.04F, 0.45F, 0.04F}), glm::vec3(1.0F), {x, 0.0, z});
    }
    EXPECT_FALSE(eyes_of(chair));
}

TEST(FramedShadow, NeedsNoRoomWhereNoGroundTakesIt)
{
    const auto aside = [](Scene scene, const SunBearing& sun) {
        const Camera camera = framing_camera(scene, pose_scene(scene, 0.0), 16.0 / 9.0, sun);
        const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
        const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up));
        return std::abs(glm::dot(glm::dvec3(0.0, 0.6, 0.0) - camera.eye, right));
    };
    Scene post = test::scene_of(shapes::cylinder(0.4F, 1.2F));
    EXPECT_GT(aside(post, {}), 0.1);
    EXPECT_NEAR(aside(post, {.on_blank_ground = false}), 0.0, 0.03);
    post.cameras.emplace_back();
    post.nodes.push_back({.camera = 0});
    post.roots.push_back(static_cast<Index>(post.nodes.size() - 1));
    EXPECT_NEAR(aside(post, {}), 0.0, 0.03) << "with a camera of its own a scene has no blank ground";
    EXPECT_GT(aside(post, {.on_blank_ground = true}), 0.1);
    test::add_object(post, shapes::plane(20.0F, 20.0F, 8), glm::vec3(1.0F), {0, 0, 0});
    EXPECT_GT(aside(post, {}), 0.1) << "but a floor";
}

} // namespace
} // namespace estampe
