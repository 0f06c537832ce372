// SPDX-License-Identifier: MIT
// Changes valid OBJ, PLY and STL files at random: each must load as a valid scene or throw Error, and never
// anything else.

#include <cmath>
#include <cstring>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <estampe/error.hpp>

#include "scene/importers.hpp"

namespace estampe {
namespace {

using Reader = std::function<Scene(std::span<const std::byte>, const std::string&)>;

void expect_sound(const Scene& scene)
{
    for (const Node& node : scene.nodes)
        ASSERT_TRUE(node.mesh == no_index || node.mesh < scene.meshes.size());
    for (const Mesh& mesh : scene.meshes) {
        for (const Primitive& primitive : mesh.primitives) {
            ASSERT_LT(primitive.material, scene.materials.size());
            ASSERT_FALSE(primitive.indices.empty());
            const size_t corners = primitive.topology == Topology::triangles ? 3
                                   : primitive.topology == Topology::lines   ? 2
                                                                             : 1;
            ASSERT_EQ(primitive.indices.size() % corners, 0U);
            for (const uint32_t index : primitive.indices)
                ASSERT_LT(index, primitive.positions.size());
            for (const glm::vec3& position : primitive.positions)
                ASSERT_TRUE(std::isfinite(position.x + position.y + position.z));
            if (primitive.topology == Topology::triangles) {
                ASSERT_EQ(primitive.normals.size(), primitive.positions.size());
            }
            for (const glm::vec3& normal : primitive.normals)
                ASSERT_NEAR(glm::length(normal),
                            primitive.topology == Topology::triangles ? 1.0F : glm::length(normal), 1e-3F);
            ASSERT_TRUE(primitive.colors.empty() || primitive.colors.size() == primitive.positions.size());
            ASSERT_TRUE(primitive.uvs[0].empty() || primitive.uvs[0].size() == primitive.positions.size());
        }
    }
}

void mutate(const std::vector<std::string>& good, const Reader& read, const std::string& name)
{
    std::mt19937 random(20211011);
    int loaded = 0;
    int refused = 0;
    for (int round = 0; round < 6000; ++round) {
        std::string file = good[random() % good.size()];
        for (uint32_t changes = random() % 4 + 1; changes > 0; --changes) {
            const size_t at = random() % file.size();
            switch (random() % 4) {
            case 0:
                file[at] = static_cast<char>(random() & 0xFF);
                break;
            case 1: // words mostly remain words
                file[at] = "0123456789-./ \nefv"[random() % 18];
                break;
            case 2:
                file.erase(at, random() % 8 + 1);
                break;
            default:
                file.insert(at, file.substr(random() % file.size(), random() % 16));
            }
            if (file.empty())
                file = "x";
        }
        if (random() % 8 == 0)
            file.resize(random() % file.size() + 1);
        try {
            expect_sound(read(std::as_bytes(std::span(file)), name));
            ++loaded;
        } catch (const Error& error) {
            EXPECT_EQ(error.where().find(name), 0U) << error.what();
            ++refused;
        }
    }
    EXPECT_GT(loaded, 100);
    EXPECT_GT(refused, 10);
}

template <typename Value>
void put(std::string& bytes, const std::vector<Value>& values)
{
    const size_t size = bytes.size();
    bytes.resize(size + values.size() * sizeof(Value));
    std::memcpy(bytes.data() + size, values.data(), values.size() * sizeof(Value));
}

TEST(Mutation, Obj)
{
    mutate(
        {"mtllib a.mtl\no thing\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nv 0 1 0 1 1 1\nv 0.2 0.2 1e0 1 "
         "1 1\n"
         "vt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\nusemtl red\ns 1\nf 1/1/1 2/2/1 3/3/1 4/1/1\ns off\nf -5 -4 -1\n"
         "f 1//1 2//1 5//1\ng part\nf 1 2 3 4 5 \\\n 1\nl 1 2 3\np 4 5\n"},
        load_obj_bytes, "mutated.obj");
}

TEST(Mutation, Ply)
{
    const std::string header =
        " 1.0\ncomment TextureFile a.png\nelement vertex 4\nproperty float x\nproperty float y\n"
        "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
        "element face 2\nproperty list uchar int vertex_indices\n"
        "property list uchar float texcoord\nelement edge 1\nproperty int vertex1\n"
        "property int vertex2\nend_header\n";
    std::string binary = "ply\nformat binary_little_endian" + header;
    for (const float corner : {0.0F, 1.0F, 2.0F, 3.0F}) {
        put<float>(binary, {corner, corner * corner, 0.0F});
        put<uint8_t>(binary, {1, 2, 3});
    }
    put<uint8_t>(binary, {3});
    put<int32_t>(binary, {0, 1, 2});
    put<uint8_t>(binary, {0, 4});
    put<int32_t>(binary, {0, 1, 2, 3});
    put<uint8_t>(binary, {8});
    put<float>(binary, {0, 0, 1, 0, 1, 1, 0, 1});
    put<int32_t>(binary, {0, 3});
    mutate(
        {binary,
         "ply\nformat ascii" + header +
             "0 0 0 1 2 3\n1 0 0 4 5 6\n1 1 0 7 8 9\n0 1 0 255 0 0\n3 0 1 2 0\n4 0 1 2 3 8 0 0 1 0 1 1 0 1\n"
             "0 3\n"},
        load_ply_bytes, "mutated.ply");
}

TEST(Mutation, Stl)
{
    std::string binary(80, ' ');
    put<uint32_t>(binary, {2});
    for (int facet = 0; facet < 2; ++facet) {
        put<float>(binary, {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0});
        put<uint16_t>(binary, {0x8123});
    }
    mutate(
        {binary,
         "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
         "0\nendloop\nendfacet\n"
         "endsolid a\nsolid b\nfacet normal 0 0 1\nouter loop\nvertex 0 0 1\nvertex 1 0 1\nvertex 0 1e0 1\n"
         "endloop\nendfacet\nendsolid b\n"},
        load_stl_bytes, "mutated.stl");
}

} // namespace
} // namespace estampe
