// SPDX-License-Identifier: MIT
#include "core/job_limits.hpp"

#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "core/free_memory.hpp"
#include "core/long_jobs.hpp"

namespace estampe {
namespace {

constexpr uint64_t gibibyte = uint64_t{1} << 30U;

WorkLimits memory_of(uint64_t bytes)
{
    WorkLimits limits;
    limits.max_memory_bytes = bytes;
    return limits;
}

WorkLimits time_of(double seconds)
{
    WorkLimits limits;
    limits.max_seconds = seconds;
    return limits;
}

std::string refusal(uint64_t bytes)
{
    try {
        require_memory(bytes, "drawing it", "a.glb", "use a lighter scene");
    } catch (const Error& problem) {
        return problem.what();
    }
    return "allowed";
}

TEST(JobLimits, there_is_none_by_default)
{
    EXPECT_NO_THROW(check_time());
    EXPECT_FALSE(is_time_up());
    EXPECT_FALSE(is_memory_limited());
    EXPECT_EQ(seconds_left(), std::numeric_limits<double>::infinity());
    const JobLimits none(WorkLimits{});
    EXPECT_FALSE(is_memory_limited());
    EXPECT_NO_THROW(check_time());
    const JobLimits years(time_of(1e300));
    EXPECT_NO_THROW(check_time());
}

TEST(JobLimits, memory_is_that_of_the_process_and_of_the_request)
{
    EXPECT_EQ(refusal(1), "allowed");
    const JobLimits limits(memory_of(gibibyte));
    EXPECT_EQ(refusal(1), "allowed");
    const std::string message = refusal(gibibyte);
    EXPECT_TRUE(message.starts_with("a.glb: drawing it needs 1.0 GiB of memory beside the ")) << message;
    EXPECT_NE(message.find("more than 1.0 GiB, the limit of --max-memory; use a lighter scene, or raise the "
                           "limit"),
              std::string::npos)
        << message;
    {
        const JobLimits lower(memory_of(1));
        EXPECT_NE(refusal(1), "allowed") << "small sizes count, too";
        const JobLimits higher(memory_of(2 * gibibyte));
        EXPECT_NE(refusal(1), "allowed") << "an inner limit does not raise an outer one";
    }
    EXPECT_EQ(refusal(1), "allowed");
}

TEST(JobLimits, LimitedWork_limits_the_thread_until_it_is_destroyed)
{
    {
        const LimitedWork limits(time_of(0.0));
        EXPECT_THROW(check_time(), TimeIsUp);
    }
    EXPECT_NO_THROW(check_time());
}

TEST(JobLimits, time_ends_jobs_that_report_progress)
{
    {
        const JobLimits limits(time_of(0.0));
        EXPECT_TRUE(is_time_up());
        EXPECT_EQ(seconds_left(), 0.0);
        EXPECT_THROW(check_time(), TimeIsUp);
        EXPECT_THROW(report_progress(0.5), TimeIsUp);
        const JobLimits longer(time_of(60.0));
        EXPECT_THROW(check_time(), TimeIsUp);
    }
    EXPECT_NO_THROW(check_time());
    const JobLimits limits(time_of(60.0));
    EXPECT_NO_THROW(report_progress(0.5));
    EXPECT_GT(seconds_left(), 50.0);
    const JobLimits shorter(time_of(0.0));
    try {
        check_time();
        FAIL();
    } catch (const Error& problem) {
        EXPECT_NE(std::string(problem.what()).find("after 0 s"), std::string::npos) << problem.what();
    }
}

TEST(JobLimits, are_those_of_one_thread_unless_it_hands_them_on)
{
    const JobLimits limits(time_of(0.0));
    const JobLimits::OfThread given = JobLimits::of_thread();
    std::thread([&] {
        EXPECT_FALSE(is_time_up());
        const JobLimits same(given);
        EXPECT_TRUE(is_time_up());
    }).join();
}

} // namespace
} // namespace estampe
