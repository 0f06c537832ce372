// SPDX-License-Identifier: MIT
#include "scene/scene_limits.hpp"

#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include <estampe/error.hpp>

namespace estampe {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

std::string extent_refusal(const Camera& camera)
{
    try {
        check_camera(camera);
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

std::string extent_refusal(const glm::dvec3& min, const glm::dvec3& max)
{
    try {
        check_extent({.min = min, .max = max}, "house");
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

TEST(Extent, OfWhatCanBeDrawn)
{
    EXPECT_NO_THROW(check_extent({}, "nothing"));
    EXPECT_EQ(extent_refusal(glm::dvec3(-1.0), glm::dvec3(1.0)), "");
    EXPECT_EQ(extent_refusal(glm::dvec3(7.0), glm::dvec3(7.0)), "") << "one place";
    EXPECT_EQ(extent_refusal(glm::dvec3(-1e12), glm::dvec3(1e12)), "");
    EXPECT_EQ(extent_refusal(glm::dvec3(0.0), glm::dvec3(1e-8)), "");
    for (const double far : {1e13, 1e20, 1e300, inf, not_a_number}) {
        EXPECT_NE(extent_refusal(glm::dvec3(0.0), glm::dvec3(1.0, far, 1.0)).find("farther from the origin"),
                  std::string::npos)
            << far;
        EXPECT_NE(extent_refusal(glm::dvec3(1.0, -far, 1.0), glm::dvec3(2.0)).find("farther from the origin"),
                  std::string::npos)
            << far;
    }
    EXPECT_EQ(extent_refusal(glm::dvec3(0.0), glm::dvec3(2e-20, 0.0, 0.0)),
              "house: the scene has a radius of 1e-20 m, less than 1e-09 m can be drawn with; scale it up");
}

TEST(Extent, OfPlaces)
{
    Scene scene;
    scene.name = "house";
    scene.nodes.resize(3);
    scene.nodes[1].name = "wall";
    scene.nodes[1].mesh = 0;
    ScenePose pose{.world_from_node = std::vector<glm::dmat4>(3, glm::dmat4(1.0)), .morph_weights = {}};
    EXPECT_NO_THROW(check_places(scene, pose));
    pose.world_from_node[0][0][0] = inf;
    EXPECT_NO_THROW(check_places(scene, pose)) << "nothing is drawn there";
    for (const double spoiled : {not_a_number, inf, -inf, 1e39, -1e300}) {
        ScenePose other = pose;
        other.world_from_node[1][2][1] = spoiled;
        try {
            check_places(scene, other);
            ADD_FAILURE() << spoiled;
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find("house: node 1 \"wall\" has no finite place"),
                      std::string::npos)
                << error.what();
        }
    }
    scene.skins.push_back({.joints = {0}});
    scene.nodes[1].skin = 0;
    EXPECT_THROW(check_places(scene, pose), Error) << "a joint";
}

TEST(Extent, OfCameras)
{
    EXPECT_EQ(extent_refusal(Camera{}), "");
    const std::pair<const char*, std::function<void(Camera&)>> wrong[] = {
        {"its eye is at", [](Camera& camera) { camera.eye.x = not_a_number; }},
        {"its eye is at", [](Camera& camera) { camera.eye.y = 1e30; }},
        {"its target is at", [](Camera& camera) { camera.target.z = -inf; }},
        {"the same point", [](Camera& camera) { camera.target = camera.eye; }},
        {"its up", [](Camera& camera) { camera.up = camera.target - camera.eye; }},
        {"its up", [](Camera& camera) { camera.up = glm::dvec3(0.0); }},
        {"its up", [](Camera& camera) { camera.up.x = not_a_number; }},
        {"angle of view", [](Camera& camera) { camera.vertical_fov_rad = 0.0; }},
        {"angle of view", [](Camera& camera) { camera.vertical_fov_rad = 3.2; }},
        {"angle of view", [](Camera& camera) { camera.vertical_fov_rad = not_a_number; }},
        {"near plane", [](Camera& camera) { camera.near_m = 0.0; }},
        {"near plane", [](Camera& camera) { camera.near_m = 1e38; }},
        {"half of its height", [](Camera& camera) { camera.orthographic_half_height_m = 0.0; }},
        {"half of its height", [](Camera& camera) { camera.orthographic_half_height_m = 1e38; }},
        {"half of its height", [](Camera& camera) { camera.orthographic_half_height_m = not_a_number; }},
    };
    for (const auto& [what, spoil] : wrong) {
        Camera camera;
        spoil(camera);
        EXPECT_NE(extent_refusal(camera).find(what), std::string::npos)
            << what << ": " << extent_refusal(camera);
    }
}

} // namespace
} // namespace estampe
