// SPDX-License-Identifier: MIT
#include "piped_scene.hpp"

#include <cstring>
#include <fstream>
#include <string>
#include <thread>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <estampe/error.hpp>

#include "drawing.hpp"
#include "support/folder.hpp"

namespace estampe::app {
namespace {

constexpr const char* triangle_obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

/// A named pipe through which `bytes` are written once.
class Pipe {
public:
    Pipe(const std::filesystem::path& path, std::string bytes) : path_(path)
    {
        mkfifo(path.c_str(), 0600);
        writer_ =
            std::thread([path, bytes = std::move(bytes)] { std::ofstream(path, std::ios::binary) << bytes; });
    }

    ~Pipe() { writer_.join(); }

    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;

    [[nodiscard]] std::string name() const { return path_.string(); }

private:
    std::filesystem::path path_;
    std::thread writer_;
};

/// The message of the Error that reading a pipe with these bytes throws.
std::string problem_with(const std::filesystem::path& path, const std::string& bytes,
                         const std::string& format, uint64_t most_bytes)
{
    const Pipe pipe(path, bytes);
    try {
        static_cast<void>(scene_file(pipe.name(), format, most_bytes));
        return {};
    } catch (const Error& error) {
        return error.what();
    }
}

TEST(PipedScene, FormatsAreRecognisedByTheirBeginning)
{
    EXPECT_EQ(sniffed_format(std::string_view("glTF\x02\0\0\0", 8), 100), "glb");
    EXPECT_EQ(sniffed_format("ply\nformat ascii 1.0\n", 100), "ply");
    EXPECT_EQ(sniffed_format("ply\r\nformat ascii 1.0\r\n", 100), "ply");
    EXPECT_EQ(sniffed_format("  {\"asset\": {}}", 100), "gltf");
    EXPECT_EQ(sniffed_format("\xef\xbb\xbf{\"asset\": {}}", 100), "gltf");
    EXPECT_EQ(sniffed_format("Kaydara FBX Binary  ", 100), "fbx");
    EXPECT_EQ(sniffed_format("<?xml version=\"1.0\"?>\n<COLLADA xmlns=\"\">", 100), "dae");
    EXPECT_EQ(sniffed_format("solid a\nfacet normal 0 0 1\n", 100), "stl");
    EXPECT_EQ(sniffed_format("<svg>", 100), "");
    EXPECT_EQ(sniffed_format("PLY\nformat ascii 1.0\n", 100), "ply");
    EXPECT_EQ(sniffed_format("", 0), "");
    std::string stl(84, '\0');
    stl[80] = 2;
    EXPECT_EQ(sniffed_format(stl, 84 + 100), "stl");
    EXPECT_EQ(sniffed_format(stl, 84 + 99), "");
}

TEST(PipedScene, ObjIsRecognisedByItsFirstStatement)
{
    EXPECT_EQ(sniffed_format(triangle_obj, 100), "obj");
    for (const char* const statement :
         {"mtllib a.mtl", "o body", "g", "g a b", "v 1.5 0 -2", "vn 0 0 1", "vt 0,5 1", "usemtl red", "s off",
          "s 1", "f 1/2/3 2/2/3 3/2/3", "v\t1e3 2 3"}) {
        EXPECT_EQ(sniffed_format(statement, 100), "obj") << statement;
        EXPECT_EQ(sniffed_format(fmt::format("\xef\xbb\xbf# Blender\r\n\r\n  #\n\t{}\n", statement), 100),
                  "obj")
            << statement;
    }
    EXPECT_EQ(sniffed_format(std::string(30000, '#') + "\nv 0 0 0\n", 40000), "obj") << "a long comment";
    const std::u16string wide = u"\uFEFF# x\nv 0 0 0\n";
    EXPECT_EQ(sniffed_format({reinterpret_cast<const char*>(wide.data()), 2 * wide.size()}, 100), "obj");
    for (const char* const other :
         {"# only a comment\n", "#VRML V2.0 utf8\nShape {}\n", "#!/bin/sh\nset -e\n", "version 1\n",
          "v is a letter\n", "f = open()\n", "OFF\n3 1 0\n", "0 0 0\n1 1 1\n"})
        EXPECT_EQ(sniffed_format(other, 100), "") << other;
}

TEST(PipedScene, TextOfStlIsRecognisedInAnyCase)
{
    EXPECT_EQ(sniffed_format("SOLID BOX\r\nFACET NORMAL 0 0 1\r\n", 100), "stl");
    EXPECT_EQ(sniffed_format("\n  Solid\n  Facet normal 0 0 1\n", 100), "stl");
    EXPECT_EQ(sniffed_format("solid empty\nendsolid empty\nsolid b\n", 100), "stl");
    EXPECT_EQ(sniffed_format("solid\nas a rock\n", 100), "");
    EXPECT_EQ(sniffed_format(std::string_view("solid\nfacet\0\0", 13), 100), "") << "cut binary";
}

TEST(PipedScene, ANamedPipeIsReadOnceAndByItsExtensionOrFormat)
{
    const test::Folder folder;
    for (const auto& [name, format] : {std::pair("a.obj", ""), std::pair("pipe", "obj")}) {
        DrawOptions draw;
        const Pipe pipe(folder / name, triangle_obj);
        draw.scene = pipe.name();
        draw.input_format = format;
        ASSERT_TRUE(is_piped(draw.scene));
        EXPECT_EQ(load_scene_of(draw).meshes.size(), 1U);
        EXPECT_EQ(load_scene_of(draw).meshes.size(), 1U) << "what was read is kept";
    }
}

TEST(PipedScene, MessagesNameWhatWasTyped)
{
    const test::Folder folder;
    const Pipe pipe(folder / "broken.gltf", "{\"asset\": ");
    DrawOptions draw;
    draw.scene = pipe.name();
    try {
        static_cast<void>(load_scene_of(draw));
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()).find(pipe.name()), 0U) << error.what();
        EXPECT_EQ(std::string(error.what()).find("piped."), std::string::npos) << error.what();
    }
}

