// SPDX-License-Identifier: MIT
#include <limits>
#include <numeric>

#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <estampe/error.hpp>

#include "scene/gltf/test_file.hpp"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpedantic"
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#pragma GCC diagnostic pop

namespace estampe::gltf {
namespace {

constexpr auto meshopt_name = "EXT_meshopt_compression";

/// A view of `count` elements compressed with meshoptimizer, whose fallback buffer has no bytes.
int add_meshopt_view(TestFile& file, const Bytes& compressed, size_t count, size_t stride,
                     const std::string& mode, const std::string& filter = "NONE")
{
    const int source = file.add_view(compressed);
    json view = {{"buffer", 1}, {"byteLength", count * stride}};
    if (mode == "ATTRIBUTES") {
        view["byteStride"] = stride;
    }
    view["extensions"][meshopt_name] = {
        {"buffer", 0},
        {"byteOffset", file.document["bufferViews"][static_cast<size_t>(source)]["byteOffset"]},
        {"byteLength", compressed.size()},
        {"byteStride", stride},
        {"count", count},
        {"mode", mode},
        {"filter", filter}};
    file.document["bufferViews"].push_back(view);
    return source + 1;
}

template <typename Value>
Bytes encode_vertices(const std::vector<Value>& values, size_t stride)
{
    const size_t count = values.size() * sizeof(Value) / stride;
    Bytes bytes(meshopt_encodeVertexBufferBound(count, stride));
    bytes.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(),
                                            values.data(), count, stride));
    return bytes;
}

Bytes encode_triangles(const std::vector<uint32_t>& indices, size_t vertices)
{
    Bytes bytes(meshopt_encodeIndexBufferBound(indices.size(), vertices));
    bytes.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(),
                                           indices.data(), indices.size()));
    return bytes;
}

Bytes encode_sequence(const std::vector<uint32_t>& indices, size_t vertices)
{
    Bytes bytes(meshopt_encodeIndexSequenceBound(indices.size(), vertices));
    bytes.resize(meshopt_encodeIndexSequence(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(),
                                             indices.data(), indices.size()));
    return bytes;
}

json with_view(int view, int type, int count, const std::string& shape, bool normalized = false)
{
    return {{"bufferView", view},
            {"componentType", type},
            {"count", count},
            {"type", shape},
            {"normalized", normalized}};
}

TestFile meshopt_file(const std::string& index_mode)
{
    TestFile file = triangle_file();
    file.document["extensionsRequired"] = {meshopt_name};
    const std::vector<float> positions = {0, 0, 0, 2, 0, 0, 0, 3, 0, 2, 3, 1};
    const std::vector<uint32_t> indices = {0, 1, 2, 2, 1, 3};
    const int vertex_view = add_meshopt_view(file, encode_vertices(positions, 12), 4, 12, "ATTRIBUTES");
    const int index_view = add_meshopt_view(
        file, index_mode == "INDICES" ? encode_sequence(indices, 4) : encode_triangles(indices, 4), 6, 2,
        index_mode);
    file.attributes() = {{"POSITION", file.add_accessor(with_view(vertex_view, 5126, 4, "VEC3"))}};
    file.primitive()["indices"] = file.add_accessor(with_view(index_view, 5123, 6, "SCALAR"));
    file.document["buffers"] =
        json::array({{{"byteLength", file.binary.size()}},
                     {{"byteLength", 60}, {"extensions", {{meshopt_name, {{"fallback", true}}}}}}});
    return file;
}

TEST(GltfCompression, meshopt_vertices_and_triangles)
{
    const Scene scene = meshopt_file("TRIANGLES").load();
    const Primitive& primitive = scene.meshes[0].primitives[0];
    ASSERT_EQ(primitive.indices.size(), 6U);
    EXPECT_EQ(primitive.positions[primitive.indices[5]], glm::vec3(2, 3, 1));
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfCompression, meshopt_index_sequence)
{
    const Scene scene = meshopt_file("INDICES").load();
    EXPECT_EQ(scene.meshes[0].primitives[0].positions[1], glm::vec3(2, 0, 0));
}

