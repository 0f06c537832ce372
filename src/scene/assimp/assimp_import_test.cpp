// SPDX-License-Identifier: MIT
#include "scene/assimp/assimp_import.hpp"

#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include <sys/stat.h>

#include <gtest/gtest.h>

#include <estampe/error.hpp>

#include "support/folder.hpp"

namespace estampe {
namespace {

class AssimpImport : public testing::Test {
protected:
    std::filesystem::path write(const std::string& name, const std::string& content) const
    {
        std::ofstream(folder_ / name, std::ios::binary) << content;
        return folder_ / name;
    }

    Scene load(const std::string& name, const std::string& content) const
    {
        return load_with_assimp(write(name, content));
    }

    void expect_error(const std::string& name, const std::string& content) const
    {
        try {
            const Scene scene = load(name, content);
            ADD_FAILURE() << name << " was read: " << scene.meshes.size() << " meshes";
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        }
    }

    /// Whatever comes of it, it is an Error or a scene that is sound.
    void expect_sound_or_error(const std::string& name, const std::string& content) const
    {
        try {
            const Scene scene = load(name, content);
            for (const Mesh& mesh : scene.meshes)
                for (const Primitive& primitive : mesh.primitives) {
                    for (const uint32_t index : primitive.indices)
                        ASSERT_LT(index, primitive.positions.size());
                    for (const glm::vec3& p : primitive.positions)
                        ASSERT_TRUE(std::isfinite(p.x + p.y + p.z)) << name;
                }
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
        }
    }

