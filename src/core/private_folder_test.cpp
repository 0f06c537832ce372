// SPDX-License-Identifier: MIT
#include "core/file.hpp"

#include <fstream>

#include <sys/stat.h>

#include <gtest/gtest.h>

#include "support/folder.hpp"

namespace estampe {
namespace {

namespace fs = std::filesystem;

TEST(PrivateFolder, is_made_for_the_user_alone)
{
    const test::Folder folder;
    const mode_t before = umask(0);
    make_private_folder(folder / "a/b");
    umask(before);
    EXPECT_EQ(fs::status(folder / "a").permissions(), fs::perms(0700));
    EXPECT_EQ(fs::status(folder / "a/b").permissions(), fs::perms(0700));
    EXPECT_EQ(fault_of_private_folder(folder / "a/b"), "");
    EXPECT_NO_THROW(make_private_folder(folder / "a/b"));
    std::ofstream(folder / "file") << "x";
    EXPECT_THROW(make_private_folder(folder / "file/c"), fs::filesystem_error);
}

TEST(PrivateFolder, is_of_its_user_and_written_by_no_other)
{
    const test::Folder folder;
    const fs::path path = folder / "a";
    EXPECT_EQ(fault_of_private_folder(path), "") << "there is no such folder";
    make_private_folder(path);
    EXPECT_EQ(fault_of_private_folder(path, geteuid() + 1), "belongs to another user");
    for (const int mode : {0700, 0755, 0711}) {
        fs::permissions(path, fs::perms(mode));
        EXPECT_EQ(fault_of_private_folder(path), "") << mode;
    }
    for (const int mode : {0720, 0702, 0777}) {
        fs::permissions(path, fs::perms(mode));
        EXPECT_EQ(fault_of_private_folder(path), "is writable by other users") << mode;
    }
    fs::permissions(path, fs::perms(0700));
    fs::create_directory_symlink(path, folder / "link");
    EXPECT_EQ(fault_of_private_folder(folder / "link"), "is no folder");
}

} // namespace
} // namespace estampe