TEST(GltfCompression, meshopt_filters)
{
    TestFile file = meshopt_file("TRIANGLES");
    const std::vector<float> normals = {0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 0};
    std::vector<int8_t> octahedral(16);
    meshopt_encodeFilterOct(octahedral.data(), 4, 4, 8, normals.data());
    file.attributes()["NORMAL"] = file.add_accessor(
        with_view(add_meshopt_view(file, encode_vertices(octahedral, 4), 4, 4, "ATTRIBUTES", "OCTAHEDRAL"),
                  5120, 4, "VEC3", true));
    const std::vector<float> uvs = {0.5F, 0.25F, 1, 2, 3, 4, 5, 6};
    std::vector<uint32_t> exponential(8);
#if MESHOPTIMIZER_VERSION >= 200
    meshopt_encodeFilterExp(exponential.data(), 4, 8, 15, uvs.data(), meshopt_EncodeExpSharedVector);
#else
    meshopt_encodeFilterExp(exponential.data(), 4, 8, 15, uvs.data());
#endif
    file.attributes()["TEXCOORD_0"] = file.add_accessor(
        with_view(add_meshopt_view(file, encode_vertices(exponential, 8), 4, 8, "ATTRIBUTES", "EXPONENTIAL"),
                  5126, 4, "VEC2"));
    const std::vector<float> turns = {0, 0, 0, 1, 0, 0, 1, 0};
    std::vector<int16_t> quaternions(8);
    meshopt_encodeFilterQuat(quaternions.data(), 2, 8, 16, turns.data());
    file.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["ROTATION"] =
        file.add_accessor(with_view(
            add_meshopt_view(file, encode_vertices(quaternions, 8), 2, 8, "ATTRIBUTES", "QUATERNION"), 5122,
            2, "VEC4", true));
    file.document["buffers"][0]["byteLength"] = file.binary.size();
    const Scene scene = file.load();
    const Primitive& primitive = scene.meshes[0].primitives[0];
    EXPECT_NEAR(primitive.normals[2].y, 1.0F, 1e-3F);
    EXPECT_NEAR(primitive.normals[3].x, 1.0F, 1e-3F);
    EXPECT_EQ(primitive.uvs[0][0], glm::vec2(0.5F, 0.25F));
    EXPECT_EQ(primitive.uvs[0][3], glm::vec2(5, 6));
    ASSERT_EQ(scene.nodes[0].instances.size(), 2U);
    EXPECT_NEAR(scene.nodes[0].instances[1][0][0], -1.0F, 1e-3F);
}

TEST(GltfCompression, meshopt_layouts_that_do_not_fit_are_errors)
{
    const auto expect_error = [](const std::string& key, const json& value) {
        TestFile file = meshopt_file("TRIANGLES");
        for (json& view : file.document["bufferViews"]) {
            if (view.contains("extensions") && view["extensions"][meshopt_name]["mode"] == "TRIANGLES") {
                view["extensions"][meshopt_name][key] = value;
            }
        }
        EXPECT_THROW((void)file.load(), Error) << key << " " << value;
    };
    expect_error("count", 7);
    expect_error("count", 3);
    expect_error("count", 2000000001);
    expect_error("byteStride", 3);
    expect_error("byteStride", 256);
    expect_error("filter", "OCTAHEDRAL");
    expect_error("mode", "ATTRIBUTES");
    expect_error("byteLength", 1);
    expect_error("byteLength", 100000);
    expect_error("byteOffset", 100000);
}

struct DracoStream {
    Bytes bytes;
    int position_id = 0;
    int uv_id = 0;
};

