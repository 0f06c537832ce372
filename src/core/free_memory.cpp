// SPDX-License-Identifier: MIT
#include "core/free_memory.hpp"

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>
#include <string_view>

#include <sys/resource.h>
#include <unistd.h>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "core/job_limits.hpp"

namespace estampe {
namespace {

constexpr uint64_t no_limit = std::numeric_limits<uint64_t>::max();

/// Reads the number that follows `key` in a file of key-value pairs. If `key` is empty, reads the first
/// number of the file.
std::optional<uint64_t> number_in(const std::filesystem::path& path, std::string_view key)
{
    std::ifstream file(path);
    for (std::string word; !key.empty() && file >> word && word != key;) {
    }
    uint64_t number = 0;
    return file >> number ? std::optional(number) : std::nullopt;
}

uint64_t free_on_machine(const std::filesystem::path& root)
{
    constexpr uint64_t kibibyte = 1024;
    const auto memory = number_in(root / "proc/meminfo", "MemAvailable:");
    const auto swap = number_in(root / "proc/meminfo", "SwapFree:");
    return memory ? (*memory + swap.value_or(0)) * kibibyte : no_limit;
}

/// Free memory of a Linux control group with a memory limit. The group's cached files count as used, but the
/// system can release them.
uint64_t free_in_group(const std::filesystem::path& group, const char* limit_name, const char* taken_name,
                       const char* files_name)
{
    const auto limit = number_in(group / limit_name, "");
    const auto taken = number_in(group / taken_name, "");
    if (!limit || !taken) {
        return no_limit;
    }
    const uint64_t files = number_in(group / "memory.stat", files_name).value_or(0);
    const uint64_t used = *taken - std::min(files, *taken);
    return *limit - std::min(used, *limit);
}

/// Address space that this process can still use under its limit (RLIMIT_AS).
uint64_t free_for_process(const std::filesystem::path& root)
{
    rlimit limit{};
    const auto mapped_pages = number_in(root / "proc/self/statm", "");
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY || !mapped_pages) {
        return no_limit;
    }
    const uint64_t mapped = *mapped_pages * static_cast<uint64_t>(sysconf(_SC_PAGESIZE));
    return limit.rlim_cur - std::min<uint64_t>(mapped, limit.rlim_cur);
}

/// Memory of this process that lies in RAM.
uint64_t resident_bytes()
{
    std::ifstream file("/proc/self/statm");
    uint64_t mapped_pages = 0;
    uint64_t resident_pages = 0;
    file >> mapped_pages >> resident_pages;
    return resident_pages * static_cast<uint64_t>(sysconf(_SC_PAGESIZE));
}

} // namespace

uint64_t free_memory_bytes(const std::filesystem::path& root)
{
    const std::filesystem::path groups = root / "sys/fs/cgroup";
    return std::min({free_on_machine(root), free_for_process(root),
                     free_in_group(groups, "memory.max", "memory.current", "inactive_file"),
                     free_in_group(groups / "memory", "memory.limit_in_bytes", "memory.usage_in_bytes",
                                   "total_inactive_file")});
}

std::string in_bytes(uint64_t bytes)
{
    constexpr double mebibyte = 1024.0 * 1024.0;
    const double amount = static_cast<double>(bytes) / mebibyte;
    return amount < 1024.0 ? fmt::format("{:.0f} MiB", amount) : fmt::format("{:.1f} GiB", amount / 1024.0);
}

void require_memory(uint64_t bytes, const std::string& what, const std::string& where,
                    const std::string& remedy)
{
    if (is_memory_limited()) {
        const uint64_t limit = JobLimits::of_thread().memory_bytes;
        if (const uint64_t used = resident_bytes(); bytes > limit - std::min(used, limit)) {
            throw Error(fmt::format("{} needs {} of memory beside the {} in use, more than {}, the limit of "
                                    "--max-memory",
                                    what, in_bytes(bytes), in_bytes(used), in_bytes(limit)),
                        where, remedy.empty() ? "raise the limit" : remedy + ", or raise the limit");
        }
    }
    constexpr uint64_t small_bytes = uint64_t{64} << 20U;
    if (bytes < small_bytes) {
        return;
    }
    if (const uint64_t free_bytes = free_memory_bytes(); bytes > free_bytes) {
        throw Error(
            fmt::format("{} needs {} of memory, {} are free", what, in_bytes(bytes), in_bytes(free_bytes)),
            where, remedy);
    }
}

} // namespace estampe
