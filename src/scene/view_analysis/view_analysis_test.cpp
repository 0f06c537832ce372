// SPDX-License-Identifier: MIT
#include "scene/view_analysis/view_analysis.hpp"

#include <cmath>
#include <utility>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <estampe/default_light.hpp>
#include <estampe/shapes.hpp>

#include "scene/view_analysis/subject.hpp"
#include "scene/view_analysis/surface_points.hpp"
#include "support/scenes.hpp"

namespace estampe {
namespace {

SurfaceCloud cloud_of(const Scene& scene)
{
    return surface_cloud(scene, pose_scene(scene, 0.0));
}

glm::mat4 moved_to(float x, float y, float z)
{
    return glm::translate(glm::mat4(1.0F), {x, y, z});
}

/// An animal with four legs and a high head at its front, +z, with eyes and a muzzle.
Primitive beast()
{
    Primitive body;
    shapes::append(body, shapes::box({0.6F, 0.6F, 1.6F}), moved_to(0.0F, 0.6F, 0.0F));
    for (const float x : {-0.2F, 0.2F}) {
        for (const float z : {-0.7F, 0.7F})
            shapes::append(body, shapes::cylinder(0.08F, 0.7F), moved_to(x, 0.0F, z));
        shapes::append(body, shapes::sphere(0.06F), moved_to(x, 1.65F, 1.25F));
    }
    shapes::append(body, shapes::box({0.5F, 0.5F, 0.5F}), moved_to(0.0F, 1.2F, 1.0F));
    shapes::append(body, shapes::box({0.3F, 0.2F, 0.3F}), moved_to(0.0F, 1.25F, 1.35F));
    return body;
}

/// A seat with a thin, high back at -z.
Primitive chair()
{
    Primitive whole;
    shapes::append(whole, shapes::box({0.5F, 0.06F, 0.5F}), moved_to(0.0F, 0.4F, 0.0F));
    shapes::append(whole, shapes::box({0.5F, 0.6F, 0.05F}), moved_to(0.0F, 0.4F, -0.24F));
    for (const float x : {-0.22F, 0.22F})
        for (const float z : {-0.22F, 0.22F})
            shapes::append(whole, shapes::box({0.05F, 0.4F, 0.05F}), moved_to(x, 0.0F, z));
    return whole;
}

/// A slab that is blank on its +z face, and has shelves, rods and knobs on the other.
Primitive cabinet()
{
    Primitive whole;
    shapes::append(whole, shapes::box({2.0F, 2.0F, 0.2F}), glm::mat4(1.0F));
    for (int shelf = 0; shelf < 5; ++shelf) {
        const auto height = 0.1F + 0.4F * static_cast<float>(shelf);
        shapes::append(whole, shapes::box({1.9F, 0.05F, 0.5F}), moved_to(0.0F, height, -0.3F));
        for (const float x : {-0.8F, -0.3F, 0.3F, 0.8F})
            shapes::append(whole, shapes::sphere(0.13F), moved_to(x, height + 0.18F, -0.35F));
    }
    return whole;
}

Scene turned_scene(const Primitive& primitive, double angle_rad)
{
    Scene scene = test::scene_of(primitive);
    scene.nodes[0].transform.rotation = glm::angleAxis(angle_rad, glm::dvec3(0, 1, 0));
    return scene;
}

bool from_front(const Scene& scene)
{
    return std::cos(analyze_view(scene).azimuth_rad) > 0.0;
}

/// A room with thick walls: six slabs around 6 x 3 x 5 metres, with a table inside.
Scene thick_room()
{
    Primitive slabs;
    shapes::append(slabs, shapes::box({6.6F, 0.3F, 5.6F}), moved_to(0.0F, -0.3F, 0.0F));
    shapes::append(slabs, shapes::box({6.6F, 0.3F, 5.6F}), moved_to(0.0F, 3.0F, 0.0F));
    for (const float side : {-1.0F, 1.0F}) {
        shapes::append(slabs, shapes::box({6.6F, 3.0F, 0.3F}), moved_to(0.0F, 0.0F, 2.65F * side));
        shapes::append(slabs, shapes::box({0.3F, 3.0F, 5.0F}), moved_to(3.15F * side, 0.0F, 0.0F));
    }
    Scene scene = test::scene_of(slabs);
    test::add_object(scene, shapes::box({1.5F, 0.8F, 0.9F}), glm::vec3(1.0F));
    return scene;
}

TEST(SurfaceCloud, SpreadsPointsByAreaAndPrimitive)
{
    Scene scene = test::scene_of(shapes::box({1.0F, 1.0F, 1.0F}));
    test::add_object(scene, shapes::box({2.0F, 2.0F, 2.0F}), glm::vec3(1.0F), {10.0, 0.0, 0.0});
    const SurfaceCloud cloud = cloud_of(scene);
    size_t small = 0;
    for (const SurfacePoint& point : cloud.points) {
        const double x = static_cast<double>(point.position.x) + cloud.origin.x;
        small += x < 5.0 ? 1U : 0U;
        EXPECT_NEAR(glm::length(point.normal), 1.0F, 1e-5F);
    }
    EXPECT_NEAR(static_cast<double>(cloud.points.size()), 32768.0, 2.0);
    EXPECT_NEAR(static_cast<double>(small) / static_cast<double>(cloud.points.size()), 0.35, 1e-3)
        << "a fifth of the area, half of the primitives";
    EXPECT_TRUE(cloud_of(test::scene_of(Primitive{})).points.empty());
}

TEST(ViewAnalysis, ShowsTheFaceOfABeastWhicheverWayItLooks)
{
    EXPECT_TRUE(from_front(turned_scene(beast(), 0.0)));
    EXPECT_FALSE(from_front(turned_scene(beast(), 3.14159265)));
}

TEST(ViewAnalysis, TakesAModelsFrontAtItsWord)
{
    EXPECT_NEAR(analyze_view(turned_scene(chair(), 0.0)).azimuth_rad, 0.61, 1e-9);
    EXPECT_NEAR(analyze_view(test::scene_of(shapes::torus(1.0F, 0.3F))).azimuth_rad, 0.61, 1e-9);
    EXPECT_NEAR(analyze_view(test::scene_of(shapes::box({1.0F, 2.0F, 1.0F}))).azimuth_rad, 0.61, 1e-9);
}

TEST(ViewAnalysis, TurnsABlankBackAway)
{
    EXPECT_FALSE(from_front(turned_scene(cabinet(), 0.0)));
    EXPECT_TRUE(from_front(turned_scene(cabinet(), 3.14159265)));
}

TEST(ViewAnalysis, LeavesAFairPartOfTheModelInTheSun)
{
    const std::pair<Scene, const char*> scenes[] = {{turned_scene(beast(), 0.0), "beast"},
                                                    {turned_scene(beast(), 3.14159265), "turned beast"},
                                                    {turned_scene(chair(), 0.0), "chair"},
                                                    {turned_scene(cabinet(), 0.0), "cabinet"},
                                                    {test::scene_of(shapes::sphere(1.0F)), "sphere"},
                                                    {test::scene_of(shapes::cylinder(0.3F, 2.0F)), "post"}};
    for (const auto& [scene, name] : scenes) {
        const SurfaceCloud cloud = cloud_of(scene);
        const ViewAnalysis analysis = analyze_view(cloud);
        const ViewAxes axes = look_from(analysis.azimuth_rad, analysis.elevation_rad);
        const glm::dvec3 sun = analysis.towards_sun(house_sun_azimuth_deg, house_sun_elevation_deg);
        const double lit =
            lit_share(cloud, seen_points(see_from_afar(cloud, axes, analysis.subject)), axes, sun);
        EXPECT_GT(lit, 0.45) << name;
        EXPECT_LT(lit, 0.93) << name;
        EXPECT_NEAR(sun.y, std::sin(glm::radians(static_cast<double>(house_sun_elevation_deg))), 1e-6)
            << "low";
        EXPECT_LT(glm::dot(sun, axes.forward), 0.0) << "behind the eye";
        EXPECT_GT(std::abs(glm::dot(sun, axes.right)), 0.4) << "from the side";
        EXPECT_FALSE(analysis.shelter) << name;
    }
}

TEST(LitShare, CountsWhatTheSunReaches)
{
    const SurfaceCloud ball = cloud_of(test::scene_of(shapes::sphere(1.0F, 64, 32)));
    const ViewAxes level = look_from(0.0, 0.0);
    const std::vector<uint32_t> points = seen_points(see_from_afar(ball, level, ball.bounds));
    EXPECT_GT(lit_share(ball, points, level, bearing(0.0, 0.0)), 0.95) << "from the eye";
    EXPECT_NEAR(lit_share(ball, points, level, bearing(1.5708, 0.0)), 0.468, 0.04)
        << "from the side: half the disc, less a twentieth at the edge of light";
    EXPECT_LT(lit_share(ball, points, level, bearing(3.1416, 0.0)), 0.05) << "from behind";

    Scene roofed = test::scene_of(shapes::plane(2.0F, 2.0F));
    test::add_object(roofed, shapes::plane(4.0F, 4.0F), glm::vec3(1.0F), {0.0, 1.0, 0.0});
    const SurfaceCloud cloud = cloud_of(roofed);
    std::vector<uint32_t> floor;
    for (size_t i = 0; i < cloud.points.size(); ++i)
        if (cloud.points[i].position.y < 0.0F)
            floor.push_back(static_cast<uint32_t>(i));
    const ViewAxes above = look_from(0.0, 0.8);
    EXPECT_LT(lit_share(cloud, floor, above, bearing(0.3, 1.4)), 0.02) << "below a roof";
    EXPECT_GT(lit_share(cloud, floor, above, bearing(0.3, 0.1)), 0.95) << "in under it";
}

TEST(Subject, LeavesOutAFloorMuchWiderThanWhatStandsOnIt)
{
    Scene scene = test::scene_of(shapes::plane(10.0F, 8.0F));
    test::add_object(scene, shapes::box({1.0F, 1.5F, 0.8F}), glm::vec3(1.0F), {2.0, 0.0, -1.0});
    const Bounds subject = subject_bounds(cloud_of(scene));
    EXPECT_NEAR(subject.min.x, 1.5, 0.05);
    EXPECT_NEAR(subject.max.x, 2.5, 0.05);
    EXPECT_NEAR(subject.min.y, 0.0, 0.05);
    EXPECT_NEAR(subject.max.y, 1.5, 0.05);
    EXPECT_NEAR(subject.max.z, -0.6, 0.05);
}

TEST(Subject, KeepsWhatItShouldKeep)
{
    const auto all = [](const Scene& scene) {
        const SurfaceCloud cloud = cloud_of(scene);
        const Bounds subject = subject_bounds(cloud);
        return subject.min == cloud.bounds.min && subject.max == cloud.bounds.max;
    };
    EXPECT_TRUE(all(test::scene_of(shapes::plane(10.0F, 10.0F)))) << "a floor alone";
    EXPECT_TRUE(all(test::scene_of(shapes::cone(1.0F, 2.0F))));
    EXPECT_TRUE(all(test::scene_of(shapes::stairs(2.0F, 0.2F, 0.3F, 6))));
    Scene narrow = test::scene_of(shapes::plane(3.0F, 3.0F));
    test::add_object(narrow, shapes::box({2.5F, 1.0F, 2.5F}), glm::vec3(1.0F));
    EXPECT_TRUE(all(narrow)) << "a plinth";
    Scene table = test::scene_of(shapes::box({3.0F, 0.1F, 3.0F}));
    table.nodes[0].transform.translation = {0.0, 1.0, 0.0};
    test::add_object(table, shapes::cylinder(0.2F, 1.0F), glm::vec3(1.0F));
    EXPECT_TRUE(all(table)) << "a top is no floor";
    Scene hat = test::scene_of(shapes::cylinder(1.2F, 0.01F));
    test::add_object(hat, shapes::cylinder(0.5F, 0.9F), glm::vec3(1.0F));
    EXPECT_TRUE(all(hat)) << "a brim";
    Scene tower = test::scene_of(shapes::box({3.0F, 0.3F, 3.0F}));
    test::add_object(tower, shapes::box({0.8F, 3.0F, 0.8F}), glm::vec3(1.0F), {0.0, 0.3, 0.0});
    EXPECT_TRUE(all(tower)) << "a step";
    Scene axes = test::scene_of(shapes::box({0.1F, 1.4F, 0.1F}));
    test::add_object(axes, shapes::box({2.0F, 0.02F, 0.1F}), glm::vec3(1.0F), {1.0, 0.0, 0.0});
    test::add_object(axes, shapes::box({0.1F, 0.02F, 1.0F}), glm::vec3(1.0F), {0.0, 0.0, 0.5});
    EXPECT_TRUE(all(axes)) << "arms";
}

TEST(Shelter, AClosedHollowIsSeenFromACornerByALamp)
{
    const Scene scene = thick_room();
    const ViewAnalysis analysis = analyze_view(scene);
    ASSERT_EQ(analysis.standpoint, Standpoint::inside);
    EXPECT_LT(std::abs(analysis.corner.x), 3.0);
    EXPECT_LT(std::abs(analysis.corner.z), 2.5);
    EXPECT_GT(std::abs(analysis.corner.x), 1.5) << "in a corner";
    EXPECT_GT(std::abs(analysis.corner.z), 1.2);
    EXPECT_GT(analysis.corner.y, 1.0);
    EXPECT_LT(analysis.corner.y, 2.5);
    ASSERT_TRUE(analysis.shelter);
    EXPECT_NEAR(analysis.shelter->lamp.x, 0.0, 0.8);
    EXPECT_NEAR(analysis.shelter->lamp.z, 0.0, 0.8);
    EXPECT_GT(analysis.shelter->lamp.y, 2.0);
    EXPECT_LT(analysis.shelter->lamp.y, 3.0);
    const Camera camera = framing_camera(scene, pose_scene(scene, 0.0), 1.6);
    EXPECT_EQ(camera.eye, analysis.corner);
    EXPECT_LT(glm::dot(camera.target - camera.eye, camera.eye * glm::dvec3(1, 0, 1)), 0.0) << "inwards";
}

TEST(DefaultLight, IsTheScenesOwnElseTheSunOrInARoomALamp)
{
    EXPECT_EQ(default_light(thick_room()), LightChoice::lamp);
    Scene lit = thick_room();
    lit.lights.push_back({.type = LightType::point});
    EXPECT_EQ(default_light(lit), LightChoice::lamp) << "a light that no node holds lights nothing";
    lit.nodes[0].light = 0;
    EXPECT_EQ(default_light(lit), LightChoice::own);
    EXPECT_EQ(default_light(test::scene_of(beast())), LightChoice::sun);
    EXPECT_EQ(default_light(Scene{}), LightChoice::sun);
}

TEST(Shelter, ASolidThingIsNoRoomAndAnEyeOutsideNeedsNoLamp)
{
    Scene machine = test::scene_of(shapes::box({2.0F, 2.0F, 2.0F}));
    for (int i = 0; i < 27; ++i)
        test::add_object(machine, shapes::box({0.5F, 0.5F, 0.5F}), glm::vec3(1.0F),
                         {0.6 * (i % 3 - 1), 0.1 + 0.6 * (i / 9), 0.6 * (i / 3 % 3 - 1)});
    EXPECT_EQ(analyze_view(machine).standpoint, Standpoint::outside) << "filled, though much is hidden";
    const SurfaceCloud cloud = cloud_of(thick_room());
    EXPECT_FALSE(shelter_around(cloud, {8.0, 2.0, 7.0}));
    EXPECT_FALSE(shelter_around(cloud, {0.0, 9.0, 0.0}));
    EXPECT_TRUE(shelter_around(cloud, {1.0, 1.5, -1.0}));
}

/// A hollow box of six slabs, each a twentieth of its length thick.
Primitive hollow_box(const glm::vec3& size)
{
    Primitive slabs;
    const glm::vec3 wall = 0.05F * size;
    for (const float side : {0.0F, 1.0F}) {
        shapes::append(slabs, shapes::box({size.x, wall.y, size.z}),
                       moved_to(0.0F, side * (size.y - wall.y), 0.0F));
        const float sign = 2.0F * side - 1.0F;
        shapes::append(slabs, shapes::box({size.x, size.y, wall.z}),
                       moved_to(0.0F, 0.0F, 0.5F * sign * (size.z - wall.z)));
        shapes::append(slabs, shapes::box({wall.x, size.y, size.z}),
                       moved_to(0.5F * sign * (size.x - wall.x), 0.0F, 0.0F));
    }
    return slabs;
}

/// The faces of a box, and copies of them with reversed winding.
Primitive doubled_box(float side)
{
    Primitive box = shapes::box(glm::vec3(side));
    const size_t vertices = box.positions.size();
    const std::vector<uint32_t> indices = box.indices;
    for (size_t v = 0; v < vertices; ++v) {
        box.positions.push_back(box.positions[v]);
        box.normals.push_back(-box.normals[v]);
        box.uvs[0].push_back(box.uvs[0][v]);
    }
    for (size_t i = 0; i + 2 < indices.size(); i += 3)
        for (const size_t k : {0U, 2U, 1U})
            box.indices.push_back(indices[i + k] + static_cast<uint32_t>(vertices));
    return box;
}

TEST(Shelter, AnEmptyBoxACaseAndDoubledFacesAreObjects)
{
    for (const float side : {0.3F, 1.0F, 4.0F, 120.0F}) {
        EXPECT_EQ(analyze_view(test::scene_of(hollow_box(glm::vec3(side)))).standpoint, Standpoint::outside);
        EXPECT_FALSE(analyze_view(test::scene_of(hollow_box(glm::vec3(side)))).shelter) << side;
        EXPECT_EQ(analyze_view(test::scene_of(doubled_box(side))).standpoint, Standpoint::outside) << side;
        EXPECT_FALSE(analyze_view(test::scene_of(doubled_box(side))).shelter) << side;
    }
    Scene device = test::scene_of(hollow_box({0.3F, 0.1F, 0.2F}));
    test::add_object(device, shapes::box({0.1F, 0.02F, 0.1F}), glm::vec3(1.0F), {0.0, 0.03, 0.0});
    EXPECT_EQ(analyze_view(device).standpoint, Standpoint::outside) << "nobody could stand in it";
    Scene furnished = test::scene_of(hollow_box({5.0F, 3.0F, 5.0F}));
    test::add_object(furnished, shapes::box({1.0F, 0.8F, 1.0F}), glm::vec3(1.0F), {0.5, 0.2, 0.0});
    EXPECT_EQ(analyze_view(furnished).standpoint, Standpoint::inside);
}

TEST(Shelter, AFigureThatIsTurnedInsideOutIsNoRoom)
{
    Primitive figure = beast();
    for (size_t i = 0; i + 2 < figure.indices.size(); i += 3)
        std::swap(figure.indices[i + 1], figure.indices[i + 2]);
    EXPECT_EQ(analyze_view(test::scene_of(figure)).standpoint, Standpoint::outside);
}

TEST(Shelter, TheLampHangsBelowWhatGlows)
{
    Scene scene = thick_room();
    const Index pane = test::add_object(scene, shapes::plane(0.8F, 0.8F), glm::vec3(1.0F), {-1.8, 2.9, 1.2});
    scene.materials[scene.meshes[scene.nodes[pane].mesh].primitives[0].material].emissive = glm::vec3(5.0F);
    const auto shelter = shelter_around(cloud_of(scene), {0.5, 1.5, 0.0});
    ASSERT_TRUE(shelter);
    EXPECT_NEAR(shelter->lamp.x, -1.8, 0.4);
    EXPECT_NEAR(shelter->lamp.z, 1.2, 0.4);
    EXPECT_LT(shelter->lamp.y, 2.9);
}

} // namespace
} // namespace estampe
