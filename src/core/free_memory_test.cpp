// SPDX-License-Identifier: MIT
#include "core/free_memory.hpp"

#include <fstream>

#include <gtest/gtest.h>

#include <estampe/error.hpp>

#include "support/folder.hpp"

namespace estampe {
namespace {

constexpr uint64_t mib = 1U << 20U;

class FreeMemory : public testing::Test {
protected:
    void write(const std::string& name, const std::string& text) const
    {
        std::filesystem::create_directories((folder_ / name).parent_path());
        std::ofstream(folder_ / name) << text;
    }

    [[nodiscard]] uint64_t found_mib() const { return free_memory_bytes(folder_.path()) / mib; }

    test::Folder folder_;
};

TEST_F(FreeMemory, IsWhatTheMachineHas)
{
    EXPECT_GT(free_memory_bytes(), mib);
    EXPECT_GT(found_mib(), uint64_t{1} << 32U) << "nothing is known";
    write("proc/meminfo", "MemTotal: 9000000 kB\nMemAvailable:    2048000 kB\nSwapFree:  1024 kB\n");
    EXPECT_EQ(found_mib(), 2001U);
}

TEST_F(FreeMemory, IsLessInAGroupThatIsLimited)
{
    write("proc/meminfo", "MemAvailable: 2048000 kB\n");
    write("sys/fs/cgroup/memory.max", "max\n");
    write("sys/fs/cgroup/memory.current", "1048576\n");
    EXPECT_EQ(found_mib(), 2000U);
    write("sys/fs/cgroup/memory.max", std::to_string(300 * mib));
    write("sys/fs/cgroup/memory.current", std::to_string(200 * mib));
    EXPECT_EQ(found_mib(), 100U);
    write("sys/fs/cgroup/memory.stat", "file 1\ninactive_file " + std::to_string(50 * mib));
    EXPECT_EQ(found_mib(), 150U);
    write("sys/fs/cgroup/memory.current", std::to_string(400 * mib));
    EXPECT_EQ(found_mib(), 0U);
    write("sys/fs/cgroup/memory/memory.limit_in_bytes", "0");
    write("sys/fs/cgroup/memory/memory.usage_in_bytes", "5");
    EXPECT_EQ(found_mib(), 0U);
}

TEST_F(FreeMemory, TooLittleOfItIsSaidWithBothAmounts)
{
    EXPECT_NO_THROW(require_memory(63 * mib, "it", "here"));
    try {
        require_memory(uint64_t{1} << 60U, "a picture", "a.png", "draw a smaller one");
        FAIL();
    } catch (const Error& error) {
        const std::string message = error.what();
        EXPECT_TRUE(message.starts_with("a.png: a picture needs 1073741824.0 GiB of memory, ")) << message;
        EXPECT_TRUE(message.ends_with(" are free; draw a smaller one")) << message;
    }
    EXPECT_EQ(in_bytes(20 * mib), "20 MiB");
    EXPECT_EQ(in_bytes(1536 * mib), "1.5 GiB");
}

} // namespace
} // namespace estampe
