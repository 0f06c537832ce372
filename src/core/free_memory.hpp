// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace estampe {

/// Memory that this process can still take: what the machine has free, or less where its group of processes
/// or itself is limited. What cannot be found out is no limit. `root` stands for the system's root folder.
/// Cost: about 50 us.
[[nodiscard]] uint64_t free_memory_bytes(const std::filesystem::path& root = "/");

/// "1.5 GiB", "20 MiB"
[[nodiscard]] std::string in_bytes(uint64_t bytes);

/// Throws Error when `bytes` are more than there are: a system that promises more than it has ends programs
/// without a word. What is small is not looked at. `what` goes before "needs ... of memory".
void require_memory(uint64_t bytes, const std::string& what, const std::string& where,
                    const std::string& remedy = {});

} // namespace estampe
