// SPDX-License-Identifier: MIT
#pragma once

// Counts what this program's C++ code asks of the heap. Drivers and C libraries ask malloc, which is not
// counted.

#include <cstdint>

namespace estampe::test {

/// How often this thread has asked so far, and for how much.
struct HeapCount {
    uint64_t times = 0;
    uint64_t bytes = 0;
};

[[nodiscard]] HeapCount heap_count();

} // namespace estampe::test
