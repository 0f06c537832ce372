// SPDX-License-Identifier: MIT
#include <csignal>
#include <fstream>
#include <iterator>
#include <string>

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

TEST(AtomicFile, nowhere_to_write)
{
    const test::Folder folder;
    EXPECT_THROW((void)AtomicFile::file(folder / "none/a.txt"), Error);
    EXPECT_THROW((void)AtomicFile::file(folder.path()), Error);
    EXPECT_THROW((void)AtomicFile::folder(folder / "none/a"), Error);
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
