// SPDX-License-Identifier: MIT
// Whole COLLADA files: axes, units, cameras, sloppy syntax, and positions far from the origin.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <estampe/error.hpp>

#include "scene/importers.hpp"
#include "support/folder.hpp"

namespace estampe {
namespace {

/// The parts of a file with one tetrahedron of size 1, 2 and 3 along x, y and z.
struct DaeFile {
    std::string asset = "<unit name=\"meter\" meter=\"1\"/><up_axis>Y_UP</up_axis>";
    std::string places = "0 0 0 1 0 0 0 2 0 0 0 3";
    std::string indices = "0 2 1 0 1 3 0 3 2 1 2 3";
    std::string optics;
    std::string nodes = R"(<node id="body" name="body"><instance_geometry url="#g"/></node>)";
    std::string extra;

    [[nodiscard]] std::string text() const
    {
        return fmt::format(
            R"(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset>{}</asset>
<library_cameras><camera id="cam" name="lens"><optics><technique_common>{}</technique_common></optics></camera>
</library_cameras>
<library_lights><light id="sun"><technique_common><directional><color>1 1 1</color></directional></technique_common>
</light></library_lights>
<library_geometries><geometry id="g" name="g"><mesh><source id="p"><float_array id="pa" count="12">{}</float_array>
<technique_common><accessor source="#pa" count="4" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices><triangles count="4">
<input semantic="VERTEX" source="#v" offset="0"/><p>{}</p></triangles></mesh></geometry></library_geometries>{}
<library_visual_scenes><visual_scene id="vs">{}</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#vs"/></scene></COLLADA>
)",
            asset, optics, places, indices, extra, nodes);
    }
};

class DaeScene : public testing::Test {
protected:
    Scene load(const std::string& text)
    {
        std::ofstream(folder_ / "test.dae", std::ios::binary) << text;
        return load_with_assimp(folder_ / "test.dae");
    }

    Scene load(const DaeFile& file) { return load(file.text()); }

    Camera camera(const std::string& optics, const std::string& asset = DaeFile().asset)
    {
        DaeFile file;
        file.asset = asset;
        file.optics = optics;
        file.nodes += R"(<node id="eye"><translate>0 0 9</translate><instance_camera url="#cam"/></node>)";
        const Scene scene = load(file);
        return scene_camera(scene, pose_scene(scene, 0.0), "lens");
    }

    test::Folder folder_;
};

void expect_dae_bounds(const Scene& scene, const glm::dvec3& min, const glm::dvec3& max,
                       double tolerance = 1e-5)
{
    const Bounds bounds = scene_bounds(scene, pose_scene(scene, 0.0));
    EXPECT_NEAR(glm::distance(bounds.min, min), 0.0, tolerance)
        << bounds.min.x << ", " << bounds.min.y << ", " << bounds.min.z;
    EXPECT_NEAR(glm::distance(bounds.max, max), 0.0, tolerance)
        << bounds.max.x << ", " << bounds.max.y << ", " << bounds.max.z;
}

TEST_F(DaeScene, AxesAndUnit)
{
    DaeFile file;
    expect_dae_bounds(load(file), {0, 0, 0}, {1, 2, 3});
    file.asset = "<unit meter=\"0.0254\"/><up_axis>Z_UP</up_axis>";
    expect_dae_bounds(load(file), {0, 0, -0.0508}, {0.0254, 0.0762, 0});
    file.asset = "<unit meter=\"10\"/><up_axis>X_UP</up_axis>";
    expect_dae_bounds(load(file), {-20, 0, 0}, {0, 10, 30});
    file.asset = "";
    expect_dae_bounds(load(file), {0, 0, 0}, {1, 2, 3});
}

TEST_F(DaeScene, CamerasLightsAndKeysTurnWithTheScene)
{
    DaeFile file;
    file.asset = "<unit meter=\"0.01\"/><up_axis>Z_UP</up_axis>";
    file.optics = "<perspective><yfov>40</yfov><znear>10</znear></perspective>";
    file.nodes = R"(<node id="body"><translate sid="t">0 0 0</translate><instance_geometry url="#g"/></node>
<node id="eye"><lookat>0 -500 100 0 0 100 0 0 1</lookat><instance_camera url="#cam"/></node>
<node id="lamp"><instance_light url="#sun"/></node>)";
    file.extra =
        R"(<library_animations><animation id="a"><source id="i"><float_array id="ia" count="2">0 2</float_array>
<technique_common><accessor source="#ia" count="2" stride="1"><param name="TIME" type="float"/></accessor>
</technique_common></source><source id="o"><float_array id="oa" count="6">0 0 0 0 0 800</float_array><technique_common>
<accessor source="#oa" count="2" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source><sampler id="s">
<input semantic="INPUT" source="#i"/><input semantic="OUTPUT" source="#o"/></sampler>
<channel source="#s" target="body/t"/></animation></library_animations>)";
    const Scene scene = load(file);
    const Camera eye = scene_camera(scene, pose_scene(scene, 0.0), "0");
    EXPECT_NEAR(glm::distance(eye.eye, {0, 1, 5}), 0.0, 1e-5);
    EXPECT_NEAR(glm::distance(eye.target - eye.eye, {0, 0, -1}), 0.0, 1e-5);
    EXPECT_NEAR(eye.near_m, 0.1, 1e-9);
    EXPECT_NEAR(eye.vertical_fov_rad, glm::radians(40.0), 1e-9);
    const ScenePose half = pose_scene(scene, 1.0);
    EXPECT_NEAR(scene_bounds(scene, half).min.y, 4.0, 0.05) << "upward";
    for (Index index = 0; index < scene.nodes.size(); ++index) {
        if (scene.nodes[index].light != no_index) {
            EXPECT_NEAR(glm::normalize(glm::dvec3(half.world_from_node[index][2])).y, 1.0, 1e-5)
                << "shines down";
        }
    }
}

