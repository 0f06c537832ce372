// SPDX-License-Identifier: MIT
#include "scene/importers.hpp"

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include <sys/stat.h>

#include <gtest/gtest.h>

#include <estampe/error.hpp>

#include "support/folder.hpp"
#include "support/imported.hpp"

namespace estampe {
namespace {

using test::all_warnings;
using test::first_primitive;

class ObjImport : public testing::Test {
protected:
    std::filesystem::path write(const std::string& name, const std::string& content) const
    {
        std::filesystem::create_directories((folder_ / name).parent_path());
        std::ofstream(folder_ / name, std::ios::binary) << content;
        return folder_ / name;
    }

    Scene load(const std::string& content) const { return load_obj(write("test.obj", content)); }

    void expect_error(const std::string& content) const
    {
        try {
            const Scene scene = load(content);
            ADD_FAILURE() << content.substr(0, 60) << " was read: " << scene.meshes.size() << " meshes";
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find("test.obj"), std::string::npos) << error.what();
        }
    }

    test::Folder folder_;
};

const std::string cube_corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n";
const std::string cube_faces = "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

size_t triangles_of(const Scene& scene)
{
    size_t count = 0;
    for (const Mesh& mesh : scene.meshes)
        for (const Primitive& primitive : mesh.primitives)
            count += primitive.topology == Topology::triangles ? primitive.indices.size() / 3 : 0;
    return count;
}

Bounds bounds_of(const Scene& scene)
{
    return scene_bounds(scene, pose_scene(scene, 0.0));
}

TEST_F(ObjImport, CubeHasHardEdgesAndTwoSides)
{
    const Scene scene = load(cube_corners + cube_faces);
    ASSERT_EQ(scene.meshes.size(), 1U);
    EXPECT_EQ(first_primitive(scene).indices.size(), 36U);
    EXPECT_EQ(first_primitive(scene).positions.size(), 24U);
    const Material& material = scene.materials.at(first_primitive(scene).material);
    EXPECT_TRUE(material.double_sided);
    EXPECT_EQ(material.metallic, 0.0F);
    EXPECT_EQ(material.base_color, glm::vec4(0.6F, 0.6F, 0.6F, 1.0F));
    EXPECT_EQ(all_warnings(scene), "");
    EXPECT_EQ(bounds_of(scene).max, glm::dvec3(1.0));
}

TEST_F(ObjImport, KeepsNormalsAndTurnsTexturesOver)
{
    const Scene scene = load(triangle + "vt 0 0.25\nvt 1 0.25\nvt 0 1\nvn 0 1 0\nf 1/1/1 2/2/1 3/3/1\n");
    EXPECT_EQ(first_primitive(scene).normals.at(0), glm::vec3(0, 1, 0));
    EXPECT_FLOAT_EQ(first_primitive(scene).uvs[0].at(0).y, 0.75F);
}

TEST_F(ObjImport, IndicesOfAllFormsNameTheSame)
{
    const std::string attributes = "vt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\n";
    for (const char* const face :
         {"f 1/1/1 2/2/1 3/3/1\n", "f -3/-3/-1 -2/-2/-1 -1/-1/-1\n", "f\t1/1/1   2/2/1\t3/3/1  \r\n",
          "f 1/1/1 \\\n 2/2/1 \\\r\n3/3/1\n", "fo 1/1/1 2/2/1 3/3/1 # a face\n"}) {
        const Scene scene = load(triangle + attributes + face);
        ASSERT_EQ(first_primitive(scene).positions.size(), 3U) << face;
        EXPECT_EQ(first_primitive(scene).positions[2], glm::vec3(0, 1, 0)) << face;
        EXPECT_EQ(first_primitive(scene).uvs[0].at(1), glm::vec2(1, 1)) << face;
        EXPECT_EQ(first_primitive(scene).normals.at(0), glm::vec3(0, 0, 1)) << face;
        EXPECT_EQ(all_warnings(scene), "") << face;
    }
    const Scene normals_only = load(triangle + "vn 0 1 0\nf 1//1 2//1 3//1\n");
    EXPECT_EQ(first_primitive(normals_only).normals.at(0), glm::vec3(0, 1, 0));
    EXPECT_TRUE(first_primitive(normals_only).uvs[0].empty());
    const Scene textures_only = load(triangle + "vt 1 1\nf 1/1 2/1 3/1\n");
    EXPECT_EQ(first_primitive(textures_only).uvs[0].at(2), glm::vec2(1, 0));
    const Scene forward = load("f 1 2 3\nf 1 2 3 4\n" + triangle + "v 1 -1 0\n");
    EXPECT_EQ(triangles_of(forward), 3U);
}

TEST_F(ObjImport, AnyLineEndAndAnyEncoding)
{
    const std::string text = "o caf\xC3\xA9\n" + triangle + "f 1 2 3\n";
    std::string old_mac = text;
    std::replace(old_mac.begin(), old_mac.end(), '\n', '\r');
    std::string utf16 = "\xFF\xFE";
    for (const char letter : std::string("o cafe\r\n" + triangle + "f 1 2 3\n")) {
        utf16 += letter;
        utf16 += '\0';
    }
    for (const std::string& file : {text, old_mac, "\xEF\xBB\xBF" + text, utf16, text + "\n\n  \n"}) {
        const Scene scene = load(file);
        EXPECT_EQ(triangles_of(scene), 1U);
        EXPECT_EQ(scene.nodes.at(1).name.substr(0, 3), "caf");
        EXPECT_EQ(all_warnings(scene), "");
    }
}

TEST_F(ObjImport, ConcavePolygonsKeepTheirShape)
{
    const Scene scene = load("v 0 0 0\nv 3 0 0\nv 3 3 0\nv 2 3 0\nv 2 1 0\nv 0 1 0\nf 1 2 3 4 5 6\n");
    double area = 0.0;
    for (size_t i = 0; i + 2 < first_primitive(scene).indices.size(); i += 3) {
        const auto at = [&](size_t k) {
            return glm::dvec3(first_primitive(scene).positions[first_primitive(scene).indices[i + k]]);
        };
        const double one = 0.5 * glm::cross(at(1) - at(0), at(2) - at(0)).z;
        EXPECT_GT(one, 0.0);
        area += one;
    }
    EXPECT_DOUBLE_EQ(area, 5.0);
}

TEST_F(ObjImport, LinesAndPoints)
{
    const Scene scene = load(cube_corners + "vt 0 0\nl 1 2 3/1\np 4 5\n");
    ASSERT_EQ(scene.meshes.at(0).primitives.size(), 2U);
    EXPECT_EQ(scene.meshes[0].primitives[0].topology, Topology::lines);
    EXPECT_EQ(scene.meshes[0].primitives[0].indices.size(), 4U);
    EXPECT_EQ(scene.meshes[0].primitives[1].topology, Topology::points);
    EXPECT_EQ(scene.meshes[0].primitives[1].indices.size(), 2U);
}

TEST_F(ObjImport, VerticesAloneAreACloudOfPoints)
{
    const Scene scene = load(cube_corners);
    EXPECT_EQ(first_primitive(scene).topology, Topology::points);
    EXPECT_EQ(first_primitive(scene).indices.size(), 8U);
    EXPECT_NE(all_warnings(scene).find("8 vertices are drawn as dots"), std::string::npos);
}

TEST_F(ObjImport, ColorsOfVerticesAreSrgb)
{
    for (const char* const values : {"1 0.5 0", "255 127.5 0"}) {
        const Scene scene = load("v 0 0 0 " + std::string(values) + "\nv 1 0 0 " + values + "\nv 0 1 0 " +
                                 values + "\nf 1 2 3\n");
        ASSERT_EQ(first_primitive(scene).colors.size(), 3U);
        EXPECT_NEAR(first_primitive(scene).colors[0].x, 1.0F, 1e-6F);
        EXPECT_NEAR(first_primitive(scene).colors[0].y, 0.2140F, 1e-3F);
        EXPECT_EQ(scene.materials.at(0).base_color, glm::vec4(1.0F)) << "the vertices say it all";
    }
    const Scene weighted = load("v 2 0 0 0.5\nv 1 0 0 1\nv 0 1 0 1.0\nf 1 2 3\n");
    EXPECT_TRUE(first_primitive(weighted).colors.empty());
    EXPECT_EQ(bounds_of(weighted).max.x, 2.0) << "a weight of curves does not scale";
}

TEST_F(ObjImport, ObjectsAndGroupsAreNodes)
{
    const Scene scene =
        load(cube_corners + "o Red Lamp\nf 1 2 3\ng shade\nf 1 2 4\ng stand\nf 2 3 4\ng shade\n"
                            "f 5 6 7\no table\ng shade\nf 6 7 8\n");
    std::vector<std::string> names;
    for (const Node& node : scene.nodes)
        names.push_back(node.name);
    EXPECT_EQ(names, (std::vector<std::string>{"test.obj", "Red Lamp", "shade", "stand", "table", "shade"}));
    EXPECT_EQ(scene.nodes[2].parent, 1U);
    EXPECT_EQ(scene.nodes[5].parent, 4U);
    EXPECT_EQ(scene.meshes.at(scene.nodes[2].mesh).primitives.at(0).indices.size(), 6U)
        << "a group goes on where its name comes again";
    EXPECT_EQ(scene.nodes[4].mesh, no_index);
}

TEST_F(ObjImport, OneMaterialOfAnObjectIsOnePrimitive)
{
    write("m.mtl", "newmtl red\nKd 1 0 0\nnewmtl green\nKd 0 1 0\n");
    const Scene scene =
        load("mtllib m.mtl\n" + cube_corners +
             "usemtl red\nf 1 2 3\nusemtl green\nf 2 3 4\nusemtl red\nf 5 6 7\nusemtl green\nf 6 7 8\n");
    ASSERT_EQ(scene.meshes.at(0).primitives.size(), 2U);
    EXPECT_EQ(first_primitive(scene).indices.size(), 6U);
    EXPECT_EQ(scene.materials.at(first_primitive(scene).material).name, "red");
}

TEST_F(ObjImport, SmoothingGroupsRuleWhereThereAreNoNormals)
{
    const auto vertices = [this](const std::string& before) {
        return first_primitive(load(cube_corners + before + cube_faces)).positions.size();
    };
    EXPECT_EQ(vertices("s 1\n"), 8U);
    EXPECT_EQ(vertices("s off\n"), 24U);
    EXPECT_EQ(vertices("s 0\n"), 24U);
    EXPECT_EQ(vertices(""), 24U);
    // A bent strip whose fold is below the crease angle, so that it would be smooth without groups.
    const std::string strip = "v 0 0 0\nv 0 1 0\nv 1 0 0\nv 1 1 0\nv 2 0 0.2\nv 2 1 0.2\n";
    EXPECT_EQ(first_primitive(load(strip + "f 1 3 4 2\nf 3 5 6 4\n")).positions.size(), 6U);
    EXPECT_EQ(first_primitive(load(strip + "s off\nf 1 3 4 2\nf 3 5 6 4\n")).positions.size(), 8U);
    EXPECT_EQ(first_primitive(load(strip + "s 1\nf 1 3 4 2\ns 2\nf 3 5 6 4\n")).positions.size(), 8U);
    EXPECT_EQ(first_primitive(load(strip + "s 7\nf 1 3 4 2\nf 3 5 6 4\n")).positions.size(), 6U);
    const Scene given = load(triangle + "vn 0 1 0\ns off\nf 1//1 2//1 3//1\n");
    EXPECT_EQ(first_primitive(given).normals.at(0), glm::vec3(0, 1, 0)) << "normals of the file go first";
}

TEST_F(ObjImport, FarOffCoordinatesAreAsExactAsNearOnes)
{
    const std::string near_file = "v 0.125 0 0\nv 1.375 0 0.25\nv 0 1.0625 0\nf 1 2 3\n";
    const std::string far_file =
        "v 12958094.125 4865499 35\nv 12958095.375 4865499 35.25\nv 12958094 4865500.0625 35\nf 1 2 3\n";
    const Scene near_scene = load(near_file);
    const Scene far_scene = load(far_file);
    const glm::vec3 side =
        first_primitive(near_scene).positions.at(1) - first_primitive(near_scene).positions.at(0);
    EXPECT_EQ(first_primitive(far_scene).positions.at(1) - first_primitive(far_scene).positions.at(0), side);
    const Bounds bounds = bounds_of(far_scene);
    EXPECT_EQ(bounds.min, glm::dvec3(12958094.0, 4865499.0, 35.0));
    EXPECT_EQ(bounds.max, glm::dvec3(12958095.375, 4865500.0625, 35.25));
    for (const glm::vec3& position : first_primitive(far_scene).positions)
        EXPECT_LT(glm::length(position), 4.0F);
}

TEST_F(ObjImport, AnObjectFarFromAMarkerAtZeroIsExact)
{
    const Scene scene = load("o marker\n" + triangle +
                             "f 1 2 3\no house\nv 500000.125 5000000.5 0\n"
                             "v 500001.25 5000000.5 0\nv 500000.125 5000001.625 0\nf 4 5 6\n");
    const Primitive& house = scene.meshes.at(1).primitives.at(0);
    EXPECT_EQ(house.positions.at(1).x - house.positions.at(0).x, 1.125F);
    EXPECT_EQ(bounds_of(scene).max.x, 500001.25);
}

TEST_F(ObjImport, WhatCannotBeReadIsCounted)
{
    const Scene scene = load(cube_corners + "v nan 0 0\nv 1e39 0 0\n" + cube_faces +
                             "f 1 2 9\nf 1 2 10\nf 1 2 99\nf 0 1 2\nf -1 -2 -99\nf 1 2\nf 1 x 3\n"
                             "this is no OBJ\ncurv 0 1 2 3\n");
    EXPECT_EQ(first_primitive(scene).indices.size(), 36U);
    const std::string warnings = all_warnings(scene);
    EXPECT_NE(warnings.find("4 faces left out: they name vertices that are not there"), std::string::npos)
        << warnings;
    EXPECT_NE(warnings.find("1 faces left out: they have too few corners"), std::string::npos) << warnings;
    EXPECT_NE(warnings.find("2 faces left out, as their vertices are missing or not finite"),
              std::string::npos)
        << warnings;
    EXPECT_NE(warnings.find("1 lines are not OBJ, the first of them line 24"), std::string::npos) << warnings;
    EXPECT_NE(warnings.find("1 curved surfaces"), std::string::npos) << warnings;
}

TEST_F(ObjImport, MissingAttributesOfCornersAreCounted)
{
    const Scene scene = load(triangle + "vt 0 0\nvn 0 0 1\nf 1/1/1 2/7/1 3/1/9\n");
    EXPECT_EQ(triangles_of(scene), 1U);
    EXPECT_NE(all_warnings(scene).find("2 corners name texture coordinates or normals"), std::string::npos);
    EXPECT_EQ(first_primitive(scene).normals.at(2), glm::vec3(0, 0, 1));
}

TEST_F(ObjImport, AFileThatEndsInALineSaysSo)
{
    const std::string whole = cube_corners + cube_faces;
    EXPECT_NE(all_warnings(load(whole.substr(0, whole.size() - 6))).find("seems to be cut off"),
              std::string::npos);
    EXPECT_EQ(all_warnings(load(whole.substr(0, whole.size() - 1))), "");
}

TEST_F(ObjImport, VerticesWithoutFacesTellOfACut)
{
    const std::string cut = cube_corners + "f 1 2 3\nf 3 4 1\n";
    EXPECT_NE(all_warnings(load(cut)).find("4 of 8 vertices belong to no face"), std::string::npos);
    EXPECT_EQ(all_warnings(load(cut)).find("may be cut off"), std::string::npos);
    const std::string in_last_number = cut.substr(0, cut.size() - 1);
    EXPECT_NE(all_warnings(load(in_last_number)).find("may be cut off"), std::string::npos);
    EXPECT_EQ(all_warnings(load(cube_corners + cube_faces)), "");
    EXPECT_NE(all_warnings(load("v 0 0 0\nv 1 0 0\nv 0 1")).find("cut off"), std::string::npos);
    EXPECT_NE(all_warnings(load("v 0 0 0\nv 1 0 0\nv 0 1 0")).find("may be cut off"), std::string::npos);
}

TEST_F(ObjImport, DoubledTextureCoordinatesAreWarnedAbout)
{
    const std::string positions = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    const std::string uvs = "vt 0 0\nvt 1 0\nvt 0 1\n";
    const std::string face = "f 1/1 2/2 3/3\n";
    EXPECT_EQ(all_warnings(load(positions + uvs + face)), "");
    EXPECT_NE(
        all_warnings(load(positions + "vt 0 0\n" + uvs + face)).find("1 texture coordinates and 0 normals"),
        std::string::npos);
}

TEST_F(ObjImport, ACommentThatCountsTellsOfACut)
{
    const std::string counts = "# OBJ File\n#\n# Vertices: 8\n# Faces: 6\n#\n";
    EXPECT_EQ(all_warnings(load(counts + cube_corners + cube_faces)), "");
    const std::string cut = counts + cube_corners + cube_faces.substr(0, 20);
    EXPECT_NE(all_warnings(load(cut)).find("is cut off: says 6 faces, has 2"), std::string::npos);
    expect_error(counts + cube_corners);
}

TEST_F(ObjImport, NothingToDrawIsAnError)
{
    expect_error("");
    expect_error("\n\n");
    expect_error("v nan nan nan\nv nan 0 0\nv 0 nan 0\nf 1 2 3\n");
    expect_error("v 0 0 0\nv 1 0 0\nf 1 2 99\n");
    expect_error("v 0 0 0\nf 99999999999999999999 1 1\n");
    expect_error("v one two three\nf a b c\n");
    expect_error(cube_corners + "f 1 2\n");
    expect_error("f 1 2 3 4 5\nf 1 2 3\n");
    std::string noise(5000, '\0');
    for (size_t i = 0; i < noise.size(); ++i)
        noise[i] = static_cast<char>((i * 2654435761U) >> 13);
    expect_error(noise);
    EXPECT_THROW((void)load_obj(folder_ / "absent.obj"), Error);
    EXPECT_THROW((void)load_obj(folder_.path()), Error);
}

TEST_F(ObjImport, ManyTextureCoordinatesAtOnePositionCostNoMore)
{
    std::string text = triangle;
    for (int i = 0; i < 60000; ++i)
        text += "vt " + std::to_string(i) + " 0\n";
    for (int i = 0; i < 60000; ++i)
        text += "f 1/" + std::to_string(i + 1) + " 2/1 3/1\n";
    const auto begun = std::chrono::steady_clock::now();
    const Scene scene = load(text);
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begun;
    EXPECT_LT(passed.count(), 15.0);
    EXPECT_EQ(first_primitive(scene).positions.size(), 60002U);
}

} // namespace
} // namespace estampe
