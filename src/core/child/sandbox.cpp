// SPDX-License-Identifier: MIT
#include "core/child/sandbox.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cinttypes>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <system_error>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <linux/landlock.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <seccomp.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "core/descriptor.hpp"

namespace estampe {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool sanitized = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
constexpr bool sanitized = true;
#else
constexpr bool sanitized = false;
#endif
#else
constexpr bool sanitized = false;
#endif

uint64_t mapped_bytes()
{
    uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    return pages * static_cast<uint64_t>(sysconf(_SC_PAGESIZE));
}

void limit(__rlimit_resource what, uint64_t soft)
{
    rlimit value{};
    if (getrlimit(what, &value) != 0)
        return;
    value.rlim_cur = std::min<rlim_t>(soft, value.rlim_max);
    (void)setrlimit(what, &value);
}

} // namespace

void limit_resources(uint32_t cpu_s, uint64_t memory_bytes)
{
    constexpr uint64_t open_files = 64;
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_FSIZE, 0);
    limit(RLIMIT_NOFILE, open_files);
    limit(RLIMIT_CPU, cpu_s);
    if (!sanitized)
        limit(RLIMIT_AS, mapped_bytes() + memory_bytes);
}

namespace {

void close_from(unsigned first, unsigned last)
{
    if (first > last || syscall(SYS_close_range, first, last, 0U) == 0)
        return;
    // Kernels before 5.9 lack close_range.
    const auto end = static_cast<unsigned>(std::min<long>(sysconf(_SC_OPEN_MAX), 1L << 16U));
    for (unsigned file = first; file < end && file <= last; ++file)
        close(static_cast<int>(file));
}

struct Range {
    uintptr_t begin = 0;
    uintptr_t end = 0;
};

std::vector<Range> shared_mappings()
{
    std::vector<Range> found;
    std::ifstream maps("/proc/self/maps");
    for (std::string line; std::getline(maps, line);) {
        Range range;
        std::array<char, 5> rights{};
        const int count = std::sscanf(line.c_str(), "%" SCNxPTR "-%" SCNxPTR " %4s", &range.begin, &range.end,
                                      rights.data());
        if (count == 3 && rights[1] == 'w' && rights[3] == 's')
            found.push_back(range);
    }
    return found;
}

} // namespace

void drop_shared(int kept_file)
{
    for (const Range& range : shared_mappings())
        (void)munmap(reinterpret_cast<void*>(range.begin), range.end - range.begin);
    constexpr unsigned first_file = STDERR_FILENO + 1;
    const auto kept = static_cast<unsigned>(kept_file);
    close_from(first_file, kept - 1);
    close_from(kept + 1, ~0U);
}

namespace {

#ifndef LANDLOCK_ACCESS_FS_REFER // since Landlock's second version
#define LANDLOCK_ACCESS_FS_REFER (1ULL << 13)
#endif
#ifndef LANDLOCK_ACCESS_FS_TRUNCATE // since Landlock's third version
#define LANDLOCK_ACCESS_FS_TRUNCATE (1ULL << 14)
#endif

constexpr uint64_t reading = LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR;

/// Returns the version of Landlock; less than 1 if the kernel lacks it.
long landlock_version()
{
    return syscall(SYS_landlock_create_ruleset, nullptr, size_t{0}, LANDLOCK_CREATE_RULESET_VERSION);
}

uint64_t forbidden_of(long version)
{
    uint64_t forbidden =
        LANDLOCK_ACCESS_FS_EXECUTE | LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_REMOVE_DIR |
        LANDLOCK_ACCESS_FS_REMOVE_FILE | LANDLOCK_ACCESS_FS_MAKE_CHAR | LANDLOCK_ACCESS_FS_MAKE_DIR |
        LANDLOCK_ACCESS_FS_MAKE_REG | LANDLOCK_ACCESS_FS_MAKE_SOCK | LANDLOCK_ACCESS_FS_MAKE_FIFO |
        LANDLOCK_ACCESS_FS_MAKE_BLOCK | LANDLOCK_ACCESS_FS_MAKE_SYM;
    forbidden |= version >= 2 ? LANDLOCK_ACCESS_FS_REFER : 0;
    forbidden |= version >= 3 ? LANDLOCK_ACCESS_FS_TRUNCATE : 0;
    return forbidden;
}

/// Allows reading of a file, or of all files and folders below a folder. What does not exist stays forbidden.
void allow_reading(const Descriptor& rules, const std::filesystem::path& path)
{
    const Descriptor allowed(open(path.empty() ? "." : path.c_str(), O_PATH | O_CLOEXEC));
    std::error_code failed;
    const uint64_t access = std::filesystem::is_directory(path.empty() ? "." : path, failed)
                                ? reading
                                : uint64_t{LANDLOCK_ACCESS_FS_READ_FILE};
    const landlock_path_beneath_attr rule{.allowed_access = access, .parent_fd = allowed.number()};
    (void)syscall(SYS_landlock_add_rule, rules.number(), LANDLOCK_RULE_PATH_BENEATH, &rule, 0U);
}

} // namespace