TEST_F(DaeScene, FieldsOfViewInAllCombinations)
{
    const double xfov_tangent = std::tan(glm::radians(30.0));
    const auto tangent = [this](const std::string& optics) {
        return std::tan(0.5 * camera("<perspective>" + optics + "</perspective>").vertical_fov_rad);
    };
    EXPECT_NEAR(tangent("<yfov>60</yfov>"), xfov_tangent, 1e-9);
    EXPECT_NEAR(tangent("<yfov sid=\"YFOV\"> 60 </yfov><aspect_ratio>2</aspect_ratio>"), xfov_tangent, 1e-9);
    EXPECT_NEAR(tangent("<xfov>60</xfov><aspect_ratio>2</aspect_ratio>"), xfov_tangent / 2.0, 1e-9);
    EXPECT_NEAR(tangent("<xfov>60</xfov><yfov>40</yfov>"), std::tan(glm::radians(20.0)), 1e-9);
    EXPECT_NEAR(tangent("<xfov>60</xfov>"), xfov_tangent * 9.0 / 16.0, 1e-9);
    EXPECT_NEAR(camera("<perspective><yfov>nonsense</yfov></perspective>").vertical_fov_rad,
                SceneCamera{}.vertical_fov_rad, 1e-9);
}

TEST_F(DaeScene, ParallelProjectionsAndNearPlanesAreInMetres)
{
    const std::string inches = "<unit meter=\"0.0254\"/><up_axis>Y_UP</up_axis>";
    const auto half_height = [&](const std::string& optics) {
        return camera("<orthographic>" + optics + "<znear>100</znear></orthographic>", inches)
            .orthographic_half_height_m.value_or(-1.0);
    };
    EXPECT_NEAR(half_height("<ymag>10</ymag>"), 0.254, 1e-9);
    EXPECT_NEAR(half_height("<xmag>10</xmag><aspect_ratio>2</aspect_ratio>"), 0.127, 1e-9);
    EXPECT_NEAR(half_height("<xmag>10</xmag><ymag>4</ymag>"), 0.1016, 1e-9);
    EXPECT_NEAR(camera("<perspective><yfov>40</yfov><znear>10</znear></perspective>", inches).near_m, 0.254,
                1e-9);
}

