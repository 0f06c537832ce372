// SPDX-License-Identifier: MIT
#include "scene/pictures/picture_files.hpp"

#include <fstream>

#include <sys/stat.h>

#include <gtest/gtest.h>

#include "support/folder.hpp"

namespace estampe {
namespace {

class FindFile : public testing::Test {
protected:
    void put(const std::filesystem::path& name) const
    {
        std::filesystem::create_directories((folder_ / name).parent_path());
        std::ofstream(folder_ / name) << "x";
    }

    [[nodiscard]] std::string find(const std::string& name) const
    {
        FileFinder finder({folder_.path(), folder_ / "library"});
        const std::optional<std::filesystem::path> found = finder.find(name);
        return found ? std::filesystem::relative(*found, folder_.path()).string() : "";
    }

    test::Folder folder_;
};

TEST_F(FindFile, ByAnyCaseInEveryPartOfThePath)
{
    put("Textures/Old Oak/Wood.PNG");
    EXPECT_EQ(find("Textures/Old Oak/Wood.PNG"), "Textures/Old Oak/Wood.PNG");
    EXPECT_EQ(find("textures/old oak/wood.png"), "Textures/Old Oak/Wood.PNG");
    EXPECT_EQ(find("TEXTURES\\OLD OAK\\WOOD.png"), "Textures/Old Oak/Wood.PNG");
    EXPECT_EQ(find(".\\textures//Old%20Oak/wood.png"), "Textures/Old Oak/Wood.PNG");
    EXPECT_EQ(find("textures/wood.png"), "");
}

TEST_F(FindFile, TheExactCaseGoesFirst)
{
    put("wood.png");
    put("Wood.png");
    put("WOOD.png");
    EXPECT_EQ(find("wood.png"), "wood.png");
    EXPECT_EQ(find("Wood.png"), "Wood.png");
    EXPECT_EQ(find("wooD.png"), "WOOD.png") << "the first in the order of bytes";
}

TEST_F(FindFile, QuotesAndBlanksAroundANameDoNotCount)
{
    put("my wood.png");
    EXPECT_EQ(find("  \"my wood.png\"\r"), "my wood.png");
    EXPECT_EQ(find("'my wood.png'\t"), "my wood.png");
}

TEST_F(FindFile, PathsOfOtherMachinesByTheirLastParts)
{
    put("wood.png");
    put("maps/bark.png");
    put("library/stone.png");
    for (const char* const name : {"C:\\Users\\ann\\wood.png", "/home/ann/wood.png",
                                   "\\\\server\\disk\\wood.png", "file:///D:/ann/wood.png", "d:wood.png"})
        EXPECT_EQ(find(name), "wood.png") << name;
    EXPECT_EQ(find("C:\\project\\maps\\bark.png"), "maps/bark.png");
    EXPECT_EQ(find("E:/stone.png"), "library/stone.png");
    EXPECT_EQ(find("elsewhere/stone.png"), "library/stone.png");
}

TEST_F(FindFile, AnAbsolutePathIsNeverOpened)
{
    put("outside/wood.png");
    put("library/leaf.png");
    FileFinder finder({folder_ / "library"});
    EXPECT_FALSE(finder.find((folder_ / "outside/wood.png").string()));
    EXPECT_TRUE(finder.find("../outside/wood.png")) << "pictures beside the scene's folder are common";
}

TEST_F(FindFile, OnlyFilesThatCanBeReadToAnEnd)
{
    ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
    std::filesystem::create_symlink("/dev/zero", folder_ / "endless");
    std::filesystem::create_directory(folder_ / "folder.png");
    std::ofstream(folder_ / "empty.png");
    for (const char* const name :
         {"pipe", "endless", "folder.png", "empty.png", "/dev/zero", "../../../../../../../dev/zero",
          "../../../../../../../proc/kmsg", "..", ".", "/", "", "\"\"", "C:", "a/..", "PIPE"})
        EXPECT_EQ(find(name), "") << name;
    EXPECT_EQ(find(std::string("a\0b", 3)), "");
    EXPECT_EQ(find(std::string(100000, 'x')), "");
    std::string slashes(3000, '/');
    slashes += "wood.png";
    EXPECT_EQ(find(slashes), "");
}

} // namespace
} // namespace estampe
