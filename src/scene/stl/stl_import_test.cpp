// SPDX-License-Identifier: MIT
#include "scene/importers.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include <estampe/error.hpp>

#include "support/imported.hpp"

namespace estampe {
namespace {

using test::all_warnings;
using test::first_primitive;

Scene read_stl(const std::string& content)
{
    return load_stl_bytes(std::as_bytes(std::span(content)), "test.stl");
}

std::string stl_error_of(const std::string& content)
{
    try {
        const Scene scene = read_stl(content);
        return "was read";
    } catch (const Error& error) {
        EXPECT_EQ(error.where().find("test.stl"), 0U) << error.what();
        return error.what();
    }
}

/// A facet in the plane z that faces up.
std::string facet(const std::string& z = "0", const std::string& normal = "0 0 1")
{
    return "  facet normal " + normal + "\n    outer loop\n      vertex 0 0 " + z + "\n      vertex 1 0 " +
           z + "\n      vertex 0 1 " + z + "\n    endloop\n  endfacet\n";
}

std::string solid(const std::string& name, const std::string& facets)
{
    return "solid " + name + '\n' + facets + "endsolid " + name + '\n';
}

std::string binary(const std::string& title, uint32_t said, uint32_t written, uint16_t attribute = 0)
{
    std::string bytes = title;
    bytes.resize(80, '\0');
    const auto put = [&bytes](const void* value, size_t size) {
        bytes.append(static_cast<const char*>(value), size);
    };
    put(&said, 4);
    const float numbers[12] = {0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0};
    for (uint32_t i = 0; i < written; ++i) {
        put(numbers, sizeof numbers);
        put(&attribute, 2);
    }
    return bytes;
}

TEST(StlImport, SolidsOfATextAreNodes)
{
    const Scene scene =
        read_stl(solid("", "") + solid("first thing", facet()) + solid("second", facet("1") + facet("2")));
    ASSERT_EQ(scene.meshes.size(), 2U);
    EXPECT_EQ(scene.nodes.at(1).name, "first thing");
    EXPECT_EQ(scene.nodes.at(2).name, "second");
    EXPECT_EQ(scene.meshes[1].primitives.at(0).indices.size(), 6U);
    EXPECT_TRUE(scene.materials.at(0).double_sided);
    EXPECT_EQ(all_warnings(scene), "");
}

TEST(StlImport, TextOfAnyCaseAndLineEnd)
{
    std::string capitals = solid("part", facet("1.5e-1"));
    std::transform(capitals.begin(), capitals.end(), capitals.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::toupper(letter)); });
    std::string one_line = solid("part", facet("+1.50E-01"));
    std::replace(one_line.begin() + 12, one_line.end(), '\n', ' ');
    std::string old_mac = solid("part", facet("0.15"));
    std::replace(old_mac.begin(), old_mac.end(), '\n', '\r');
    for (const std::string& text :
         {capitals, one_line, old_mac, "\xEF\xBB\xBF" + solid("part", facet("0.15")),
          "\n  " + solid("part", facet("0,15"))}) {
        const Scene scene = read_stl(text);
        EXPECT_EQ(first_primitive(scene).indices.size(), 3U) << text;
        EXPECT_EQ(first_primitive(scene).positions.at(0).z, 0.15F) << text;
        EXPECT_EQ(all_warnings(scene), "") << text;
    }
}

TEST(StlImport, NormalsComeFromTheShape)
{
    for (const char* const normal : {"0 0 0", "0 0 1", "0 1 0", "nan nan nan", "1e99 0 0"})
        EXPECT_EQ(first_primitive(read_stl(solid("x", facet("0", normal)))).normals.at(0), glm::vec3(0, 0, 1))
            << normal;
    // A strip that bends by less than the crease angle is shaded smoothly, like a scan.
    const std::string bent =
        "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
        "facet normal 0 0.3 1\nouter loop\nvertex 1 0 0\nvertex 1 1 0.3\nvertex 0 1 0\nendloop\nendfacet\n";
    EXPECT_EQ(first_primitive(read_stl(solid("bent", bent))).positions.size(), 4U);
}

TEST(StlImport, BinaryWhateverItsTitle)
{
    for (const char* const title : {"", "solid of a program that ought to know better", "exported"}) {
        const Scene scene = read_stl(binary(title, 2, 2));
        EXPECT_EQ(first_primitive(scene).indices.size(), 6U) << title;
        EXPECT_EQ(first_primitive(scene).normals.at(0), glm::vec3(0, 0, 1));
        EXPECT_TRUE(first_primitive(scene).colors.empty());
        EXPECT_EQ(all_warnings(scene), "") << title;
        EXPECT_EQ(all_warnings(read_stl(binary(title, 2, 2) + "\n")), "") << "padding";
        EXPECT_EQ(first_primitive(read_stl(binary(title, 2, 2) + "more")).indices.size(), 6U);
    }
}

