// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace estampe {

/// Resource limits of a child process. The parent ends a child that exceeds one of the limits.
struct ChildLimits {
    double wall_s = 120.0;
    uint32_t cpu_s = 60;
    /// Memory that the child may map in addition to the parent's; not enforced under sanitizers.
    uint64_t memory_bytes = uint64_t{4} << 30;
};

/// Runs `work` in a forked child process without terminal output and returns the result of `work`. If `work`
/// crashes, hangs, runs out of memory or throws, this function throws Error with `where` as its place. The
/// child has no other effect on the parent. Cost: a fork and a copy of the result through a pipe, about 1 ms
/// plus 1 ms per megabyte.
[[nodiscard]] std::vector<std::byte> run_in_child(const std::function<std::vector<std::byte>()>& work,
                                                  const ChildLimits& limits, const std::string& where);

} // namespace estampe
