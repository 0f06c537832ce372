// SPDX-License-Identifier: MIT
#include "scene/importers.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include <estampe/error.hpp>

#include "support/folder.hpp"
#include "support/imported.hpp"

namespace estampe {
namespace {

using test::all_warnings;
using test::first_primitive;

Scene read_ply(const std::string& content)
{
    return load_ply_bytes(std::as_bytes(std::span(content)), "test.ply");
}

std::string ply_error_of(const std::string& content)
{
    try {
        const Scene scene = read_ply(content);
        return "was read";
    } catch (const Error& error) {
        EXPECT_EQ(error.where().find("test.ply"), 0U) << error.what();
        return error.what();
    }
}

std::string head(const std::string& format, int vertices, const std::string& more = "")
{
    return "ply\nformat " + format + " 1.0\ncomment made by hand\nelement vertex " +
           std::to_string(vertices) + "\nproperty float x\nproperty float y\nproperty float z\n" + more;
}

const std::string list = "property list uchar int vertex_indices\n";
const std::string end = "end_header\n";
const std::string three_points = "0 0 0\n1 0 0\n0 1 0\n";

std::string faces(int count)
{
    return "element face " + std::to_string(count) + '\n' + list;
}

template <typename Value>
void put_ordered(std::string& bytes, Value value, bool is_big_endian)
{
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    if (is_big_endian)
        std::reverse(raw, raw + sizeof value);
    bytes.append(raw, sizeof value);
}

TEST(PlyImport, TextWithFaces)
{
    const Scene scene =
        read_ply(head("ascii", 5, faces(2)) + end + three_points + "1 1 0\n2 0 0\n3 1 4 3\n4 0 1 3 2\n");
    EXPECT_EQ(first_primitive(scene).indices.size(), 9U);
    EXPECT_EQ(first_primitive(scene).normals.at(0), glm::vec3(0, 0, 1));
    EXPECT_TRUE(scene.materials.at(0).double_sided);
    EXPECT_EQ(all_warnings(scene), "");
    EXPECT_EQ(scene.nodes.at(0).name, "test");
}

TEST(PlyImport, BinaryOfBothOrdersAndAllTypes)
{
    for (const bool is_big : {false, true}) {
        std::string file =
            std::string("ply\nformat binary_") + (is_big ? "big" : "little") +
            "_endian 1.0\nelement vertex 3\nproperty uint16 flags\nproperty double x\n"
            "property list int8 ushort neighbours\nproperty short y\nproperty uint z\n"
            "element patch 2\nproperty list ushort float64 weights\nproperty char kind\n"
            "element face 1\nproperty uchar flags\nproperty list uint32 int16 vertex_index\nend_header\n";
        for (int i = 0; i < 3; ++i) {
            put_ordered<uint16_t>(file, 7, is_big);
            put_ordered<double>(file, i == 1 ? 1.5 : 0.0, is_big);
            put_ordered<int8_t>(file, 2, is_big);
            put_ordered<uint16_t>(file, 1, is_big);
            put_ordered<uint16_t>(file, 2, is_big);
            put_ordered<int16_t>(file, static_cast<int16_t>(i == 2 ? -2 : 0), is_big);
            put_ordered<uint32_t>(file, 3000000000U, is_big);
        }
        for (uint16_t i = 0; i < 2; ++i) {
            put_ordered<uint16_t>(file, i, is_big);
            for (uint16_t k = 0; k < i; ++k)
                put_ordered<double>(file, 1.0, is_big);
            put_ordered<int8_t>(file, -1, is_big);
        }
        put_ordered<uint8_t>(file, 1, is_big);
        put_ordered<uint32_t>(file, 3, is_big);
        for (const int16_t index : {int16_t{0}, int16_t{1}, int16_t{2}})
            put_ordered<int16_t>(file, index, is_big);
        const Scene scene = read_ply(file);
        EXPECT_EQ(all_warnings(scene), "");
        EXPECT_EQ(first_primitive(scene).indices.size(), 3U);
        const Bounds bounds = scene_bounds(scene, pose_scene(scene, 0.0));
        EXPECT_EQ(bounds.min, glm::dvec3(0.0, -2.0, 3e9));
        EXPECT_EQ(bounds.max, glm::dvec3(1.5, 0.0, 3e9));
    }
}

TEST(PlyImport, DataThatBeginsWithALineEnd)
{
    for (const std::string line_end : {"\n", "\r\n", "\r"}) {
        std::string file = head("binary_little_endian", 3, faces(1)) + end;
        std::string header;
        for (const char letter : file)
            header += letter == '\n' ? line_end : std::string(1, letter);
        file = header;
        const float odd = std::bit_cast<float>(0x40BEF60AU); // its first byte is a line end
        for (const float value : {odd, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 0.0F})
            put_ordered(file, value, false);
        put_ordered<uint8_t>(file, 3, false);
        for (const int32_t index : {0, 1, 2})
            put_ordered(file, index, false);
        const Scene scene = read_ply(file);
        EXPECT_EQ(scene_bounds(scene, pose_scene(scene, 0.0)).max.x, static_cast<double>(odd));
    }
    EXPECT_EQ(first_primitive(read_ply("\n" + head("ascii", 3, faces(1)) + end + three_points + "3 0 1 2\n"))
                  .indices.size(),
              3U);
}

TEST(PlyImport, ACloudOfPointsKeepsItsNormalsAndColors)
{
    const std::string properties =
        "property float nx\nproperty float ny\nproperty float nz\nproperty uchar red\n"
        "property uchar green\nproperty uchar blue\n";
    for (const std::string& none : {std::string(), faces(0)}) {
        const Scene scene = read_ply(head("ascii", 2, properties + none) + end +
                                     "0 0 0 0 1 0 255 0 0\n1 0 0 1 0 0 0 128 255");
        EXPECT_EQ(first_primitive(scene).topology, Topology::points);
        EXPECT_EQ(first_primitive(scene).indices.size(), 2U);
        EXPECT_EQ(first_primitive(scene).normals.at(1), glm::vec3(1, 0, 0));
        EXPECT_EQ(first_primitive(scene).colors.at(0), glm::vec4(1, 0, 0, 1));
        EXPECT_NEAR(first_primitive(scene).colors.at(1).y, 0.2159F, 1e-3F) << "128 is sRGB";
        EXPECT_EQ(all_warnings(scene), "");
    }
}

TEST(PlyImport, ColorsOfAllTypes)
{
    const auto color_of = [](const std::string& type, const std::string& names, const std::string& values) {
        std::string properties;
        for (const std::string name : {"red", "green", "blue"})
            properties += "property " + type + ' ' + names + name + '\n';
        properties += "property " + type + " alpha\n";
        return first_primitive(read_ply(head("ascii", 1, properties) + end + "0 0 0 " + values + "\n"))
            .colors.at(0);
    };
    for (const glm::vec4& color :
         {color_of("uchar", "", "255 0 255 51"), color_of("ushort", "diffuse_", "65535 0 65535 13107"),
          color_of("float", "", "1 0 1 0.2"), color_of("double", "diffuse_", "255 0 255 51"),
          color_of("int", "", "255 0 255 51")}) {
        EXPECT_NEAR(color.x, 1.0F, 1e-5F);
        EXPECT_NEAR(color.y, 0.0F, 1e-5F);
        EXPECT_NEAR(color.w, 0.2F, 1e-5F);
    }
}

TEST(PlyImport, TextureCoordinatesOfVerticesAndOfCorners)
{
    for (const std::string names : {"s t", "u v", "texture_u texture_v"}) {
        const std::string u = names.substr(0, names.find(' '));
        const std::string v = names.substr(names.find(' ') + 1);
        const Scene scene =
            read_ply(head("ascii", 3, "property float " + u + "\nproperty float " + v + '\n' + faces(1)) +
                     end + "0 0 0 0 0.25\n1 0 0 1 0.25\n0 1 0 0 1\n3 0 1 2\n");
        EXPECT_EQ(first_primitive(scene).uvs[0].at(0), glm::vec2(0, 0.75F)) << names;
    }
    const Scene corners =
        read_ply(head("ascii", 4, faces(2) + "property list uchar float texcoord\n") + end + three_points +
                 "1 1 0\n3 0 1 2 6 0 0 1 0 0 1\n3 1 3 2 6 0.5 0 0.5 1 0 1\n");
    EXPECT_EQ(first_primitive(corners).positions.size(), 5U)
        << "one corner has other coordinates in the second face";
    EXPECT_EQ(first_primitive(corners).uvs[0].at(3), glm::vec2(0.5F, 1.0F));
}

TEST(PlyImport, TexturesOfFacesAreMaterials)
{
    const test::Folder folder;
    save_png({.width = 2, .height = 1, .rgba = {1, 2, 3, 255, 4, 5, 6, 255}}, folder / "My Skin.png");
    std::ofstream(folder / "scan.ply")
        << "ply\nformat ascii 1.0\ncomment TextureFile my skin.PNG\ncomment TextureFile hair.png\nelement "
           "vertex 4\n"
           "property float x\nproperty float y\nproperty float z\nelement face 3\n"
        << list << "property list uchar float texcoord\nproperty int texnumber\nend_header\n"
        << three_points
        << "1 1 0\n3 0 1 2 6 0 0 1 0 0 1 0\n3 1 3 2 6 0 0 1 0 0 1 1\n3 0 2 3 6 0 0 1 0 0 1 0\n";
    const Scene scene = load_ply(folder / "scan.ply");
    ASSERT_EQ(scene.meshes.at(0).primitives.size(), 2U);
    EXPECT_EQ(first_primitive(scene).indices.size(), 6U);
    EXPECT_EQ(scene.textures.at(scene.materials.at(0).base_color_texture.texture).image.width, 2U);
    ASSERT_EQ(scene.warnings.size(), 1U);
    EXPECT_NE(scene.warnings[0].find("hair.png"), std::string::npos);
}

TEST(PlyImport, ColorsOfFaces)
{
    const Scene scene = read_ply(
        head("ascii", 4, faces(2) + "property uchar red\nproperty uchar green\nproperty uchar blue\n") + end +
        three_points + "1 1 0\n3 0 1 2 255 0 0\n3 1 3 2 0 0 255\n");
    ASSERT_EQ(first_primitive(scene).positions.size(), 6U);
    EXPECT_EQ(first_primitive(scene).colors.at(0), glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(first_primitive(scene).colors.at(5), glm::vec4(0, 0, 1, 1));
}

TEST(PlyImport, StripsAndEdges)
{
    const Scene strips =
        read_ply(head("ascii", 6, "element tristrips 1\nproperty list int int vertex_indices\n") + end +
                 "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n1 2 0\n9 0 1 2 3 -1 2 3 4 5\n");
    ASSERT_EQ(first_primitive(strips).indices.size(), 12U);
    for (const glm::vec3& normal : first_primitive(strips).normals)
        EXPECT_EQ(normal, glm::vec3(0, 0, 1)) << "all wound one way";
    const Scene edges =
        read_ply(head("ascii", 3, "element edge 2\nproperty int vertex1\nproperty int vertex2\n") + end +
                 three_points + "0 1\n1 2\n");
    EXPECT_EQ(first_primitive(edges).topology, Topology::lines);
    EXPECT_EQ(first_primitive(edges).indices.size(), 4U);
}

TEST(PlyImport, ConcaveFacesKeepTheirShape)
{
    const Scene scene =
        read_ply(head("ascii", 4, faces(1)) + end + "0 0 0\n2 -1 0\n0.5 0 0\n2 1 0\n4 0 1 2 3\n");
    for (const glm::vec3& normal : first_primitive(scene).normals)
        EXPECT_EQ(normal, glm::vec3(0, 0, 1));
}

TEST(PlyImport, FacesMayComeFirst)
{
    const std::string header = "ply\nformat ascii 1.0\n" + faces(2) +
                               "element vertex 3\nproperty float x\nproperty float y\n"
                               "property float z\nend_header\n";
    const Scene scene = read_ply(header + "3 0 1 2\n3 0 1 3\n" + three_points);
    EXPECT_EQ(first_primitive(scene).indices.size(), 3U);
    EXPECT_NE(all_warnings(scene).find("1 faces left out: they name vertices that are not there"),
              std::string::npos);
}

TEST(PlyImport, FarOffCoordinatesAreExact)
{
    const std::string header =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\n"
        "property double z\n" +
        faces(1) + end;
    const Scene scene = read_ply(header + "5000000.125 0 0\n5000001.25 0 0\n5000000.125 1.0625 0\n3 0 1 2\n");
    EXPECT_EQ(first_primitive(scene).positions.at(1).x - first_primitive(scene).positions.at(0).x, 1.125F);
    EXPECT_EQ(scene_bounds(scene, pose_scene(scene, 0.0)).max.x, 5000001.25);
}

TEST(PlyImport, ACutFileSaysHowMuchIsMissing)
{
    std::string text = head("ascii", 3, faces(4)) + end + three_points;
    for (int i = 0; i < 4; ++i)
        text += "3 0 1 2\n";
    EXPECT_EQ(all_warnings(read_ply(text)), "");
    EXPECT_EQ(all_warnings(read_ply(text.substr(0, text.size() - 1))), "")
        << "the last line end does not count";
    EXPECT_NE(all_warnings(read_ply(text.substr(0, text.size() - 8))).find("is cut off: says 4 faces, has 3"),
              std::string::npos);
    EXPECT_NE(all_warnings(read_ply(text.substr(0, text.size() - 9))).find("says 4 faces, has 2"),
              std::string::npos)
        << "the third may lack a digit";
    EXPECT_NE(ply_error_of(text.substr(0, text.find("3 0 1"))).find("says 4 faces, has 0"),
              std::string::npos);
    EXPECT_NE(ply_error_of(text.substr(0, text.find("0 1 0"))).find("has nothing to draw"),
              std::string::npos);

    std::string binary = head("binary_little_endian", 3, faces(4)) + end;
    for (const float value : {0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F})
        put_ordered(binary, value, false);
    for (int i = 0; i < 4; ++i) {
        put_ordered<uint8_t>(binary, 3, false);
        for (const int32_t index : {0, 1, 2})
            put_ordered(binary, index, false);
    }
    EXPECT_EQ(all_warnings(read_ply(binary + "\n")), "") << "some programs write a last line end";
    EXPECT_NE(all_warnings(read_ply(binary.substr(0, binary.size() - 14))).find("says 4 faces, has 2"),
              std::string::npos);
    const std::string cloud = head("ascii", 5) + end + three_points;
    EXPECT_NE(all_warnings(read_ply(cloud)).find("says 5 vertices, has 3"), std::string::npos);
    EXPECT_EQ(first_primitive(read_ply(cloud)).indices.size(), 3U);
}

TEST(PlyImport, RowsThatTheHeaderDoesNotCountAreWarnedAbout)
{
    const std::string text = head("ascii", 3, faces(1)) + end + three_points + "3 0 1 2\n";
    EXPECT_EQ(all_warnings(read_ply(text + "\n \n")), "");
    EXPECT_NE(all_warnings(read_ply(text + "3 0 1 2\n")).find("goes on after the last element"),
              std::string::npos);
    EXPECT_NE(all_warnings(read_ply(text.substr(0, text.size() - 1) + " 7\n")).find("1 lines have too many"),
              std::string::npos);
    std::string binary = head("binary_little_endian", 3) + end;
    for (int i = 0; i < 9; ++i)
        put_ordered(binary, static_cast<float>(i), false);
    EXPECT_EQ(all_warnings(read_ply(binary)), "");
    EXPECT_NE(all_warnings(read_ply(binary + "\ntrailing")).find("goes on after the last element"),
              std::string::npos);
}

TEST(PlyImport, NonsenseIsCountedOrRefused)
{
    const std::string good = head("ascii", 3, faces(1)) + end + three_points;
    EXPECT_NE(ply_error_of(good + "3 0 1 7\n").find("1 faces left out"), std::string::npos);
    EXPECT_NE(ply_error_of(good + "3 0 1 -2\n").find("1 faces left out"), std::string::npos);
    EXPECT_NE(ply_error_of(good + "3 0 1 x\n").find("1 faces left out"), std::string::npos);
    EXPECT_NE(ply_error_of(head("ascii", 3, faces(1)) + end + "nan 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
                  .find("not finite"),
              std::string::npos);
    const Scene scene = read_ply(head("ascii", 3, faces(3)) + end + three_points + "3 0 1 2\n2 0 1\n3 0 1\n");
    EXPECT_NE(all_warnings(scene).find("1 faces left out: they have fewer than three corners"),
              std::string::npos);
    EXPECT_NE(all_warnings(scene).find("1 lines have too few numbers"), std::string::npos);
    const std::vector<std::string> bad_files{
        std::string("\x01\x02\x03 not a ply"),
        head("ascii", 3),
        std::string("ply\nend_header\n"),
        std::string("ply\n"),
        std::string("ply\nformat ascii 1.0\nelement vertex x\nend_header\n"),
        std::string("ply\nformat ascii 1.0\nelement vertex -1\nend_header\n"),
        std::string("ply\nformat ascii 1.0\nproperty float x\nend_header\n"),
        std::string("ply\nformat ascii 1.0\nelement vertex 1\nproperty quad x\nend_header\n"),
        std::string("ply\nformat ascii 1.0\nelement vertex 1\nproperty list float int x\nend_header\n"),
        std::string("ply\nformat braille 1.0\nend_header\n"),
        std::string("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n"),
        std::string("ply\nformat ascii 1.0\nhello\nend_header\n"),
        "ply\n" + std::string(100000, 'x'),
        "ply\nformat binary_little_endian 1.0\nelement vertex 2147483647\nproperty float x\nproperty float "
        "y\n"
        "property float z\nend_header\n0000",
        head("binary_little_endian", 0,
             "element face 4294967295\nproperty list uint double vertex_indices\n") +
            end + std::string(64, '\xFF')};
    for (const std::string& bad : bad_files)
        EXPECT_NE(ply_error_of(bad), "was read") << bad.substr(0, 200);
}

TEST(PlyImport, ElementsWithoutUseArePassedOver)
{
    const Scene scene =
        read_ply("ply\nformat ascii 1.0\nobj_info num_cols 3\nelement camera 1\nproperty float view px\n"
                 "property list uchar float matrix\nelement nothing 4000000000\nelement vertex 3\n"
                 "property float confidence\nproperty float x\nproperty float y\nproperty float z\n" +
                 faces(1) +
                 "element material 1\nproperty int shine\nend_header\n5 2 1 1\n"
                 "9 0 0 0\n9 1 0 0\n9 0 1 0\n3 0 1 2\n7\n");
    EXPECT_EQ(first_primitive(scene).positions.at(1), glm::vec3(1, 0, 0));
    EXPECT_EQ(all_warnings(scene), "");
}

} // namespace
} // namespace estampe
