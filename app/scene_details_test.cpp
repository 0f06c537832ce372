// SPDX-License-Identifier: MIT
#include <numbers>

#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "scene_details.hpp"

namespace estampe::app {
namespace {

std::string row(const SceneDetails& details, const std::string& label)
{
    std::string text;
    for (const auto& [name, words] : details.rows) {
        text += name == label ? words + "\n" : "";
    }
    return text;
}

Scene cone(bool is_z_up)
{
    Scene scene;
    scene.materials.emplace_back();
    scene.meshes.emplace_back().primitives.push_back(shapes::cone(1.0F, 2.0F));
    scene.nodes.push_back({.mesh = 0});
    if (is_z_up) {
        scene.nodes[0].transform.rotation = glm::angleAxis(0.5 * std::numbers::pi, glm::dvec3(1.0, 0.0, 0.0));
    }
    scene.roots = {0};
    return scene;
}

TEST(SceneDetails, SaysWhichAxisLooksUpWhereTheFormatDoesNot)
{
    const Scene lying = cone(true);
    const Scene standing = cone(false);
    EXPECT_NE(row(scene_details(lying, "a.stl"), "up axis").find("--up z"), std::string::npos);
    EXPECT_EQ(scene_details(lying, "A.STL").json["up_axis_guess"], "z");
    EXPECT_EQ(scene_details(standing, "a.obj").json["up_axis_guess"], "y");
    EXPECT_TRUE(scene_details(lying, "a.glb").json["up_axis_guess"].is_null());
    EXPECT_EQ(row(scene_details(lying, "a.glb"), "up axis"), "");
    const std::vector<std::string> notes = up_axis_notes(lying, "a.ply");
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_NE(notes[0].find("a.ply: its box looks z-up"), std::string::npos);
    EXPECT_TRUE(up_axis_notes(standing, "a.ply").empty());
    EXPECT_TRUE(up_axis_notes(lying, "a.glb").empty());
    EXPECT_TRUE(up_axis_notes(lying, "world").empty());
}

TEST(SceneDetails, ListsWhatTheSceneHolds)
{
    Scene scene = cone(false);
    scene.variants = {"night", "storm"};
    scene.missing_files = {"oak.png"};
    scene.file_unit_m = 0.01;
    scene.cameras = {{.name = "", .vertical_fov_rad = glm::radians(30.0), .near_m = 0.5},
                     {.name = "plan", .orthographic = true, .half_height_m = 4.0}};
    scene.lights = {{.name = "Sun", .type = LightType::directional, .intensity = 3.0F}};
    scene.nodes.push_back({.name = "Door", .camera = 0, .light = 0});
    scene.nodes.push_back({.name = "Spare", .visible = false, .light = 0});
    scene.roots = {0, 1, 2};
    const SceneDetails details = scene_details(scene, "a.fbx");
    EXPECT_EQ(row(details, "variants"), "night, storm\n");
    EXPECT_EQ(row(details, "missing files"), "oak.png\n");
    EXPECT_EQ(row(details, "unit"), "0.01 m\n");
    EXPECT_EQ(row(details, "camera"), "\"Door\", fov 30 degrees, near 0.5 m\n"
                                      "\"plan\", half height 4 m, near 0.01 m\n");
    EXPECT_EQ(row(details, "scene light"), "\"Sun\", directional, 3 lux\n")
        << "the hidden one does not shine";
    EXPECT_EQ(row(details, "hidden nodes"), "1\n");
    EXPECT_EQ(details.json["variants"].size(), 2U);
    EXPECT_EQ(details.json["missing_files"][0], "oak.png");
    EXPECT_EQ(details.json["unit_m"], 0.01);
    EXPECT_EQ(details.json["camera_details"][0]["name"], "Door");
    EXPECT_NEAR(details.json["camera_details"][0]["vertical_fov_deg"].get<double>(), 30.0, 1e-9);
    EXPECT_EQ(details.json["camera_details"][1]["half_height_m"], 4.0);
    EXPECT_EQ(details.json["light_list"].size(), 1U);
    EXPECT_EQ(details.json["hidden_nodes"], 1);
    EXPECT_EQ(row(scene_details(scene, "a.obj"), "unit"), "0.01 m\n");
    scene.file_unit_m.reset();
    EXPECT_EQ(row(scene_details(scene, "a.obj"), "unit"), "not in the file; read as metres\n");
}

TEST(SceneDetails, TheRateOfKeysIsFoundWhereAllLieOnIt)
{
    const auto animation = [](std::vector<float> times_s) {
        return Animation{.name = "", .channels = {{.node = 0, .times_s = std::move(times_s)}}};
    };
    EXPECT_EQ(key_rate(animation({0.0F, 1.0F / 24.0F, 5.0F / 24.0F, 100.0F / 24.0F})), 24.0);
    EXPECT_EQ(key_rate(animation({0.0F, 1.0F / 30.0F, 2.0F / 30.0F})), 30.0);
    EXPECT_EQ(key_rate(animation({0.0F, 1.0F / 60.0F, 2.0F / 60.0F})), 60.0);
    EXPECT_EQ(key_rate(animation({0.0F, 0.0123F, 0.7F})), 0.0);
    EXPECT_EQ(key_rate(animation({0.0F, 1.0F})), 0.0) << "two keys tell nothing";
    EXPECT_EQ(key_rate({}), 0.0);
}

} // namespace
} // namespace estampe::app