DracoStream encode_draco()
{
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(2);
    const int positions = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const int uvs = builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_UINT8);
    const float corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    const uint8_t uv[4][2] = {{0, 0}, {255, 0}, {0, 51}, {255, 51}};
    builder.SetAttributeValuesForFace(positions, draco::FaceIndex(0), corners[0], corners[1], corners[2]);
    builder.SetAttributeValuesForFace(positions, draco::FaceIndex(1), corners[2], corners[1], corners[3]);
    builder.SetAttributeValuesForFace(uvs, draco::FaceIndex(0), uv[0], uv[1], uv[2]);
    builder.SetAttributeValuesForFace(uvs, draco::FaceIndex(1), uv[2], uv[1], uv[3]);
    const auto mesh = builder.Finalize();
    draco::Encoder encoder;
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
    const auto* first = reinterpret_cast<const std::byte*>(buffer.data());
    return {.bytes = {first, first + buffer.size()},
            .position_id = static_cast<int>(mesh->attribute(positions)->unique_id()),
            .uv_id = static_cast<int>(mesh->attribute(uvs)->unique_id())};
}

TestFile draco_file()
{
    const DracoStream stream = encode_draco();
    TestFile file = triangle_file();
    file.document["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    const json positions = {{"componentType", 5126}, {"count", 4}, {"type", "VEC3"}};
    const json uvs = {{"componentType", 5121}, {"count", 4}, {"type", "VEC2"}, {"normalized", true}};
    const json indices = {{"componentType", 5123}, {"count", 6}, {"type", "SCALAR"}};
    file.attributes() = {{"POSITION", file.add_accessor(positions)}, {"TEXCOORD_0", file.add_accessor(uvs)}};
    file.primitive()["indices"] = file.add_accessor(indices);
    file.primitive()["extensions"]["KHR_draco_mesh_compression"] = {
        {"bufferView", file.add_view(stream.bytes)},
        {"attributes", {{"POSITION", stream.position_id}, {"TEXCOORD_0", stream.uv_id}}}};
    return file;
}

TEST(GltfCompression, draco)
{
    const Scene scene = draco_file().load();
    const Primitive& primitive = scene.meshes[0].primitives[0];
    ASSERT_EQ(primitive.indices.size(), 6U);
    std::vector<glm::vec3> corners;
    for (const uint32_t index : primitive.indices) {
        corners.push_back(primitive.positions[index]);
        EXPECT_EQ(primitive.uvs[0][index], glm::vec2(corners.back().x, corners.back().y * 0.2F));
    }
    const glm::vec3 sum = std::accumulate(corners.begin(), corners.end(), glm::vec3(0));
    EXPECT_EQ(sum, glm::vec3(3, 3, 0));
    EXPECT_EQ(primitive.normals[0], glm::vec3(0, 0, 1));
}

TEST(GltfCompression, draco_that_is_damaged_or_does_not_match)
{
    const std::string pointer = "test.glb#/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression";
    const auto expect_error = [&](const TestFile& file, const std::string& where) {
        try {
            (void)file.load();
            ADD_FAILURE() << "no error for " << where;
        } catch (const Error& error) {
            EXPECT_EQ(error.where(), where) << error.what();
        }
    };
    TestFile file = draco_file();
    const auto view =
        file.primitive()["extensions"]["KHR_draco_mesh_compression"]["bufferView"].get<size_t>();
    file.document["bufferViews"][view]["byteLength"] = 20;
    expect_error(file, pointer);
    file = draco_file();
    file.primitive()["extensions"]["KHR_draco_mesh_compression"]["attributes"]["POSITION"] = 77;
    expect_error(file, pointer + "/attributes/POSITION");
    file = draco_file();
    file.primitive()["extensions"]["KHR_draco_mesh_compression"]["attributes"]["POSITION"] = "x";
    expect_error(file, pointer + "/attributes/POSITION");
    file = draco_file();
    file.primitive()["extensions"]["KHR_draco_mesh_compression"]["attributes"]["NORMAL"] = 1;
    expect_error(file, pointer + "/attributes/NORMAL");
    file = draco_file();
    file.document["accessors"][file.attributes()["POSITION"].get<size_t>()]["count"] = 5;
    expect_error(file, pointer + "/attributes/POSITION");
    file = draco_file();
    file.primitive()["mode"] = 1;
    expect_error(file, "test.glb#/meshes/0/primitives/0/mode");
}

} // namespace
} // namespace estampe::gltf
