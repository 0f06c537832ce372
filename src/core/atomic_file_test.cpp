// SPDX-License-Identifier: MIT
#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <estampe/error.hpp>

#include "core/file.hpp"
#include "support/folder.hpp"

namespace estampe {
namespace {

std::string text_in(const std::filesystem::path& path)
{
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::span<const std::byte> bytes_in(const std::string& text)
{
    return std::as_bytes(std::span(text));
}

size_t count_in(const test::Folder& folder)
{
    return static_cast<size_t>(std::distance(std::filesystem::directory_iterator(folder.path()), {}));
}

TEST(AtomicFile, what_is_not_published_goes)
{
    const test::Folder folder;
    {
        const AtomicFile file = AtomicFile::file(folder / "a.txt", bytes_in("half"));
        const AtomicFile other = AtomicFile::folder(folder / "b");
        std::ofstream(other.path() / "within") << "half";
        EXPECT_EQ(text_in(file.path()), "half");
        EXPECT_EQ(count_in(folder), 2U);
    }
    EXPECT_EQ(count_in(folder), 0U);
}

TEST(AtomicFile, published_it_takes_the_place_of_the_old)
{
    const test::Folder folder;
    std::ofstream(folder / "a.txt") << "old";
    AtomicFile file = AtomicFile::file(folder / "a.txt", bytes_in("new"));
    EXPECT_EQ(text_in(folder / "a.txt"), "old");
    file.publish();
    EXPECT_EQ(text_in(folder / "a.txt"), "new");
    EXPECT_EQ(count_in(folder), 1U);
}

TEST(AtomicFile, a_name_may_be_as_long_as_the_disk_allows)
{
    const test::Folder folder;
    const std::string name(255, 'a');
    write_file_atomically(folder / name, bytes_in("all"));
    EXPECT_EQ(text_in(folder / name), "all");
}

TEST(AtomicFile, a_link_stays_and_the_file_behind_it_is_replaced)
{
    const test::Folder folder;
    std::filesystem::create_directory(folder / "far");
    std::ofstream(folder / "far/a.txt") << "old";
    std::filesystem::create_symlink("far/a.txt", folder / "link.txt");
    std::filesystem::create_symlink("far/new.txt", folder / "dangling.txt");
    write_file_atomically(folder / "link.txt", bytes_in("new"));
    write_file_atomically(folder / "dangling.txt", bytes_in("first"));
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.txt"));
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "dangling.txt"));
    EXPECT_EQ(text_in(folder / "far/a.txt"), "new");
    EXPECT_EQ(text_in(folder / "far/new.txt"), "first");
}

TEST(AtomicFile, permissions_of_the_old_file_stay)
{
    namespace fs = std::filesystem;
    const test::Folder folder;
    write_file_atomically(folder / "a.txt", bytes_in("old"));
    const fs::perms secret = fs::perms::owner_read | fs::perms::owner_write;
    ASSERT_NE(fs::status(folder / "a.txt").permissions(), secret);
    fs::permissions(folder / "a.txt", secret);
    write_file_atomically(folder / "a.txt", bytes_in("new"));
    EXPECT_EQ(text_in(folder / "a.txt"), "new");
    EXPECT_EQ(fs::status(folder / "a.txt").permissions(), secret);
}

TEST(AtomicFile, parts_that_a_killed_program_left_go)
{
    namespace fs = std::filesystem;
    const test::Folder folder;
    const auto make = [&](const std::string& name) {
        std::ofstream(folder / name) << "half";
        fs::last_write_time(folder / name, fs::file_time_type::clock::now() - std::chrono::minutes(1));
    };
    for (const char* const name :
         {".a.png.part-x1Y2z3", ".b.png.part-x1Y2z3", ".a.png.part-toolong", "a.png.part-x1Y2z3"})
        make(name);
    fs::create_directory(folder / ".a.png.part-folder");
    std::ofstream(folder / ".a.png.part-folder/within") << "half";
    fs::last_write_time(folder / ".a.png.part-folder",
                        fs::file_time_type::clock::now() - std::chrono::minutes(1));
    const AtomicFile running = AtomicFile::file(folder / "a.png", bytes_in("half"));
    fs::last_write_time(running.path(), fs::file_time_type::clock::now() - std::chrono::minutes(1));
    check_output(folder / "a.png", {});
    EXPECT_FALSE(fs::exists(folder / ".a.png.part-x1Y2z3"));
    EXPECT_FALSE(fs::exists(folder / ".a.png.part-folder"));
    EXPECT_TRUE(fs::exists(folder / ".b.png.part-x1Y2z3")) << "belongs to another output";
    EXPECT_TRUE(fs::exists(folder / ".a.png.part-toolong"));
    EXPECT_TRUE(fs::exists(folder / "a.png.part-x1Y2z3"));
    EXPECT_TRUE(fs::exists(running.path())) << "is being written";
}

TEST(AtomicFile, nowhere_to_write)
{
    const test::Folder folder;
    EXPECT_THROW((void)AtomicFile::file(folder / "none/a.txt"), Error);
    EXPECT_THROW((void)AtomicFile::file(folder.path()), Error);
    EXPECT_THROW((void)AtomicFile::folder(folder / "none/a"), Error);
}

TEST(AtomicFile, several_appear_together)
{
    const test::Folder folder;
    write_file_atomically(folder / "a.txt", bytes_in("old"));
    {
        std::vector<AtomicFile> files;
        files.push_back(AtomicFile::file(folder / "a.txt", bytes_in("new")));
        files.push_back(AtomicFile::file(folder / "b.txt", bytes_in("new")));
        files.push_back(AtomicFile::folder(folder / "c"));
        AtomicFile::publish_all(files);
        EXPECT_EQ(text_in(folder / "a.txt"), "new");
        EXPECT_EQ(text_in(folder / "b.txt"), "new");
        EXPECT_TRUE(std::filesystem::is_directory(folder / "c"));
    }
    EXPECT_EQ(count_in(folder), 3U) << "the old content is left";
}

TEST(AtomicFile, one_that_cannot_appear_holds_back_the_others)
{
    const test::Folder folder;
    write_file_atomically(folder / "a.txt", bytes_in("old"));
    std::filesystem::create_directories(folder / "full/of/something");
    {
        std::vector<AtomicFile> files;
        files.push_back(AtomicFile::file(folder / "a.txt", bytes_in("new")));
        files.push_back(AtomicFile::file(folder / "b.txt", bytes_in("new")));
        files.push_back(AtomicFile::folder(folder / "full"));
        EXPECT_THROW(AtomicFile::publish_all(files), Error);
        EXPECT_EQ(text_in(folder / "a.txt"), "old");
    }
    EXPECT_EQ(text_in(folder / "a.txt"), "old");
    EXPECT_TRUE(std::filesystem::exists(folder / "full/of/something"));
    EXPECT_EQ(count_in(folder), 2U);
}

/// Runs `work` in a child process and returns its exit status, or -1 if it crashed.
template <typename Work>
int run_apart(const Work& work)
{
    const pid_t child = fork();
    if (child == 0) {
        _exit(work());
    }
    int status = -1;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(AtomicFile, a_full_disk_leaves_nothing)
{
    const test::Folder folder;
    const int status = run_apart([&] {
        const rlimit limit{.rlim_cur = 1000, .rlim_max = 1000};
        setrlimit(RLIMIT_FSIZE, &limit);
        std::signal(SIGXFSZ, SIG_IGN);
        try {
            write_file_atomically(folder / "a.txt", bytes_in(std::string(100000, 'a')));
        } catch (const Error& error) {
            return error.where() == folder / "a.txt" ? 7 : 1;
        }
        return 2;
    });
    EXPECT_EQ(status, 7);
    EXPECT_EQ(count_in(folder), 0U);
}

TEST(AtomicFile, a_program_that_ends_takes_all_with_it)
{
    const test::Folder folder;
    const int status = run_apart([&] {
        const AtomicFile file = AtomicFile::file(folder / "a.txt", bytes_in("half"));
        const AtomicFile other = AtomicFile::folder(folder / "b");
        AtomicFile kept = AtomicFile::file(folder / "c.txt", bytes_in("whole"));
        kept.publish();
        std::ofstream(other.path() / "within") << "half";
        remove_all_pending();
        _exit(7);
        return 0;
    });
    EXPECT_EQ(status, 7);
    EXPECT_EQ(count_in(folder), 1U);
    EXPECT_EQ(text_in(folder / "c.txt"), "whole");
}

} // namespace
} // namespace estampe
