// SPDX-License-Identifier: MIT
#include "core/read_scope.hpp"

#include <cerrno>
#include <fstream>
#include <string>

#include <fcntl.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "core/file.hpp"
#include "support/folder.hpp"

namespace estampe {
namespace {

/// A folder `in` that strangers filled, beside a file that they must not read.
class Scoped : public testing::TestWithParam<ScopeWalk> {
protected:
    Scoped()
    {
        std::filesystem::create_directories(folder_ / "in/sub");
        std::filesystem::create_directories(folder_ / "inner");
        for (const char* name : {"secret", "in/a", "in/sub/b", "inner/c"}) {
            std::ofstream(folder_ / name) << name;
        }
        std::filesystem::create_symlink("../secret", folder_ / "in/link");
        std::filesystem::create_symlink("a", folder_ / "in/alias");
        std::filesystem::create_symlink("..", folder_ / "in/up");
        std::filesystem::create_symlink(folder_ / "in", folder_ / "to_in");
    }

    /// Opens a file and returns "open", "missing" or "outside".
    [[nodiscard]] std::string open(const std::filesystem::path& path, const ReadScope& scope,
                                   int flags = O_RDONLY) const
    {
        try {
            const int opened = open_to_read(path, scope, flags, GetParam());
            if (opened < 0) {
                return errno == ENOENT ? "missing" : "failed";
            }
            close(opened);
            return "open";
        } catch (const OutsideScope& problem) {
            EXPECT_NE(std::string(problem.what()).find("--confine"), std::string::npos);
            return "outside";
        }
    }

    [[nodiscard]] std::string open(const std::string& name) const
    {
        return open(folder_ / name, {{folder_ / "in"}});
    }

    test::Folder folder_;
};

TEST_P(Scoped, files_below_the_folder_open)
{
    EXPECT_EQ(open("in/a"), "open");
    EXPECT_EQ(open("in/./sub//b"), "open");
    EXPECT_EQ(open("in/none"), "missing");
    EXPECT_EQ(open("in/none/none"), "missing");
    EXPECT_EQ(open(folder_ / "in", {{folder_ / "in"}}, O_RDONLY | O_DIRECTORY), "open");
}

TEST_P(Scoped, nothing_else_opens)
{
    for (const char* name : {"secret", "in/../secret", "in/sub/../a", "in/link", "in/alias", "in/up/secret",
                             "in/up/in/a", "inner/c", "to_in/a", "none"}) {
        EXPECT_EQ(open(name), "outside") << name;
        EXPECT_EQ(open(folder_ / name, {{folder_ / "in"}}, O_PATH), "outside") << name;
    }
    EXPECT_EQ(open(std::filesystem::path("/proc/self/root") / (folder_ / "in/a").relative_path(),
                   {{folder_ / "in"}}),
              "outside");
}

TEST_P(Scoped, the_folder_itself_is_what_its_name_refers_to)
{
    EXPECT_EQ(open(folder_ / "to_in/a", {{folder_ / "to_in"}}), "open");
    EXPECT_EQ(open(folder_ / "in/../in/a", {{folder_ / "in/../in"}}), "open");
    EXPECT_EQ(open(folder_ / "none/a", {{folder_ / "none"}}), "missing");
    EXPECT_EQ(open("no_such_file", {{"."}}), "missing");
    EXPECT_EQ(open("no_such_file", {{""}}), "missing");
}

TEST_P(Scoped, one_of_several_folders_is_enough)
{
    const ReadScope scope{{folder_ / "inner", folder_ / "in", folder_ / "in/up"}};
    EXPECT_EQ(open(folder_ / "in/a", scope), "open");
    EXPECT_EQ(open(folder_ / "inner/c", scope), "open");
    EXPECT_EQ(open(folder_ / "in/up/secret", scope), "open") << "the user named the folder in/up";
    EXPECT_EQ(open(folder_ / "secret", scope), "outside");
}

TEST_P(Scoped, without_a_limit_links_are_followed)
{
    EXPECT_EQ(open(folder_ / "in/link", {}), "open");
    EXPECT_EQ(open(folder_ / "in/../secret", {}), "open");
}

INSTANTIATE_TEST_SUITE_P(Walks, Scoped, testing::Values(ScopeWalk::automatic, ScopeWalk::by_parts));

TEST(ReadScope, files_are_read_within_it)
{
    const test::Folder folder;
    std::filesystem::create_directory(folder / "in");
    std::ofstream(folder / "secret") << "secret";
    std::ofstream(folder / "in/a") << "a";
    std::filesystem::create_symlink("../secret", folder / "in/link");
    const ReadScope scope = ReadScope::beside(folder / "in/a");
    EXPECT_EQ(read_file(folder / "in/a", any_length, scope).size(), 1U);
    EXPECT_EQ(read_file_start(folder / "in/a", 9, scope).size(), 1U);
    EXPECT_THROW(static_cast<void>(read_file(folder / "in/link", any_length, scope)), OutsideScope);
    EXPECT_THROW(static_cast<void>(read_file_start(folder / "in/link", 9, scope)), OutsideScope);
    EXPECT_EQ(read_file(folder / "in/link").size(), 6U);
    EXPECT_EQ(ReadScope::beside("scene.glb"), (ReadScope{{"."}}));
}

TEST(ReadScope, names_in_files_are_checked_as_they_are_written)
{
    const ReadScope scope{{"."}};
    for (const char* name : {"../a", "a/../b", "..", "a\\..\\b", "/etc/passwd", "\\a", "a/.."}) {
        EXPECT_THROW(require_inside(name, scope, "style.toml:1:1"), OutsideScope) << name;
        EXPECT_NO_THROW(require_inside(name, {}, "style.toml:1:1")) << name;
    }
    for (const char* name : {"a", "a/b", "..a", "a..", "a/...", ".hidden", ""}) {
        EXPECT_NO_THROW(require_inside(name, scope, "style.toml:1:1")) << name;
    }
}

} // namespace
} // namespace estampe