    test::Folder folder_;
};

const std::string cube_corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n";
const std::string cube_faces = "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

TEST_F(AssimpImport, ObjCubeHasHardEdgesAndTwoSides)
{
    const Scene scene = load("cube.obj", cube_corners + cube_faces);
    ASSERT_EQ(scene.meshes.size(), 1U);
    const Primitive& cube = scene.meshes[0].primitives.at(0);
    EXPECT_EQ(cube.indices.size(), 36U);
    EXPECT_EQ(cube.positions.size(), 24U);
    EXPECT_TRUE(scene.materials.at(cube.material).double_sided);
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_EQ(scene_bounds(scene, pose_scene(scene, 0.0)).max, glm::dvec3(1.0));
}

TEST_F(AssimpImport, ObjKeepsNormalsAndTurnsTexturesOver)
{
    const Scene scene = load("tri.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0.25\nvt 1 0.25\nvt 0 1\nvn 0 1 0\n"
                                        "f 1/1/1 2/2/1 3/3/1\n");
    const Primitive& triangle = scene.meshes.at(0).primitives.at(0);
    EXPECT_EQ(triangle.normals.at(0), glm::vec3(0, 1, 0));
    EXPECT_FLOAT_EQ(triangle.uvs[0].at(0).y, 0.75F);
}

TEST_F(AssimpImport, ObjMaterialsAndMissingTexture)
{
    write("m.mtl", "newmtl glass\nKd 0.2 0.4 0.6\nd 0.5\nnewmtl wood\nKd 0 0 0\nmap_Kd C:\\old\\wood.png\n");
    const Scene scene =
        load("m.obj", "mtllib m.mtl\n" + cube_corners + "usemtl glass\nf 1 2 3\nusemtl wood\nf 5 6 7\n");
    const auto named = [&scene](const std::string& name) {
        for (const Material& material : scene.materials)
            if (material.name == name)
                return material;
        ADD_FAILURE() << name;
        return Material{};
    };
    EXPECT_EQ(named("glass").alpha_mode, AlphaMode::blend);
    EXPECT_EQ(named("glass").base_color, glm::vec4(0.2F, 0.4F, 0.6F, 0.5F));
    EXPECT_EQ(named("wood").base_color, glm::vec4(1.0F));
    ASSERT_LT(named("wood").base_color_texture.texture, scene.textures.size());
    EXPECT_EQ(scene.textures[0].image, (Image{.width = 1, .height = 1, .rgba = {255, 255, 255, 255}}));
    ASSERT_EQ(scene.warnings.size(), 1U);
    EXPECT_NE(scene.warnings[0].find("wood.png"), std::string::npos);
}

TEST_F(AssimpImport, TextureIsFoundBesideTheFile)
{
    save_png({.width = 2, .height = 1, .rgba = {1, 2, 3, 255, 4, 5, 6, 255}}, folder_ / "wood.png");
    write("t.mtl", "newmtl wood\nmap_Kd C:\\old\\wood.png\n");
    const Scene scene = load("t.obj", "mtllib t.mtl\n" + cube_corners + "usemtl wood\nf 1 2 3\n");
    ASSERT_EQ(scene.textures.size(), 1U);
    EXPECT_EQ(scene.textures[0].image.width, 2U);
    EXPECT_TRUE(scene.warnings.empty());
}

const std::string ply_head = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                             "property float z\n";
const std::string ply_faces = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";

TEST_F(AssimpImport, PipesAndDevicesBesideAFileAreNotWaitedFor)
{
    ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
    std::filesystem::create_symlink("/dev/zero", folder_ / "endless");
    std::filesystem::create_directory(folder_ / "folder");
    const auto begun = std::chrono::steady_clock::now();
    for (const std::string name : {"pipe", "endless", "folder", "/dev/zero", "../../../../../dev/zero",
                                   "../../../../../proc/kmsg", "/proc/self/mem"}) {
        const Scene scene = load("cube.obj", "mtllib " + name + "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
        EXPECT_EQ(scene.meshes.size(), 1U) << name;
        write("painted.mtl", "newmtl paint\nmap_Kd " + name + "\n");
        const Scene painted = load("cube.obj", "mtllib painted.mtl\nusemtl paint\nv 0 0 0\nv 1 0 0\n"
                                               "v 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n");
        EXPECT_EQ(painted.textures.at(0).image.width, 1U) << name;
    }
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begun;
    EXPECT_LT(passed.count(), 60.0) << "seconds; a single reading is given up after 120";
}

TEST_F(AssimpImport, PlyAndStlAreRead)
{
    const Scene ply = load("t.ply", ply_head + ply_faces + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    EXPECT_EQ(ply.meshes.at(0).primitives.at(0).normals.at(0), glm::vec3(0, 0, 1));
    const Scene stl = load("t.stl", "solid t\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                                    "vertex 0 1 0\nendloop\nendfacet\nendsolid t\n");
    EXPECT_EQ(stl.meshes.at(0).primitives.at(0).indices.size(), 3U);
}

std::string binary_stl(uint32_t said, uint32_t written)
{
    std::string bytes(80, ' ');
    bytes.append(reinterpret_cast<const char*>(&said), 4);
    const float facet[12] = {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0};
    for (uint32_t i = 0; i < written; ++i) {
        bytes.append(reinterpret_cast<const char*>(facet), sizeof(facet));
        bytes.append(2, '\0');
    }
    return bytes;
}

TEST_F(AssimpImport, BinaryStlIsReadAndItsLiesAreNot)
{
    EXPECT_EQ(load("b.stl", binary_stl(2, 2)).meshes.at(0).primitives.at(0).indices.size(), 6U);
    expect_error("short.stl", binary_stl(3, 2));
    expect_error("absurd.stl", binary_stl(0x80000000U, 1));
    expect_error("none.stl", binary_stl(0, 0));
    expect_sound_or_error("head.stl", binary_stl(1, 1).substr(0, 60));
}

TEST_F(AssimpImport, MissingFileIsNamed)
{
    try {
        (void)load_with_assimp(folder_ / "absent.obj");
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("absent.obj"), std::string::npos);
    }
    EXPECT_THROW((void)load_with_assimp(folder_.path()), Error);
}

TEST_F(AssimpImport, BrokenObjFiles)
{
    expect_error("empty.obj", "");
    expect_error("blank.obj", "\n\n");
    expect_error("no_faces.obj", cube_corners);
    expect_error("all_nan.obj", "v nan nan nan\nv nan 0 0\nv 0 nan 0\nf 1 2 3\n");
    expect_sound_or_error("beyond.obj", "v 0 0 0\nv 1 0 0\nf 1 2 99\n");
    expect_sound_or_error("zero.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n");
    expect_sound_or_error("negative.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -9\n");
    expect_sound_or_error("huge_index.obj", "v 0 0 0\nf 99999999999999999999 1 1\n");
    expect_sound_or_error("words.obj", "v one two three\nf a b c\n");
    expect_sound_or_error("cut.obj", (cube_corners + cube_faces).substr(0, 140));
    std::string noise(5000, '\0');
    for (size_t i = 0; i < noise.size(); ++i)
        noise[i] = static_cast<char>((i * 2654435761U) >> 13);
    expect_error("noise.obj", noise);
    expect_sound_or_error("half_noise.obj", cube_corners + cube_faces + noise);
}

TEST_F(AssimpImport, OneBadFaceLeavesTheOthers)
{
    const Scene scene =
        load("spoiled.obj", cube_corners + "v nan 0 0\nv 1e39 0 0\n" + cube_faces + "f 1 2 9\nf 1 2 10\n");
    EXPECT_EQ(scene.meshes.at(0).primitives.at(0).indices.size(), 36U);
    ASSERT_EQ(scene.warnings.size(), 1U);
    EXPECT_NE(scene.warnings[0].find("2 faces"), std::string::npos) << scene.warnings[0];
}

TEST_F(AssimpImport, BrokenPlyFiles)
{
    expect_error("empty.ply", "");
    expect_error("noise.ply", "\x01\x02\x03 not a ply");
    expect_error("head.ply", ply_head);
    expect_error("no_vertices.ply", ply_head + ply_faces);
    expect_sound_or_error("cut.ply", ply_head + ply_faces + "0 0 0\n1 0 0\n");
    expect_sound_or_error("beyond.ply", ply_head + ply_faces + "0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n");
    expect_sound_or_error("negative.ply", ply_head + ply_faces + "0 0 0\n1 0 0\n0 1 0\n3 0 1 -2\n");
    expect_sound_or_error("nan.ply", ply_head + ply_faces + "nan 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    expect_error("absurd.ply",
                 "ply\nformat binary_little_endian 1.0\nelement vertex 2147483647\nproperty float x\n"
                 "property float y\nproperty float z\nend_header\n0000");
}

TEST_F(AssimpImport, BrokenFbxAndDaeFiles)
{
    expect_error("empty.fbx", "");
    expect_error("noise.fbx", "Kaydara FBX Binary  \x00\x1a\x00 and then nothing of use");
    expect_error("empty.dae", "");
    expect_error("cut.dae", "<?xml version=\"1.0\"?><COLLADA version=\"1.4.1\"><library_geometries>");
    expect_error("hollow.dae", "<?xml version=\"1.0\"?><COLLADA version=\"1.4.1\"></COLLADA>");
}

} // namespace
} // namespace estampe
