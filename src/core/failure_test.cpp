// SPDX-License-Identifier: MIT
#include "core/failure.hpp"

#include <filesystem>
#include <fstream>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "support/folder.hpp"

namespace estampe {
namespace {

template <typename Exception>
std::string message_of(const Exception& exception)
{
    try {
        throw exception;
    } catch (const std::exception&) {
        return message_of_caught();
    }
}

TEST(Failure, WordsOfTheStandardLibraryAreReplaced)
{
    EXPECT_EQ(message_of(std::bad_alloc()), out_of_memory);
    EXPECT_EQ(message_of(std::length_error("vector::_M_default_append")), out_of_memory);
    const auto no_memory = std::make_error_code(std::errc::not_enough_memory);
    EXPECT_EQ(message_of(std::system_error(no_memory)), out_of_memory);
    EXPECT_EQ(message_of(std::filesystem::filesystem_error("cannot remove", "/a", no_memory)), out_of_memory);
    EXPECT_EQ(message_of(Error("is torn", "page", "glue it")), "page: is torn; glue it");
}

TEST(Failure, AFileThatCannotBeReachedIsNamed)
{
    const std::filesystem::filesystem_error problem("cannot remove", "folder/a.png",
                                                    std::make_error_code(std::errc::permission_denied));
    EXPECT_EQ(message_of(problem),
              "folder/a.png: cannot be reached: Permission denied; check the folder and its permissions");
}

const std::system_error no_resource(std::make_error_code(std::errc::resource_unavailable_try_again));

TEST(Failure, AThreadThatIsOneTooManyIsALimitOfThreads)
{
    const Error error = no_thread("no thread for it", no_resource);
    EXPECT_EQ(std::string(error.what()), "no thread for it: Resource temporarily unavailable; end other "
                                         "programs, or raise the limit of threads (ulimit -u)");
    EXPECT_NE(message_of(no_resource).find("limit of threads"), std::string::npos);
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) // these take terabytes of address space
TEST(Failure, AThreadWithoutMemoryForItsStackIsALimitOfMemory)
{
    const test::Folder folder;
    const pid_t child = fork();
    if (child == 0) {
        uint64_t pages = 0;
        std::ifstream("/proc/self/statm") >> pages;
        const auto page_bytes = static_cast<uint64_t>(sysconf(_SC_PAGESIZE));
        const rlim_t most = pages * page_bytes + (uint64_t{1} << 20U);
        const rlimit limit{.rlim_cur = most, .rlim_max = most};
        setrlimit(RLIMIT_AS, &limit);
        std::ofstream(folder / "said") << no_thread("no thread for it", no_resource).what();
        _exit(0);
    }
    int status = -1;
    waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
    std::string said;
    std::getline(std::ifstream(folder / "said"), said);
    EXPECT_TRUE(said.starts_with("no thread for it: no memory for a stack of ")) << said;
    EXPECT_TRUE(said.ends_with("raise the limit of memory (ulimit -v)")) << said;
}
#endif

} // namespace
} // namespace estampe
