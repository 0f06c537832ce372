// SPDX-License-Identifier: MIT
#include "piped_scene.hpp"

#include <cstring>
#include <fstream>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <estampe/error.hpp>

#include "drawing.hpp"
#include "support/folder.hpp"

namespace estampe::app {
namespace {

constexpr const char* triangle_obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

/// A named pipe into which `bytes` are written once.
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
    EXPECT_EQ(sniffed_format(triangle_obj, 100), "");
    EXPECT_EQ(sniffed_format("", 0), "");
    std::string stl(84, '\0');
    stl[80] = 2;
    EXPECT_EQ(sniffed_format(stl, 84 + 100), "stl");
    EXPECT_EQ(sniffed_format(stl, 84 + 99), "");
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

TEST(PipedScene, WhatCannotBeAcceptedIsSaid)
{
    const test::Folder folder;
    constexpr uint64_t most = 1000;
    EXPECT_NE(problem_with(folder / "a", triangle_obj, "", most).find("give --input-format, one of glb"),
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