TEST_F(DaeScene, SlackWritingIsRead)
{
    const DaeFile plain;
    const auto same = [this](const std::string& text, const char* what) {
        SCOPED_TRACE(what);
        expect_dae_bounds(load(text), {0, 0, 0}, {1, 2, 3});
    };
    DaeFile blanks = plain;
    blanks.places = "\n\t 0 0  0\r\n 1 0 0\t0 2 0 0 0 3 \n ";
    blanks.indices = "  0 2 1\n 0 1 3 0 3 2 1 2 3 \n";
    same(blanks.text(), "blanks");
    same("\xEF\xBB\xBF" + plain.text(), "a byte order mark");
    same("\n\n  " + plain.text(), "blanks before the declaration");
    std::string declared = plain.text();
    declared.replace(declared.find("utf-8"), 5, "utf-16");
    std::u16string wide = u"\xFEFF";
    for (const char letter : declared)
        wide += static_cast<char16_t>(letter);
    const std::string utf_16(reinterpret_cast<const char*>(wide.data()), 2 * wide.size());
    same(utf_16, "UTF-16");
    DaeFile empty = plain;
    empty.extra =
        R"(<library_geometries><geometry id="n"><mesh><source id="np"><float_array id="npa" count="0"> </float_array>
<technique_common><accessor source="#npa" count="0" stride="3"><param name="X" type="float"/></accessor>
</technique_common></source><vertices id="nv"><input semantic="POSITION" source="#np"/></vertices></mesh></geometry>
</library_geometries>)";
    same(empty.text(), "an empty array");
    DaeFile nan = plain;
    nan.places = "0 -1.#IND00 0 1 0 0 0 2 0 0 0 3";
    same(nan.text(), "not a number as Windows writes it");
}

TEST_F(DaeScene, WhatIsNoColladaIsSaid)
{
    const auto refusal = [this](const std::string& text) -> std::string {
        try {
            (void)load(text);
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_NE(refusal("<COLLADA><asset></COLLADA>").find("XML at byte"), std::string::npos);
    EXPECT_NE(refusal("<html></html>").find("not COLLADA"), std::string::npos);
}

TEST_F(DaeScene, FarVerticesKeepAllTheirDigits)
{
    DaeFile file;
    file.places = "6378137.125 4.25 0 6378137.25 4.25 0 6378137.125 4.375 0 6378137.125 4.25 0.0625";
    file.nodes = R"(<node id="body" name="body"><rotate>0 1 0 180</rotate><instance_geometry url="#g"/>
<node id="child"><translate>1 0 0</translate></node></node>)";
    const Scene scene = load(file);
    EXPECT_TRUE(scene.warnings.empty());
    const Bounds bounds = scene_bounds(scene, pose_scene(scene, 0.0));
    EXPECT_NEAR(bounds.max.x - bounds.min.x, 0.125, 1e-6);
    EXPECT_NEAR(bounds.max.y - bounds.min.y, 0.125, 1e-6);
    EXPECT_NEAR(bounds.max.y, 4.375, 1e-6);
    EXPECT_NEAR(bounds.min.x, -6378137.25, 0.01) << "turned with its node";
    const auto child = std::find_if(scene.nodes.begin(), scene.nodes.end(),
                                    [](const Node& node) { return node.name == "child"; });
    ASSERT_NE(child, scene.nodes.end());
    const auto index = static_cast<size_t>(child - scene.nodes.begin());
    EXPECT_NEAR(pose_scene(scene, 0.0).world_from_node[index][3].x, -1.0, 1e-5);
}

TEST_F(DaeScene, NodesFarFromTheOriginAreWarnedOf)
{
    const auto two_at = [](const std::string& place) {
        DaeFile file;
        file.nodes =
            fmt::format(R"(<node id="a"><translate>{0}</translate><instance_geometry url="#g"/></node>
<node id="b"><translate>{0}</translate><instance_geometry url="#g"/></node>)",
                        place);
        return file;
    };
    EXPECT_TRUE(load(two_at("100 0 0")).warnings.empty());
    const Scene far = load(two_at("6378137 0 0"));
    ASSERT_EQ(far.warnings.size(), 1U);
    EXPECT_NE(far.warnings[0].find("origin"), std::string::npos) << far.warnings[0];
}

TEST_F(DaeScene, ACameraWithoutANameHasItsId)
{
    DaeFile file;
    file.optics = "<perspective><yfov>40</yfov></perspective>";
    file.nodes += R"(<node id="eye"><translate>0 0 9</translate><instance_camera url="#cam"/></node>)";
    for (const char* const attribute : {"", R"( name="")"}) {
        std::string text = file.text();
        const std::string name = R"( name="lens")";
        text.replace(text.find(name), name.size(), attribute);
        const Scene scene = load(text);
        ASSERT_EQ(scene.cameras.size(), 1U);
        EXPECT_EQ(scene.cameras[0].name, "cam");
        const Camera camera = scene_camera(scene, pose_scene(scene, 0.0), "cam");
        EXPECT_NEAR(camera.vertical_fov_rad, 40.0 * std::acos(-1.0) / 180.0, 1e-6);
    }
}

} // namespace
} // namespace estampe
