// SPDX-License-Identifier: MIT
#pragma once

// The limits on memory and time that apply to the current thread.

#include <chrono>
#include <cstdint>
#include <limits>

#include <estampe/error.hpp>
#include <estampe/work_limits.hpp>

namespace estampe {

/// Reports that a job has taken longer than WorkLimits::max_seconds.
class TimeIsUp : public Error {
public:
    using Error::Error;
};

/// Limits the jobs of the current thread until it is destroyed. Nested objects can only lower the limits. The
/// time of a job begins when the object is created.
class JobLimits {
public:
    using Clock = std::chrono::steady_clock;

    explicit JobLimits(const WorkLimits& limits);

    /// Gives the current thread the same limits as the thread that called of_thread().
    struct OfThread {
        uint64_t memory_bytes = std::numeric_limits<uint64_t>::max();
        double seconds = std::numeric_limits<double>::infinity(); ///< Length of the shortest time limit
        Clock::time_point end = Clock::time_point::max();         ///< End of the shortest time limit
    };

    explicit JobLimits(const OfThread& limits);
    ~JobLimits();
    JobLimits(const JobLimits&) = delete;
    JobLimits& operator=(const JobLimits&) = delete;

    [[nodiscard]] static OfThread of_thread();

private:
    OfThread before_;
};

/// Throws TimeIsUp if the time limit of the current thread is over.
void check_time();

/// Returns whether the time limit of the current thread is over.
[[nodiscard]] bool is_time_up();

/// Returns the time until the limit of the current thread is over; infinite without a limit, at least 0.
[[nodiscard]] double seconds_left();

/// Returns whether the memory of the current thread's jobs is limited.
[[nodiscard]] bool is_memory_limited();

} // namespace estampe
