// SPDX-License-Identifier: MIT
#include "core/child/sandbox.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <seccomp.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/child/child.hpp"
#include "core/free_memory.hpp"
#include "support/folder.hpp"

namespace estampe {
namespace {

/// Returns what `call` sets errno to in a confined child process; 0 if the call succeeds.
int errno_in_child(const std::function<long()>& call, const ChildLimits& limits = {})
{
    return run_in_child([&call] { return call() < 0 ? errno : 0; }, limits, "test");
}

/// Runs `work` in a plain child process and returns its result, which must fit into an exit status.
int result_in_fork(const std::function<int()>& work)
{
    const pid_t process = fork();
    if (process == 0)
        _exit(work());
    int status = 0;
    waitpid(process, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

class Sandbox : public testing::Test {
protected:
    Sandbox()
    {
        std::filesystem::create_directories(folder_ / "inside");
        std::ofstream(folder_ / "inside/file") << "x";
        std::ofstream(folder_ / "outside") << "x";
    }

    [[nodiscard]] std::string path(const char* name) const { return folder_ / name; }

    test::Folder folder_;
};

TEST_F(Sandbox, ThisKernelHasAllProtections)
{
    EXPECT_EQ(missing_protections(), "");
}

TEST_F(Sandbox, FilesCanBeReadButNotWritten)
{
    const std::string file = path("inside/file");
    EXPECT_EQ(errno_in_child([&] { return open(file.c_str(), O_RDONLY); }), 0);
    for (const int flags : {O_WRONLY, O_RDWR, O_RDONLY | O_TRUNC, O_RDONLY | O_CREAT})
        EXPECT_EQ(errno_in_child([&] { return open(file.c_str(), flags, 0600); }), EPERM) << flags;
    EXPECT_EQ(errno_in_child([&] { return open(folder_.path().c_str(), O_TMPFILE | O_RDWR, 0600); }), EPERM);
    EXPECT_EQ(errno_in_child([&] { return truncate(file.c_str(), 0); }), EPERM);
    EXPECT_EQ(errno_in_child([&] { return unlink(file.c_str()); }), EPERM);
    EXPECT_EQ(errno_in_child([&] { return rename(file.c_str(), path("new").c_str()); }), EPERM);
    EXPECT_EQ(errno_in_child([&] { return mkdir(path("new").c_str(), 0700); }), EPERM);
    EXPECT_EQ(errno_in_child([&] { return symlink(file.c_str(), path("new").c_str()); }), EPERM);
    EXPECT_EQ(errno_in_child([&] { return chmod(file.c_str(), 0777); }), EPERM);
    EXPECT_EQ(std::filesystem::file_size(file), 1U);
    EXPECT_FALSE(std::filesystem::exists(path("new")));
}

TEST_F(Sandbox, ThereIsNoNetwork)
{
    for (const int family : {AF_INET, AF_INET6, AF_UNIX, AF_NETLINK})
        EXPECT_EQ(errno_in_child([&] { return socket(family, SOCK_STREAM, 0); }), EPERM) << family;
}

TEST_F(Sandbox, NoProgramAndNoProcessCanBeStarted)
{
    EXPECT_EQ(errno_in_child([] { return execl("/bin/true", "true", nullptr); }), EPERM);
    EXPECT_EQ(
        errno_in_child([] { return syscall(SYS_execveat, AT_FDCWD, "/bin/true", nullptr, nullptr, 0); }),
        EPERM);
    const auto start = [](long process) {
        if (process == 0)
            _exit(0);
        return process;
    };
    EXPECT_EQ(errno_in_child([&] { return start(fork()); }), EPERM);
    EXPECT_EQ(
        errno_in_child([&] { return start(syscall(SYS_clone, SIGCHLD, nullptr, nullptr, nullptr, 0)); }),
        EPERM);
}

TEST_F(Sandbox, OtherProcessesCannotBeReached)
{
    const pid_t parent = getpid();
    EXPECT_EQ(errno_in_child([&] { return kill(parent, SIGCONT); }), EPERM);
    EXPECT_EQ(errno_in_child([&] { return syscall(SYS_tgkill, parent, parent, SIGCONT); }), EPERM);
    EXPECT_EQ(errno_in_child([&] { return ptrace(PTRACE_SEIZE, parent, nullptr, nullptr); }), EPERM);
    EXPECT_EQ(errno_in_child([&] {
                  char byte = 0;
                  const iovec mine{.iov_base = &byte, .iov_len = 1};
                  return process_vm_writev(parent, &mine, 1, &mine, 1, 0);
              }),
              EPERM);
    EXPECT_EQ(errno_in_child([&] {
                  const rlimit none{};
                  return prlimit(parent, RLIMIT_NOFILE, &none, nullptr);
              }),
              EPERM);
    EXPECT_EQ(
        errno_in_child([&] { return open(("/proc/" + std::to_string(parent) + "/mem").c_str(), O_RDWR); }),
        EPERM);
    EXPECT_EQ(errno_in_child([&] { return fcntl(STDOUT_FILENO, F_SETOWN, parent); }), EPERM);
}

TEST_F(Sandbox, ResourcesAreLimited)
{
    const auto limit_of = [](__rlimit_resource what) {
        return [what] {
            rlimit value{};
            getrlimit(what, &value);
            return uint64_t{value.rlim_cur};
        };
    };
    rlimit core{};
    getrlimit(RLIMIT_CORE, &core);
    core.rlim_cur = core.rlim_max;
    setrlimit(RLIMIT_CORE, &core);
    const ChildLimits limits{.cpu_s = 77};
    EXPECT_EQ(run_in_child(limit_of(RLIMIT_CORE), limits, ""), 0U);
    EXPECT_EQ(run_in_child(limit_of(RLIMIT_FSIZE), limits, ""), 0U);
    EXPECT_EQ(run_in_child(limit_of(RLIMIT_CPU), limits, ""), 77U);
    EXPECT_LE(run_in_child(limit_of(RLIMIT_NOFILE), limits, ""), 64U);
}

TEST_F(Sandbox, ReadingCanBeConfinedToAFolder)
{
    const ChildLimits limits{.scope = {{folder_ / "inside", folder_ / "absent"}}};
    const auto error_of_opening = [&](const std::string& file) {
        return errno_in_child([&] { return open(file.c_str(), O_RDONLY); }, limits);
    };
    EXPECT_EQ(error_of_opening(path("inside/file")), 0);
    EXPECT_EQ(error_of_opening(path("inside")), 0);
    EXPECT_EQ(error_of_opening(path("outside")), EACCES);
    EXPECT_EQ(error_of_opening(path("inside/../outside")), EACCES);
    EXPECT_EQ(error_of_opening(folder_.path()), EACCES);
    EXPECT_EQ(error_of_opening("/etc/passwd"), EACCES);
    std::filesystem::create_symlink(path("outside"), folder_ / "inside/link");
    EXPECT_EQ(error_of_opening(path("inside/link")), EACCES);
}

TEST_F(Sandbox, ConfinedChildStillKnowsHowMuchMemoryIsFree)
{
    const ChildLimits limits{.scope = {{folder_ / "inside"}}};
    const uint64_t here = free_memory_bytes();
    const uint64_t there = run_in_child([] { return free_memory_bytes(); }, limits, "");
    EXPECT_LE(there, limits.memory_bytes);
    EXPECT_GT(there, std::min(here, limits.memory_bytes) / 4);
}

TEST_F(Sandbox, LandlockAloneForbidsWriting)
{
    const std::string file = path("inside/file");
    const auto error_of = [](const std::function<long()>& call) {
        return result_in_fork([&] { return !forbid_files({}) ? 255 : call() < 0 ? errno : 0; });
    };
    EXPECT_EQ(error_of([&] { return open(file.c_str(), O_RDONLY); }), 0);
    EXPECT_EQ(error_of([&] { return open(file.c_str(), O_WRONLY); }), EACCES);
    EXPECT_EQ(error_of([&] { return open(path("new").c_str(), O_CREAT | O_WRONLY, 0600); }), EACCES);
    EXPECT_EQ(error_of([&] { return unlink(file.c_str()); }), EACCES);
    EXPECT_EQ(error_of([] { return execl("/bin/true", "true", nullptr); }), EACCES);
}

TEST_F(Sandbox, WorksInAProcessWithoutStandardStreams)
{
    EXPECT_EQ(result_in_fork([] {
                  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
                      close(stream);
                  return run_in_child([] { return 7; }, {}, "");
              }),
              7);
}

/// Makes the system calls of both protections fail as on a kernel without them.
bool be_an_old_kernel()
{
    const scmp_filter_ctx filter = seccomp_init(SCMP_ACT_ALLOW);
    for (const int call : {SCMP_SYS(seccomp), SCMP_SYS(landlock_create_ruleset)})
        (void)seccomp_rule_add(filter, SCMP_ACT_ERRNO(ENOSYS), call, 0);
    const scmp_arg_cmp sets_filter{
        .arg = 0, .op = SCMP_CMP_EQ, .datum_a = 22, .datum_b = 0}; // PR_SET_SECCOMP
    (void)seccomp_rule_add_array(filter, SCMP_ACT_ERRNO(EINVAL), SCMP_SYS(prctl), 1, &sets_filter);
    return seccomp_load(filter) == 0;
}

TEST_F(Sandbox, KernelWithoutProtectionsStillReadsAndSaysSo)
{
    EXPECT_EQ(result_in_fork([] {
                  const auto seven = [] { return 7; };
                  return be_an_old_kernel() ? run_in_child(seven, {}, "") : 1;
              }),
              7);
    EXPECT_EQ(result_in_fork([] {
                  return be_an_old_kernel() && missing_protections() == "seccomp and Landlock" ? 7 : 1;
              }),
              7);
    EXPECT_EQ(result_in_fork([] {
                  const auto seven = [] { return 7; };
                  return be_an_old_kernel() ? run_in_child(seven, {.scope = {{"/"}}}, "") : 1;
              }),
              7);
}

} // namespace
} // namespace estampe
