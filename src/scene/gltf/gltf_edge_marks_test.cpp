// SPDX-License-Identifier: MIT
// Marked edges: the examples of the extension's specification, in every topology, and invalid files.

#include <gtest/gtest.h>

#include <estampe/error.hpp>

#include "scene/gltf/test_file.hpp"

namespace estampe::gltf {
namespace {

constexpr auto marks_extension = "EXT_mesh_primitive_edge_visibility";

/// Five points around the point 0, four triangles between them, as indices of glTF `mode`.
TestFile fan_file(const std::vector<uint16_t>& indices, int mode = 4)
{
    TestFile file;
    const int positions = file.add<float>({0, 0, 0, -1, 0, 0, -1, 1, 0, 0, 1, 0, 1, 1, 0, 1, 0, 0}, "VEC3");
    const int normals = file.add<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    const int index = file.add<uint16_t>(indices, "SCALAR");
    file.document["meshes"] = json::array(
        {{{"primitives", json::array({{{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}},
                                       {"indices", index},
                                       {"mode", mode}}})}}});
    file.document["nodes"] = json::array({{{"mesh", 0}}});
    file.document["scenes"] = json::array({{{"nodes", json::array({0})}}});
    file.document["scene"] = 0;
    file.document["extensionsUsed"] = json::array({marks_extension});
    return file;
}

json& marks_of(TestFile& file)
{
    return file.primitive()["extensions"][marks_extension];
}

using Marks = std::vector<uint8_t>;

Marks loaded_marks(const TestFile& file)
{
    return file.load().meshes.at(0).primitives.at(0).edge_marks;
}

TEST(GltfEdgeMarks, AreReadAsTheTwoExamplesOfTheExtensionHaveThem)
{
    TestFile shared_outline = fan_file({0, 1, 2, 0, 2, 3});
    marks_of(shared_outline)["visibility"] = shared_outline.add<uint8_t>({18, 2}, "SCALAR");
    EXPECT_EQ(loaded_marks(shared_outline), (Marks{0b001, 0b010}));
    TestFile shared_hard = fan_file({0, 1, 2, 0, 2, 3});
    marks_of(shared_hard)["visibility"] = shared_hard.add<uint8_t>({226, 2}, "SCALAR");
    EXPECT_EQ(loaded_marks(shared_hard), (Marks{0b101, 0b011}));
    EXPECT_TRUE(shared_hard.load().extensions_ignored.empty());
    EXPECT_TRUE(shared_hard.load().warnings.empty());
}

/// Values [0,2,0, 0,0,2, 3,0,0, 0,2,0] along 12, 30 and 45, and two line strings along 2-3-4 and 1-0-5.
TEST(GltfEdgeMarks, ComeFromLineStringsToo)
{
    TestFile file = fan_file({0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5});
    marks_of(file)["visibility"] = file.add<uint8_t>({0b00001000, 0b00111000, 0b00100000}, "SCALAR");
    marks_of(file)["lineStrings"][0]["indices"] = file.add<uint8_t>({2, 3, 4, 255, 1, 0, 5}, "SCALAR");
    EXPECT_EQ(loaded_marks(file), (Marks{0b011, 0b110, 0b011, 0b110}));
    EXPECT_TRUE(file.load().warnings.empty());
}

TEST(GltfEdgeMarks, FollowTheOrderOfCornersInStripsAndFans)
{
    // The fan's second triangle is 2 3 0; its first edge is 23.
    TestFile fan = fan_file({0, 1, 2, 3, 4, 5}, 6);
    marks_of(fan)["visibility"] = fan.add<uint8_t>({0b10000000, 0, 0}, "SCALAR");
    EXPECT_EQ(loaded_marks(fan), (Marks{0, 0b010, 0, 0}));
    // The strip's triangles are 1 2 0 and, reversed like every other one, 2 3 0. The edge 20 is the second of
    // the first and the third of the second.
    TestFile strip = fan_file({1, 2, 0, 3}, 5);
    marks_of(strip)["visibility"] = strip.add<uint8_t>({0b00001000, 0b00001100}, "SCALAR");
    const Scene scene = strip.load();
    const Primitive& primitive = scene.meshes[0].primitives[0];
    ASSERT_EQ(primitive.edge_marks.size(), 2U);
    for (size_t t = 0; t < 2; ++t) {
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t a = primitive.indices[3 * t + k];
            const uint32_t b = primitive.indices[3 * t + (k + 1) % 3];
            EXPECT_EQ((primitive.edge_marks[t] >> k & 1U) != 0, std::min(a, b) == 0 && std::max(a, b) == 2);
        }
    }
}

