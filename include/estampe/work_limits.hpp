// SPDX-License-Identifier: MIT
#pragma once

// Limits on the memory and the time of loading and drawing.

#include <cstdint>
#include <limits>

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

} // namespace estampe
