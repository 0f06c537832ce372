// SPDX-License-Identifier: MIT
#include "scene/assimp/child.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <new>
#include <span>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

#include <estampe/error.hpp>

namespace estampe {
namespace {

constexpr const char* try_others = "check that the file opens in other programs, or convert it to glTF";

// First byte that the child process sends to the parent if `work` succeeded.
constexpr std::byte went_well{'+'};
constexpr std::byte threw{'-'};
constexpr std::byte ran_out_of_memory{'m'};

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

void enter_limits(const ChildLimits& limits)
{
    (void)prctl(PR_SET_PDEATHSIG, SIGKILL);
    for (const int signal_number :
         {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGTERM, SIGINT, SIGXCPU, SIGPIPE})
        (void)std::signal(signal_number, SIG_DFL);
    sigset_t none;
    sigemptyset(&none);
    (void)sigprocmask(SIG_SETMASK, &none, nullptr);
    const int nowhere = open("/dev/null", O_RDWR);
    if (nowhere >= 0)
        for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
            (void)dup2(nowhere, stream);
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, limits.cpu_s);
    if (!sanitized)
        limit(RLIMIT_AS, mapped_bytes() + limits.memory_bytes);
}

void send(int pipe_end, std::span<const std::byte> bytes)
{
    while (!bytes.empty()) {
        const ssize_t count = write(pipe_end, bytes.data(), bytes.size());
        if (count < 0 && errno != EINTR)
            _exit(3);
        bytes = bytes.subspan(static_cast<size_t>(std::max<ssize_t>(count, 0)));
    }
}

[[noreturn]] void be_child(int pipe_end, const std::function<std::vector<std::byte>()>& work,
                           const ChildLimits& limits)
{
    enter_limits(limits);
    try {
        const std::vector<std::byte> result = work();
        send(pipe_end, {&went_well, 1});
        send(pipe_end, result);
    } catch (const std::bad_alloc&) {
        send(pipe_end, {&ran_out_of_memory, 1});
    } catch (const std::exception& error) {
        send(pipe_end, {&threw, 1});
        send(pipe_end, std::as_bytes(std::span(error.what(), std::strlen(error.what()))));
    }
    // Ends the child process without running destructors and exit handlers, which belong to the parent
    // process.
    _exit(0);
}

/// Reads from the pipe until the child closes its end. Returns false if `wall_s` seconds pass first.
bool receive(int pipe_end, double wall_s, std::vector<std::byte>& bytes)
{
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(wall_s);
    std::vector<std::byte> part(1U << 18);
    while (true) {
        const std::chrono::duration<double, std::milli> left = end - std::chrono::steady_clock::now();
        pollfd waiting{.fd = pipe_end, .events = POLLIN, .revents = 0};
        const int ready = left.count() <= 0.0 ? 0 : poll(&waiting, 1, static_cast<int>(left.count()) + 1);
        if (ready == 0)
            return false;
        if (ready < 0)
            continue;
        const ssize_t count = read(pipe_end, part.data(), part.size());
        if (count == 0)
            return true;
        if (count > 0)
            bytes.insert(bytes.end(), part.begin(), part.begin() + count);
        else if (errno != EINTR)
            return true;
    }
}

int wait_for(pid_t child)
{
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
}

std::string one_line(std::span<const std::byte> bytes)
{
    std::string text;
    for (const std::byte byte : bytes.first(std::min<size_t>(bytes.size(), 300))) {
        const char character = static_cast<char>(byte);
        text += static_cast<unsigned char>(character) < 0x20 ? ' ' : character;
    }
    return text;
}

} // namespace

std::vector<std::byte> run_in_child(const std::function<std::vector<std::byte>()>& work,
                                    const ChildLimits& limits, const std::string& where)
{
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0)
        throw Error(fmt::format("cannot open a pipe ({})", std::strerror(errno)), where);
    const pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        be_child(ends[1], work, limits);
    }
    const int fork_errno = errno;
    close(ends[1]);
    if (child < 0) {
        close(ends[0]);
        throw Error(fmt::format("cannot start a process to read it in ({})", std::strerror(fork_errno)),
                    where);
    }

    std::vector<std::byte> bytes;
    const bool in_time = receive(ends[0], limits.wall_s, bytes);
    close(ends[0]);
    if (!in_time)
        (void)kill(child, SIGKILL);
    const int status = wait_for(child);
    if (!in_time || (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL)))
        throw Error("reading it took too long, and was given up", where, try_others);
    if (WIFSIGNALED(status))
        throw Error(fmt::format("reading it crashed (signal {})", WTERMSIG(status)), where, try_others);
    if (bytes.empty() || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
        throw Error("reading it failed without a word", where, try_others);
    const std::byte outcome = bytes.front();
    bytes.erase(bytes.begin());
    if (outcome == ran_out_of_memory)
        throw Error("reading it takes more memory than a file of this size should", where, try_others);
    if (outcome != went_well)
        throw Error(one_line(bytes), where, try_others);
    return bytes;
}

} // namespace estampe
