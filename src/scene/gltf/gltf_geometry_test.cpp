// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/image_codec.hpp"
#include "scene/gltf/test_file.hpp"

namespace estampe::gltf {
namespace {

using Indices = std::vector<uint32_t>;

const Primitive& only_primitive(const Scene& scene)
{
    EXPECT_EQ(scene.meshes.size(), 1U);
    EXPECT_EQ(scene.meshes[0].primitives.size(), 1U);
    return scene.meshes[0].primitives[0];
}

/// Five points in a fan, drawn in the given mode without indices.
Primitive in_mode(int mode)
{
    TestFile file = triangle_file();
    file.attributes() = {
        {"POSITION", file.add<float>({0, 0, 0, 2, 0, 0, 2, 1, 0, 1, 2, 0, 0, 2, 0}, "VEC3")},
        {"NORMAL", file.add<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3")},
    };
    file.primitive().erase("indices");
    file.primitive()["mode"] = mode;
    return only_primitive(file.load());
}

TEST(GltfGeometry, triangle)
{
    const Scene scene = triangle_file().load();
    const Primitive& primitive = only_primitive(scene);
    EXPECT_EQ(primitive.topology, Topology::triangles);
    EXPECT_EQ(primitive.positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(primitive.normals, std::vector<glm::vec3>(3, {0, 0, 1}));
    EXPECT_EQ(primitive.indices, (Indices{0, 1, 2}));
    EXPECT_TRUE(primitive.tangents.empty());
    EXPECT_EQ(primitive.material, 0U);
    EXPECT_EQ(scene.materials.size(), 1U);
    EXPECT_EQ(scene.roots, (Indices{0}));
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfGeometry, modes_become_lists)
{
    EXPECT_EQ(in_mode(0).indices, (Indices{0, 1, 2, 3, 4}));
    EXPECT_EQ(in_mode(0).topology, Topology::points);
    EXPECT_EQ(in_mode(1).indices, (Indices{0, 1, 2, 3}));
    EXPECT_EQ(in_mode(1).topology, Topology::lines);
    EXPECT_EQ(in_mode(2).indices, (Indices{0, 1, 1, 2, 2, 3, 3, 4, 4, 0}));
    EXPECT_EQ(in_mode(3).indices, (Indices{0, 1, 1, 2, 2, 3, 3, 4}));
    EXPECT_EQ(in_mode(4).indices, (Indices{0, 1, 2}));
    EXPECT_EQ(in_mode(5).indices, (Indices{0, 1, 2, 1, 3, 2, 2, 3, 4}));
    EXPECT_EQ(in_mode(6).indices, (Indices{0, 1, 2, 0, 2, 3, 0, 3, 4}));
    EXPECT_EQ(in_mode(6).topology, Topology::triangles);
}

TEST(GltfGeometry, strips_lose_their_stitches)
{
    TestFile file = triangle_file();
    file.attributes().erase("NORMAL");
    file.primitive()["mode"] = 5;
    file.primitive()["indices"] = file.add<uint8_t>({0, 1, 2, 2, 2}, "SCALAR");
    EXPECT_EQ(only_primitive(file.load()).indices.size(), 3U);
}

TEST(GltfGeometry, index_types)
{
    TestFile file = triangle_file();
    file.primitive()["indices"] = file.add<uint8_t>({2, 1, 0}, "SCALAR");
    EXPECT_EQ(only_primitive(file.load()).indices, (Indices{2, 1, 0}));
    file.primitive()["indices"] = file.add<uint32_t>({2, 0, 1}, "SCALAR");
    EXPECT_EQ(only_primitive(file.load()).indices, (Indices{2, 0, 1}));
}

template <typename Value>
glm::vec2 first_uv(Value u, Value v, bool normalized)
{
    TestFile file = triangle_file();
    file.attributes()["TEXCOORD_0"] =
        file.add<Value>({u, v, 0, 0, 0, 0}, "VEC2", {{"normalized", normalized}});
    return only_primitive(file.load()).uvs[0][0];
}

TEST(GltfGeometry, component_types_plain_and_normalised)
{
    EXPECT_EQ(first_uv<float>(0.25F, -3.5F, false), glm::vec2(0.25F, -3.5F));
    EXPECT_EQ(first_uv<int8_t>(-128, 127, true), glm::vec2(-1.0F, 1.0F));
    EXPECT_EQ(first_uv<int8_t>(-128, 127, false), glm::vec2(-128.0F, 127.0F));
    EXPECT_EQ(first_uv<uint8_t>(255, 51, true), glm::vec2(1.0F, 0.2F));
    EXPECT_EQ(first_uv<int16_t>(-32768, 32767, true), glm::vec2(-1.0F, 1.0F));
    EXPECT_EQ(first_uv<uint16_t>(65535, 13107, true), glm::vec2(1.0F, 0.2F));
    EXPECT_EQ(first_uv<uint16_t>(65535, 7, false), glm::vec2(65535.0F, 7.0F));
    EXPECT_EQ(first_uv<uint32_t>(9, 7, false), glm::vec2(9.0F, 7.0F));
}

TEST(GltfGeometry, quantised_positions)
{
    TestFile file = triangle_file();
    file.document["extensionsRequired"] = {"KHR_mesh_quantization"};
    file.document["extensionsUsed"] = {"KHR_mesh_quantization"};
    const int view =
        file.add_view(bytes_of<int16_t>({0, 0, 0, 0, 10, 0, 0, 0, 0, -20, 0, 0}), {{"byteStride", 8}});
    file.attributes()["POSITION"] =
        file.add_accessor({{"bufferView", view}, {"componentType", 5122}, {"count", 3}, {"type", "VEC3"}});
    const int normals =
        file.add_view(bytes_of<int8_t>({0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0}), {{"byteStride", 4}});
    file.attributes()["NORMAL"] = file.add_accessor({{"bufferView", normals},
                                                     {"componentType", 5120},
                                                     {"count", 3},
                                                     {"type", "VEC3"},
                                                     {"normalized", true}});
    const Scene scene = file.load();
    EXPECT_EQ(only_primitive(scene).positions, (std::vector<glm::vec3>{{0, 0, 0}, {10, 0, 0}, {0, -20, 0}}));
    EXPECT_EQ(only_primitive(scene).normals, std::vector<glm::vec3>(3, {0, 0, 1}));
    EXPECT_TRUE(scene.extensions_ignored.empty());
}

TEST(GltfGeometry, interleaved_view)
{
    TestFile file = triangle_file();
    const int view = file.add_view(bytes_of<float>({0, 0, 0, .1F, .2F, 1, 0, 0, .3F, .4F, 0, 1, 0, .5F, .6F}),
                                   {{"byteStride", 20}});
    file.attributes()["POSITION"] =
        file.add_accessor({{"bufferView", view}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}});
    file.attributes()["TEXCOORD_1"] = file.add_accessor(
        {{"bufferView", view}, {"byteOffset", 12}, {"componentType", 5126}, {"count", 3}, {"type", "VEC2"}});
    const Scene scene = file.load();
    EXPECT_EQ(only_primitive(scene).positions[2], glm::vec3(0, 1, 0));
    EXPECT_TRUE(only_primitive(scene).uvs[0].empty());
    EXPECT_EQ(only_primitive(scene).uvs[1], (std::vector<glm::vec2>{{.1F, .2F}, {.3F, .4F}, {.5F, .6F}}));
}

json sparse_json(TestFile& file, const std::vector<uint16_t>& indices, const std::vector<float>& values)
{
    return {{"count", indices.size()},
            {"indices", {{"bufferView", file.add_view(bytes_of(indices))}, {"componentType", 5123}}},
            {"values", {{"bufferView", file.add_view(bytes_of(values))}}}};
}

TEST(GltfGeometry, sparse_over_a_view)
{
    TestFile file = triangle_file();
    file.document["accessors"][0]["sparse"] = sparse_json(file, {2}, {5, 6, 7});
    EXPECT_EQ(only_primitive(file.load()).positions,
              (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {5, 6, 7}}));
}

TEST(GltfGeometry, sparse_over_zeros)
{
    TestFile file = triangle_file();
    file.attributes()["POSITION"] =
        file.add_accessor({{"componentType", 5126},
                           {"count", 3},
                           {"type", "VEC3"},
                           {"sparse", sparse_json(file, {0, 1}, {1, 2, 3, 4, 5, 6})}});
    EXPECT_EQ(only_primitive(file.load()).positions,
              (std::vector<glm::vec3>{{1, 2, 3}, {4, 5, 6}, {0, 0, 0}}));
}

TEST(GltfGeometry, colors_with_and_without_alpha)
{
    TestFile file = triangle_file();
    file.attributes()["COLOR_0"] = file.add<float>({.5F, 0, 1, 1, 1, 1, 0, 0, 0}, "VEC3");
    EXPECT_EQ(only_primitive(file.load()).colors[0], glm::vec4(.5F, 0, 1, 1));
    file.attributes()["COLOR_0"] =
        file.add<uint8_t>({255, 0, 0, 51, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC4", {{"normalized", true}});
    EXPECT_EQ(only_primitive(file.load()).colors[0], glm::vec4(1, 0, 0, .2F));
}

TEST(GltfGeometry, missing_normals_are_flat)
{
    TestFile file = triangle_file();
    file.attributes() = {{"POSITION", file.add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3")}};
    file.primitive()["indices"] = file.add<uint16_t>({0, 1, 2, 0, 2, 3}, "SCALAR");
    const Scene scene = file.load();
    const Primitive& primitive = only_primitive(scene);
    EXPECT_EQ(primitive.positions.size(), 6U);
    EXPECT_EQ(primitive.indices, (Indices{0, 1, 2, 3, 4, 5}));
    EXPECT_EQ(primitive.normals[0], glm::vec3(0, 0, 1));
    EXPECT_EQ(primitive.normals[5], glm::vec3(1, 0, 0));
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfGeometry, bad_normals_are_repaired_with_a_warning)
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    TestFile file = triangle_file();
    file.attributes()["NORMAL"] = file.add<float>({0, 0, 0, nan, 0, 1, 0, 0, 5}, "VEC3");
    const Scene scene = file.load();
    EXPECT_EQ(only_primitive(scene).normals, std::vector<glm::vec3>(3, {0, 0, 1}));
    ASSERT_EQ(scene.warnings.size(), 1U);
    EXPECT_NE(scene.warnings[0].find("test.glb#/meshes/0/primitives/0/attributes/NORMAL: 2 normals"),
              std::string::npos);
}

TEST(GltfGeometry, bad_uvs_and_colors_are_repaired_with_a_warning)
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    TestFile file = triangle_file();
    file.attributes()["TEXCOORD_1"] = file.add<float>({nan, 1, 2, 3, 4, 5}, "VEC2");
    file.attributes()["COLOR_0"] = file.add<float>({0, 0, 0, 0, nan, 0, 0, 0, 0}, "VEC3");
    const Scene scene = file.load();
    EXPECT_EQ(only_primitive(scene).uvs[1], (std::vector<glm::vec2>{{0, 0}, {2, 3}, {4, 5}}));
    EXPECT_EQ(only_primitive(scene).colors[1], glm::vec4(1));
    EXPECT_EQ(scene.warnings.size(), 2U);
}

TEST(GltfGeometry, warnings_are_counted_beyond_a_hundred)
{
    TestFile file = triangle_file();
    json& primitives = file.document["meshes"][0]["primitives"];
    for (int i = 0; i < 150; ++i) {
        primitives.push_back({{"attributes", json::object()}});
    }
    const Scene scene = file.load();
    ASSERT_EQ(scene.warnings.size(), 101U);
    EXPECT_EQ(scene.warnings.back(), "test.glb: 50 more warnings");
}

TEST(GltfGeometry, tangents_are_made_for_a_normal_map)
{
    TestFile file = triangle_file();
    file.attributes()["TEXCOORD_0"] = file.add<float>({0, 0, 0, 1, 1, 0}, "VEC2"); // u along y, v along x
    file.document["materials"] = json::array({{{"normalTexture", {{"index", 0}}}}});
    const Bytes image = encode_png({.width = 1, .height = 1, .rgba = {128, 128, 255, 255}});
    file.document["images"] =
        json::array({{{"bufferView", file.add_view(image)}, {"mimeType", "image/png"}}});
    file.document["textures"] = json::parse(R"([{"source": 0}])");
    file.primitive()["material"] = 0;
    const Primitive primitive = only_primitive(file.load());
    EXPECT_EQ(primitive.tangents, std::vector<glm::vec4>(3, {0, 1, 0, -1}));
    file.attributes()["TEXCOORD_0"] = file.add<float>({0, 0, 1, 0, 0, 1}, "VEC2");
    EXPECT_EQ(only_primitive(file.load()).tangents, std::vector<glm::vec4>(3, {1, 0, 0, 1}));
    file.attributes()["TEXCOORD_0"] = file.add<float>({0, 0, 0, 0, 0, 0}, "VEC2");
    const Scene without_direction = file.load();
    for (const glm::vec4& tangent : only_primitive(without_direction).tangents) {
        EXPECT_NEAR(glm::length(glm::vec3(tangent)), 1.0F, 1e-6F);
        EXPECT_NEAR(tangent.z, 0.0F, 1e-6F);
    }
}

TEST(GltfGeometry, tangents_of_the_file_are_kept)
{
    TestFile file = triangle_file();
    file.attributes()["TANGENT"] = file.add<float>({1, 0, 0, -1, 1, 0, 0, -1, 1, 0, 0, -1}, "VEC4");
    EXPECT_EQ(only_primitive(file.load()).tangents, std::vector<glm::vec4>(3, {1, 0, 0, -1}));
}

TEST(GltfGeometry, vertices_that_nobody_uses_are_dropped)
{
    TestFile file = triangle_file();
    std::vector<float> positions;
    for (int i = 0; i < 20; ++i) {
        positions.insert(positions.end(), {static_cast<float>(i), static_cast<float>(i * i), 0.0F});
    }
    file.attributes() = {{"POSITION", file.add(positions, "VEC3")}, {"NORMAL", file.add(positions, "VEC3")}};
    file.primitive()["indices"] = file.add<uint16_t>({19, 3, 7}, "SCALAR");
    const Primitive primitive = only_primitive(file.load());
    EXPECT_EQ(primitive.indices, (Indices{0, 1, 2}));
    EXPECT_EQ(primitive.positions, (std::vector<glm::vec3>{{19, 361, 0}, {3, 9, 0}, {7, 49, 0}}));
    EXPECT_EQ(primitive.normals.size(), 3U);
}

TEST(GltfGeometry, primitives_without_anything_are_left_out_with_a_warning)
{
    TestFile file = triangle_file();
    json& primitives = file.document["meshes"][0]["primitives"];
    primitives.push_back({{"attributes", json::object()}});
    primitives.push_back(primitives[0]);
    primitives[2]["indices"] = file.add<uint16_t>({0, 1}, "SCALAR");
    const Scene scene = file.load();
    EXPECT_EQ(scene.meshes[0].primitives.size(), 1U);
    ASSERT_EQ(scene.warnings.size(), 2U);
    EXPECT_EQ(scene.warnings[0], "test.glb#/meshes/0/primitives/1: has no positions; it is left out");
    EXPECT_EQ(scene.warnings[1], "test.glb#/meshes/0/primitives/2: has nothing to draw; it is left out");
}

TEST(GltfGeometry, morph_targets)
{
    TestFile file = triangle_file();
    const int offsets = file.add<float>({0, 0, 1, 0, 0, 2, 0, 0, 3}, "VEC3");
    file.primitive()["targets"] = json::array({{{"POSITION", offsets}}, {{"NORMAL", offsets}}});
    file.document["meshes"][0]["weights"] = {0.25, 0.75};
    file.document["nodes"][0]["weights"] = {1.0, 0.0};
    const Scene scene = file.load();
    const Primitive& primitive = only_primitive(scene);
    ASSERT_EQ(primitive.morph_targets.size(), 2U);
    EXPECT_EQ(primitive.morph_targets[0].position_offsets,
              (std::vector<glm::vec3>{{0, 0, 1}, {0, 0, 2}, {0, 0, 3}}));
    EXPECT_TRUE(primitive.morph_targets[0].normal_offsets.empty());
    EXPECT_EQ(primitive.morph_targets[1].normal_offsets[2], glm::vec3(0, 0, 3));
    EXPECT_EQ(scene.meshes[0].morph_weights, (std::vector<float>{0.25F, 0.75F}));
    EXPECT_EQ(scene.nodes[0].morph_weights, (std::vector<float>{1.0F, 0.0F}));
}

} // namespace
} // namespace estampe::gltf
