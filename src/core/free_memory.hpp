// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace estampe {

/// Returns the memory that this process can still allocate: the free memory of the machine, or less if a
/// control group or a process limit restricts it. Limits that cannot be read are ignored. `root` replaces the
/// system's root folder. Cost: about 50 us.
[[nodiscard]] uint64_t free_memory_bytes(const std::filesystem::path& root = "/");

/// Formats a number of bytes as text, such as "1.5 GiB" or "20 MiB".
[[nodiscard]] std::string in_bytes(uint64_t bytes);

/// Checks before a large allocation that memory is free. Throws Error if `bytes` exceeds the free memory,
/// because systems that overcommit memory kill a program without a message, or if `bytes` exceeds the part of
/// the current thread's memory limit (JobLimits) that the process does not use yet. Small sizes are checked
/// only against the limit. The error message consists of `what` and "needs ... of memory".
void require_memory(uint64_t bytes, const std::string& what, const std::string& where,
                    const std::string& remedy = {});

} // namespace estampe