bool forbid_files(const ReadScope& scope)
{
    const long version = landlock_version();
    if (version < 1)
        return false;
    landlock_ruleset_attr attributes{};
    attributes.handled_access_fs = forbidden_of(version) | (scope.is_limited() ? reading : 0);
    const Descriptor rules(
        static_cast<int>(syscall(SYS_landlock_create_ruleset, &attributes, sizeof(attributes), 0U)));
    if (rules.number() < 0)
        return false;
    if (scope.is_limited()) {
        for (const char* const system : {"/proc/meminfo", "/proc/self", "/sys/fs/cgroup"})
            allow_reading(rules, system);
        for (const std::filesystem::path& folder : scope.folders)
            allow_reading(rules, folder);
    }
    return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
           syscall(SYS_landlock_restrict_self, rules.number(), 0U) == 0;
}

namespace {

// System calls that the C++ library, the decoders and the sanitizers make while they read files, compute and
// start threads. Calls that one machine's kernel or an old libseccomp does not know are left out there.
constexpr std::array allowed_calls{
    "access",
    "arch_prctl",
    "brk",
    "clock_getres",
    "clock_gettime",
    "clock_nanosleep",
    "close",
    "dup",
    "exit",
    "exit_group",
    "faccessat",
    "faccessat2",
    "fadvise64",
    "fstat",
    "fstatfs",
    "futex",
    "futex_wait",
    "futex_waitv",
    "futex_wake",
    "get_mempolicy",
    "getcwd",
    "getdents",
    "getdents64",
    "getegid",
    "geteuid",
    "getgid",
    "getpid",
    "getppid",
    "getrandom",
    "getrlimit",
    "getrusage",
    "gettid",
    "gettimeofday",
    "getuid",
    "lseek",
    "lstat",
    "madvise",
    "membarrier",
    "mincore",
    "mmap",
    "mprotect",
    "mremap",
    "mseal",
    "munmap",
    "nanosleep",
    "newfstatat",
    "poll",
    "ppoll",
    "pread64",
    "preadv",
    "read",
    "readahead",
    "readlink",
    "readlinkat",
    "readv",
    "restart_syscall",
    "riscv_flush_icache",
    "rseq",
    "rt_sigaction",
    "rt_sigprocmask",
    "rt_sigreturn",
    "sched_get_priority_max",
    "sched_get_priority_min",
    "sched_getaffinity",
    "sched_getparam",
    "sched_getscheduler",
    "sched_yield",
    "set_robust_list",
    "set_tid_address",
    "sigaltstack",
    "stat",
    "statfs",
    "statx",
    "sysinfo",
    "time",
    "times",
    "uname",
    "write",
    "writev",
};

/// A filter of system calls. Remembers whether a rule could not be added.
class Filter {
public:
    Filter() : context_(seccomp_init(SCMP_ACT_ERRNO(EPERM)), seccomp_release) {}

