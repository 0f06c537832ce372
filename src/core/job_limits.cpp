// SPDX-License-Identifier: MIT
#include "core/job_limits.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace estampe {
namespace {

thread_local JobLimits::OfThread current;

JobLimits::Clock::time_point end_of(double seconds)
{
    // A longer time is no limit, and could not be added to a time point.
    constexpr double most_s = 1e8;
    if (!(seconds < most_s)) {
        return JobLimits::Clock::time_point::max();
    }
    return JobLimits::Clock::now() + std::chrono::duration_cast<JobLimits::Clock::duration>(
                                         std::chrono::duration<double>(std::max(seconds, 0.0)));
}

} // namespace

JobLimits::JobLimits(const WorkLimits& limits) : before_(current)
{
    current.memory_bytes = std::min(current.memory_bytes, limits.max_memory_bytes);
    if (const Clock::time_point end = end_of(limits.max_seconds); end < current.end) {
        current.end = end;
        current.seconds = limits.max_seconds;
    }
}

JobLimits::JobLimits(const OfThread& limits) : before_(current)
{
    current = limits;
}

JobLimits::~JobLimits()
{
    current = before_;
}

JobLimits::OfThread JobLimits::of_thread()
{
    return current;
}

LimitedWork::LimitedWork(const WorkLimits& limits) : limits_(std::make_unique<JobLimits>(limits)) {}

LimitedWork::~LimitedWork() = default;

bool is_time_up()
{
    return current.end != JobLimits::Clock::time_point::max() && JobLimits::Clock::now() >= current.end;
}

void check_time()
{
    if (is_time_up()) {
        throw TimeIsUp(
            fmt::format("the work is not done after {:g} s, the limit of --max-seconds", current.seconds), {},
            "raise the limit, or ask for less: fewer pixels, samples or frames");
    }
}

double seconds_left()
{
    if (current.end == JobLimits::Clock::time_point::max()) {
        return std::numeric_limits<double>::infinity();
    }
    return std::max(std::chrono::duration<double>(current.end - JobLimits::Clock::now()).count(), 0.0);
}

bool is_memory_limited()
{
    return current.memory_bytes != std::numeric_limits<uint64_t>::max();
}

} // namespace estampe