/// All warnings and errors, one per line, of reading a scene through a pipe.
std::string told_of(const std::filesystem::path& path, const std::string& bytes)
{
    const Pipe pipe(path, bytes);
    DrawOptions draw;
    draw.scene = pipe.name();
    try {
        return fmt::format("{}\n", fmt::join(load_scene_of(draw).warnings, "\n"));
    } catch (const Error& error) {
        return error.what();
    }
}

TEST(PipedScene, MissingFilesAreNamedAsTheSceneNamesThem)
{
    const test::Folder folder;
    const std::string obj = told_of(folder / "a", std::string("mtllib gone/a.mtl\n") + triangle_obj);
    const std::string ply = told_of(
        folder / "b", "ply\nformat ascii 1.0\ncomment TextureFile gone/a.png\nelement vertex 3\n"
                      "property float x\nproperty float y\nproperty float z\nproperty float s\n"
                      "property float t\nelement face 1\nproperty list uchar int vertex_index\nend_header\n"
                      "0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n");
    const std::string gltf =
        told_of(folder / "c", R"({"asset": {"version": "2.0"}, "images": [{"uri": "gone/a.png"}], "textures":
            [{"source": 0}], "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
            "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0],
            "max": [0, 0, 0]}, {"componentType": 5126, "type": "VEC2", "count": 3}], "meshes":
            [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}]}],
            "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}], "scene": 0})");
    const std::string own_folder = folder.path().string();
    for (std::string told : {obj, ply, gltf}) {
        EXPECT_NE(told.find("gone/a."), std::string::npos) << told;
        EXPECT_NE(told.find("current folder"), std::string::npos) << told;
        EXPECT_EQ(told.find("beside the scene"), std::string::npos) << told;
        for (size_t at = told.find(own_folder); at != std::string::npos; at = told.find(own_folder)) {
            told.erase(at, own_folder.size()); // the temporary folder of the pipe
        }
        EXPECT_EQ(told.find(own_folder.substr(0, own_folder.rfind('/') + 1)), std::string::npos) << told;
    }
    const std::string buffer = told_of(
        folder / "d", R"({"asset": {"version": "2.0"}, "buffers": [{"uri": "gone.bin", "byteLength": 4}]})");
    EXPECT_NE(buffer.find(": gone.bin: "), std::string::npos) << buffer;
}

TEST(PipedScene, WhatCannotBeAcceptedIsSaid)
{
    const test::Folder folder;
    constexpr uint64_t most = 1000;
    EXPECT_NE(problem_with(folder / "a", "OFF\n3 1 0\n", "", most).find("give --input-format, one of glb"),
              std::string::npos);
    EXPECT_NE(problem_with(folder / "b", "", "obj", most).find("is empty"), std::string::npos);
    EXPECT_NE(problem_with(folder / "c.obj", std::string(1001, '#'), "", most).find("is longer than"),
              std::string::npos);
    EXPECT_EQ(problem_with(folder / "d.obj", std::string(1000, '#'), "", most), "");
    std::ofstream(folder / "e.obj") << triangle_obj;
    EXPECT_FALSE(is_piped((folder / "e.obj").string()));
    EXPECT_EQ(scene_file((folder / "e.obj").string(), ""), folder / "e.obj");
    EXPECT_THROW(static_cast<void>(scene_file((folder / "e.obj").string(), "ply")), Error);
}

TEST(PipedScene, TheTemporaryFolderGoes)
{
    const test::Folder folder;
    std::filesystem::path file;
    {
        const Pipe pipe(folder / "a.obj", triangle_obj);
        file = scene_file(pipe.name(), "");
    }
    EXPECT_TRUE(std::filesystem::exists(file));
    remove_piped_scenes();
    EXPECT_FALSE(std::filesystem::exists(file.parent_path()));
    EXPECT_TRUE(std::filesystem::exists(std::filesystem::current_path())) << "links went, not files";
}

} // namespace
} // namespace estampe::app