    void add(uint32_t action, const char* call, std::initializer_list<scmp_arg_cmp> arguments = {})
    {
        const int number = seccomp_syscall_resolve_name(call);
        if (context_ == nullptr || number < 0)
            return;
        const std::vector<scmp_arg_cmp> all(arguments);
        const int failure = seccomp_rule_add_array(context_.get(), action, number,
                                                   static_cast<unsigned>(all.size()), all.data());
        is_whole_ = is_whole_ && failure == 0;
    }

    void allow(const char* call, std::initializer_list<scmp_arg_cmp> arguments = {})
    {
        add(SCMP_ACT_ALLOW, call, arguments);
    }

    [[nodiscard]] bool enter()
    {
        constexpr uint32_t binary_tree = 2;
        if (context_ == nullptr || !is_whole_)
            return false;
        (void)seccomp_attr_set(context_.get(), SCMP_FLTATR_CTL_OPTIMIZE, binary_tree);
        return seccomp_load(context_.get()) == 0;
    }

private:
    std::unique_ptr<void, void (*)(scmp_filter_ctx)> context_;
    bool is_whole_ = true;
};

scmp_arg_cmp equals(unsigned argument, uint64_t value)
{
    return {.arg = argument, .op = SCMP_CMP_EQ, .datum_a = value, .datum_b = 0};
}

/// Compares those bits of an argument that `mask` selects.
scmp_arg_cmp equals_within(unsigned argument, uint64_t mask, uint64_t value)
{
    return {.arg = argument, .op = SCMP_CMP_MASKED_EQ, .datum_a = mask, .datum_b = value};
}

} // namespace

bool forbid_system_calls()
{
    Filter filter;
    for (const char* const call : allowed_calls)
        filter.allow(call);
    constexpr uint64_t changing = O_ACCMODE | O_CREAT | O_TRUNC;
    filter.allow("open", {equals_within(1, changing, 0)});
    filter.allow("openat", {equals_within(2, changing, 0)});
    const scmp_arg_cmp is_thread = equals_within(0, CLONE_THREAD, CLONE_THREAD);
#if defined(__SANITIZE_THREAD__)
    // The thread sanitizer cannot tell new threads of a fork from threads of its parent. This error is that
    // of a system with too many threads; the decoders work without threads then.
    filter.add(SCMP_ACT_ERRNO(EAGAIN), "clone", {is_thread});
#else
    filter.allow("clone", {is_thread});
#endif
    // The flags of clone3 lie in memory, which a filter cannot read. ENOSYS makes the C library call clone.
    filter.add(SCMP_ACT_ERRNO(ENOSYS), "clone3");
    for (const int command : {F_DUPFD, F_DUPFD_CLOEXEC, F_GETFD, F_SETFD, F_GETFL})
        filter.allow("fcntl", {equals(1, static_cast<uint64_t>(command))});
    filter.allow("prctl", {equals(0, PR_SET_NAME)});
    filter.allow("prctl", {equals(0, PR_GET_NAME)});
    filter.allow("prlimit64", {equals(2, 0)}); // reads a limit
    for (const char* const call : {"tgkill", "kill", "rt_sigqueueinfo"})
        filter.allow(call, {equals(0, static_cast<uint64_t>(getpid()))});
    return filter.enter();
}

std::string missing_protections()
{
    const uint32_t needed = SECCOMP_RET_ERRNO;
    const bool has_seccomp = syscall(SYS_seccomp, SECCOMP_GET_ACTION_AVAIL, 0U, &needed) == 0;
    const bool has_landlock = landlock_version() >= 1;
    return has_seccomp ? (has_landlock ? "" : "Landlock") : has_landlock ? "seccomp" : "seccomp and Landlock";
}

} // namespace estampe
