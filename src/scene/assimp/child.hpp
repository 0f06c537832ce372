// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace estampe {

/// What a child process may use before it is ended.
struct ChildLimits {
    double wall_s = 120.0;
    uint32_t cpu_s = 60;
    uint64_t memory_bytes = uint64_t{4}
                            << 30; ///< beyond what the parent has mapped; not enforced under sanitizers
};

/// Runs `work` in a forked child, without terminal output, and returns what it returned. A crash, a hang,
/// running out of memory or an exception in there is an Error here; `where` becomes its place. Nothing else
/// of the child's doing is seen by the parent. Cost: a fork and a copy of the bytes through a pipe, about 1
/// ms and 1 ms a megabyte.
[[nodiscard]] std::vector<std::byte> run_in_child(const std::function<std::vector<std::byte>()>& work,
                                                  const ChildLimits& limits, const std::string& where);

} // namespace estampe
