// SPDX-License-Identifier: MIT
#pragma once

// Limits on the memory and the time of loading and drawing.

#include <cstdint>
#include <limits>
#include <memory>

namespace estampe {

/// Limits on the work of one function call. By default, memory is limited by what is free on the machine, and
/// time is not limited.
///
/// The memory of a job is estimated from its counts, such as vertices and pixels, before the memory is
/// allocated. A job whose estimate, together with the memory that the process uses already, exceeds the limit
/// is refused with an Error. Time is checked between steps, such as two passes of a picture; a job that takes
/// longer ends with an Error. Memory of a GPU and of its driver counts only as far as it is estimated.
struct WorkLimits {
    uint64_t max_memory_bytes = std::numeric_limits<uint64_t>::max();
    double max_seconds = std::numeric_limits<double>::infinity();

    bool operator==(const WorkLimits&) const = default;
};

class JobLimits;

/// Limits the work of the current thread until this object is destroyed, for functions without a parameter
/// for limits, such as load_image(). The memory limit holds for each function that the thread calls, the time
/// limit for all of them together, from the creation of this object. Such a function throws Error if it would
/// exceed a limit. Objects may be nested: the lower limits apply. Must be destroyed in the thread that
/// created it, in reverse order of creation.
class LimitedWork {
public:
    explicit LimitedWork(const WorkLimits& limits);
    ~LimitedWork();
    LimitedWork(const LimitedWork&) = delete;
    LimitedWork& operator=(const LimitedWork&) = delete;

private:
    std::unique_ptr<JobLimits> limits_;
};

} // namespace estampe