TEST(StlImport, ColorsOfFacets)
{
    const Scene viscam = read_stl(binary("viscam", 1, 1, 0x8000U | 31U << 10U));
    EXPECT_EQ(first_primitive(viscam).colors.at(0), glm::vec4(1, 0, 0, 1)) << "blue comes first";
    const std::string magics = std::string("COLOR=") + '\0' + '\xFF' + '\0' + '\xFF';
    EXPECT_EQ(first_primitive(read_stl(binary(magics, 1, 1, 31U))).colors.at(0), glm::vec4(1, 0, 0, 1))
        << "red comes first";
    EXPECT_EQ(first_primitive(read_stl(binary(magics, 1, 1, 0x8000U))).colors.at(0), glm::vec4(0, 1, 0, 1))
        << "the part's own";
}

TEST(StlImport, ACutFileSaysHowMuchIsMissing)
{
    EXPECT_NE(all_warnings(read_stl(binary("", 5, 3))).find("is cut off: says 5 facets, has 3"),
              std::string::npos);
    EXPECT_NE(all_warnings(read_stl(binary("", 0x80000000U, 1))).find("says 2147483648 facets, has 1"),
              std::string::npos);
    EXPECT_EQ(all_warnings(read_stl(binary("", 3, 3))), "");
    EXPECT_NE(all_warnings(read_stl(binary("", 2, 3))).find("goes on for 50 bytes after the 2 facets"),
              std::string::npos);
    const std::string text = solid("part", facet() + facet("1") + facet("2"));
    EXPECT_EQ(all_warnings(read_stl(text.substr(0, text.size() - 1))), "");
    const std::string in_number = text.substr(0, text.rfind("vertex 0 1") + 9);
    EXPECT_NE(all_warnings(read_stl(in_number)).find("is cut off: ends in a facet, after 2 facets"),
              std::string::npos);
    EXPECT_EQ(first_primitive(read_stl(in_number)).indices.size(), 6U);
    const std::string between = text.substr(0, text.find("endsolid"));
    EXPECT_NE(all_warnings(read_stl(between)).find("ends without endsolid, after 3 facets"),
              std::string::npos);
    // The last number of a truncated file may lack digits.
    const std::string in_last = text.substr(0, text.rfind("\n    endloop"));
    EXPECT_EQ(first_primitive(read_stl(in_last)).indices.size(), 6U);
}

TEST(StlImport, NonsenseIsCountedOrRefused)
{
    EXPECT_NE(stl_error_of(binary("", 0, 0)), "was read");
    EXPECT_NE(stl_error_of(binary("", 3, 0)).find("says 3 facets, has 0"), std::string::npos);
    EXPECT_NE(stl_error_of(binary("", 1, 1).substr(0, 60)), "was read");
    EXPECT_NE(stl_error_of("solid\nendsolid\n"), "was read");
    EXPECT_NE(stl_error_of("x"), "was read");
    EXPECT_NE(stl_error_of(std::string(500, 'x')), "was read");
    EXPECT_NE(
        stl_error_of(solid("x", "facet normal 0 0 1\nouter loop\nvertex 0 0 nan\nvertex 1 0 0\nvertex 0 1 0\n"
                                "endloop\nendfacet\n"))
            .find("not finite"),
        std::string::npos);
    const Scene scene = read_stl(solid(
        "x", facet() + "facet normal 0 0 1\nouter loop\nvertex 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
                       "endfacet\nhello\n"));
    EXPECT_NE(all_warnings(scene).find("1 facets left out"), std::string::npos);
    EXPECT_NE(all_warnings(scene).find("1 words are not STL, the first of them in line 16"),
              std::string::npos);
    EXPECT_EQ(first_primitive(scene).indices.size(), 3U);
}

TEST(StlImport, OtherFilesOfThatNameAreRefused)
{
    std::string page = "<!DOCTYPE html>\n<html><head><title>404 Not Found</title></head>\n<body>";
    page.append(500, 'x');
    page += "</body></html>\n";
    EXPECT_NE(stl_error_of(page).find("is no STL file"), std::string::npos);
    EXPECT_EQ(first_primitive(read_stl(facet() + facet("1"))).indices.size(), 6U)
        << "a text without its first line";
}

TEST(StlImport, ZerosInPlaceOfFacetsAreLeftOut)
{
    std::string file = binary("", 3, 3);
    std::fill(file.end() - 50, file.end(), '\0');
    const Scene scene = read_stl(file);
    EXPECT_EQ(first_primitive(scene).indices.size(), 6U);
    EXPECT_NE(all_warnings(scene).find("1 facets left out: all their corners are in one place"),
              std::string::npos);
}

TEST(StlImport, FarOffCoordinatesAreExact)
{
    const Scene scene =
        read_stl(solid("x", "facet normal 0 0 1\nouter loop\nvertex 5000000.125 0 0\nvertex 5000001.25 0 0\n"
                            "vertex 5000000.125 1 0\nendloop\nendfacet\n"));
    EXPECT_EQ(first_primitive(scene).positions.at(1).x - first_primitive(scene).positions.at(0).x, 1.125F);
    EXPECT_EQ(scene_bounds(scene, pose_scene(scene, 0.0)).max.x, 5000001.25);
}

} // namespace
} // namespace estampe
