// SPDX-License-Identifier: MIT
#include "viewer/reload.hpp"

#include <algorithm>
#include <fstream>

#include <gtest/gtest.h>

#include "support/folder.hpp"

namespace estampe::viewer {
namespace {

TEST(FileWatch, TellsOnceOfAFileThatChangedAndIsWhole)
{
    const test::Folder folder;
    const std::filesystem::path file = folder.path() / "a.toml";
    std::ofstream(file) << "1";
    FileWatch watch;
    watch.watch({file});
    EXPECT_TRUE(watch.changed().empty());
    std::ofstream(file) << "22";
    EXPECT_TRUE(watch.changed().empty()) << "it may still be being written";
    EXPECT_EQ(watch.changed(), std::vector{file});
    EXPECT_TRUE(watch.changed().empty());
    std::filesystem::remove(file);
    EXPECT_TRUE(watch.changed().empty());
    EXPECT_TRUE(watch.changed().empty());
    std::ofstream(file) << "333";
    static_cast<void>(watch.changed());
    EXPECT_EQ(watch.changed(), std::vector{file}) << "editors replace files";
}

TEST(FileWatch, AScenesFilesAreThoseItMayBeMadeOf)
{
    const test::Folder folder;
    std::filesystem::create_directories(folder.path() / "textures" / "deep");
    for (const char* name : {"a.gltf", "a.bin", "notes.txt", "textures/brick.png", "textures/deep/far.png"}) {
        std::ofstream(folder.path() / name) << "x";
    }
    std::vector<std::filesystem::path> files = files_of_scene(folder.path() / "a.gltf");
    std::ranges::sort(files);
    EXPECT_EQ(files, (std::vector<std::filesystem::path>{folder.path() / "a.bin", folder.path() / "a.gltf",
                                                         folder.path() / "textures/brick.png"}));
}

} // namespace
} // namespace estampe::viewer