TEST(GltfEdgeMarks, HoldWhereVerticesAreMadeAnew)
{
    TestFile file = fan_file({0, 1, 2, 0, 2, 3});
    file.attributes().erase("NORMAL"); // flat normals would give each triangle its own vertices
    marks_of(file)["visibility"] = file.add<uint8_t>({226, 2}, "SCALAR");
    EXPECT_EQ(loaded_marks(file), (Marks{0b101, 0b011}));
}

void expect_marks_error(const TestFile& file, const std::string& where, const std::string& what)
{
    try {
        (void)file.load();
        ADD_FAILURE() << where << ": no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.where(),
                  "test.glb#/meshes/0/primitives/0/extensions/" + std::string(marks_extension) + where)
            << error.what();
        EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
    }
}

TEST(GltfEdgeMarks, ThatDoNotFitAreErrorsWithTheirPlace)
{
    const auto with_visibility = [](auto values, const char* type = "SCALAR") {
        TestFile file = fan_file({0, 1, 2, 0, 2, 3});
        marks_of(file)["visibility"] = file.add(values, type);
        return file;
    };
    expect_marks_error(with_visibility(std::vector<uint8_t>{1, 2, 3}), "/visibility", "2 triangles need 2");
    expect_marks_error(with_visibility(std::vector<uint16_t>{1, 2}), "/visibility", "not of unsigned bytes");
    expect_marks_error(with_visibility(std::vector<uint8_t>{1, 2, 3, 4}, "VEC2"), "/visibility",
                       "2 components");
    const auto with_string = [](auto values) {
        TestFile file = fan_file({0, 1, 2, 0, 2, 3});
        marks_of(file)["lineStrings"][0]["indices"] = file.add(values, "SCALAR");
        return file;
    };
    expect_marks_error(with_string(std::vector<uint8_t>{0, 6}), "/lineStrings/0/indices",
                       "past the 6 vertices");
    expect_marks_error(with_string(std::vector<uint8_t>{0, 1, 255}), "/lineStrings/0/indices",
                       "no two points");
    expect_marks_error(with_string(std::vector<uint16_t>{0, 0xffff, 1, 2}), "/lineStrings/0/indices",
                       "no two points");
    TestFile neither = fan_file({0, 1, 2});
    marks_of(neither)["material"] = 0;
    neither.document["materials"] = json::parse("[{}]");
    expect_marks_error(neither, "", "lacks both");
    TestFile no_accessor = fan_file({0, 1, 2});
    marks_of(no_accessor)["visibility"] = 7;
    expect_marks_error(no_accessor, "/visibility", "outside");
    TestFile no_indices = fan_file({0, 1, 2});
    marks_of(no_indices)["lineStrings"] = json::parse("[{}]");
    expect_marks_error(no_indices, "/lineStrings/0", "lacks \"indices\"");
}

TEST(GltfEdgeMarks, AlongNoTriangleAreCountedAndLeftOut)
{
    TestFile file = fan_file({0, 1, 2, 0, 2, 3});
    marks_of(file)["lineStrings"][0]["indices"] = file.add<uint8_t>({1, 2, 4}, "SCALAR");
    const Scene scene = file.load();
    EXPECT_EQ(scene.meshes[0].primitives[0].edge_marks, (Marks{0b010, 0}));
    ASSERT_EQ(scene.warnings.size(), 1U);
    EXPECT_NE(scene.warnings[0].find("1 of 2 marked edges"), std::string::npos) << scene.warnings[0];
}

} // namespace
} // namespace estampe::gltf
