// SPDX-License-Identifier: MIT
#include "core/child/child.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <exception>
#include <new>
#include <span>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "core/child/sandbox.hpp"
#include "core/descriptor.hpp"
#include "core/free_memory.hpp"
#include "core/job_limits.hpp"
#include "core/long_jobs.hpp"
#include "core/read_scope.hpp"

#if defined(__SANITIZE_THREAD__)
// The thread sanitizer otherwise ends a child process that tries to start a thread, if its parent has
// several.
extern "C" const char* __tsan_default_options()
{
    return "die_after_fork=0";
}
#endif

namespace estampe {
namespace child {
namespace {

constexpr const char* try_others = "check that the file opens in other programs, or convert it to glTF";

/// Kind of a message from the child process. The message's content follows.
enum class Message : uint8_t { progress, result, error, out_of_memory };

bool is_valid(Message message)
{
    switch (message) {
    case Message::progress:
    case Message::result:
    case Message::error:
    case Message::out_of_memory:
        return true;
    }
    return false;
}

/// Follows the result, which shows that the child sent all of it.
constexpr uint32_t end_mark = 0x20646e65;

/// The parts of an Error, which make the same message again.
struct ErrorParts {
    std::string what;
    std::string where;
    std::string remedy;
    bool is_outside_scope = false; ///< An OutsideScope, which callers tell from other Errors
};

template <Either<ErrorParts> T>
auto members(T& error)
{
    auto& [what, where, remedy, is_outside_scope] = error;
    return std::tie(what, where, remedy, is_outside_scope);
}

/// Splits an Error into its parts. The message is "where: what; remedy" without the parts that are empty.
ErrorParts parts_of(const Error& error)
{
    std::string_view what = error.what();
    what.remove_prefix(error.where().empty() ? 0 : error.where().size() + 2);
    what.remove_suffix(error.remedy().empty() ? 0 : error.remedy().size() + 2);
    return {.what = std::string(what),
            .where = error.where(),
            .remedy = error.remedy(),
            .is_outside_scope = dynamic_cast<const OutsideScope*>(&error) != nullptr};
}

// The child process

// Exit statuses of a child process that cannot send a message.
constexpr int lost_its_pipe = 3;
constexpr int failed_outside_work = 4;
constexpr int lacked_memory = 5; ///< Memory ran out after a part of the result was sent

void take_default_signals()
{
    for (const int number : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGXCPU, SIGPIPE})
        (void)std::signal(number, SIG_DFL);
    // Terminals and service managers send these signals to both processes. The parent decides what they mean,
    // and the child ends with the parent.
    for (const int number : {SIGINT, SIGHUP, SIGQUIT, SIGTERM, SIGXFSZ})
        (void)std::signal(number, SIG_IGN);
    sigset_t none;
    sigemptyset(&none);
    (void)sigprocmask(SIG_SETMASK, &none, nullptr);
}

void enter_limits(const ChildLimits& limits, int pipe_end)
{
    (void)prctl(PR_SET_PDEATHSIG, SIGKILL);
    (void)prctl(PR_SET_NAME, "estampe-read");
    take_default_signals();
    const int nowhere = open("/dev/null", O_RDWR | O_CLOEXEC);
    if (nowhere >= 0)
        for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
            (void)dup2(nowhere, stream);
    drop_shared(pipe_end);
    limit_resources(limits.cpu_s, limits.memory_bytes);
    (void)forbid_files(limits.scope);
    (void)forbid_system_calls();
}

void write_to_pipe(int pipe_end, std::span<const std::byte> bytes)
{
    while (!bytes.empty()) {
        const ssize_t count = write(pipe_end, bytes.data(), bytes.size());
        if (count < 0 && errno != EINTR)
            _exit(lost_its_pipe);
        bytes = bytes.subspan(static_cast<size_t>(std::max<ssize_t>(count, 0)));
    }
}

void do_work(ByteWriter& writer, const std::function<Send()>& work)
{
    const ProgressWatch watch([&writer](double share) {
        send(writer, Message::progress);
        send(writer, share);
        writer.flush();
        return true;
    });
    bool has_begun_result = false;
    try {
        const Send send_result = work();
        has_begun_result = true;
        send(writer, Message::result);
        send_result(writer);
        send(writer, end_mark);
    } catch (const std::bad_alloc&) {
        if (has_begun_result)
            _exit(lacked_memory);
        send(writer, Message::out_of_memory);
    } catch (const Error& error) {
        send(writer, Message::error);
        send(writer, parts_of(error));
    } catch (const std::exception& error) {
        send(writer, Message::error);
        send(writer, ErrorParts{.what = error.what(), .where = {}, .remedy = {}, .is_outside_scope = false});
    }
}

[[noreturn]] void be_child(int pipe_end, const std::function<Send()>& work, const ChildLimits& limits)
{
    // An exception that left this function would run on in the parent's code.
    try {
        ByteWriter writer([pipe_end](std::span<const std::byte> bytes) { write_to_pipe(pipe_end, bytes); });
        enter_limits(limits, pipe_end);
        do_work(writer, work);
        writer.flush();
    } catch (const std::bad_alloc&) {
        _exit(lacked_memory);
    } catch (...) {
        _exit(failed_outside_work);
    }
    // Ends the child process without running destructors and exit handlers, which belong to the parent
    // process.
    _exit(0);
}

// The parent process

using Clock = std::chrono::steady_clock;

/// A running child process. The destructor ends it.
class Running {
public:
    Running(pid_t process, Descriptor pipe_end, double wall_s)
        : process_(process), pipe_end_(std::move(pipe_end)),
          end_(Clock::now() +
               std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(wall_s)))
    {
    }

    ~Running()
    {
        if (process_ > 0)
            end();
    }

    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;

    /// Reads some bytes. Returns 0 if the child has closed the pipe or has had its time. While it waits,
    /// repeats the progress, so that the job can be cancelled.
    size_t read_some(std::span<std::byte> target)
    {
        constexpr int tick_ms = 100;
        while (true) {
            if (Clock::now() >= end_) {
                is_late_ = true;
                return 0;
            }
            pollfd waiting{.fd = pipe_end_.number(), .events = POLLIN, .revents = 0};
            const int ready = poll(&waiting, 1, tick_ms);
            if (ready == 0)
                report_progress(share_);
            if (ready <= 0)
                continue;
            const ssize_t count = read(pipe_end_.number(), target.data(), target.size());
            if (count >= 0 || errno != EINTR)
                return static_cast<size_t>(std::max<ssize_t>(count, 0));
        }
    }

    void take_progress(double share)
    {
        share_ = std::clamp(share, 0.0, 1.0);
        report_progress(share_);
    }

    /// Waits until the child has ended. Ends it first if it has had its time, or if it closed the pipe but
    /// goes on. Returns its status.
    int wait()
    {
        constexpr int most_tries = 1000;
        int status = 0;
        pid_t ended = 0;
        for (int i = 0; i < most_tries && ended == 0 && !is_late_; ++i) {
            ended = waitpid(process_, &status, WNOHANG);
            if (ended == 0)
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        if (ended == 0)
            end();
        process_ = -1;
        return status;
    }

    [[nodiscard]] bool is_late() const { return is_late_; }

private:
    void end() const
    {
        (void)kill(process_, SIGKILL);
        while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
        }
    }

    pid_t process_;
    Descriptor pipe_end_;
    Clock::time_point end_;
    double share_ = 0.0;
    bool is_late_ = false;
};

[[noreturn]] void fail_for_memory(const ChildLimits& limits, const std::string& where)
{
    const uint64_t job_bytes = JobLimits::of_thread().memory_bytes;
    if (limits.memory_bytes == job_bytes)
        throw Error(fmt::format("reading it needs more memory than {}, the limit of --max-memory",
                                in_bytes(job_bytes)),
                    where, "raise the limit");
    throw Error("reading it takes more memory than a file of this size should", where, try_others);
}

/// Tells why a child process ended without a complete message.
[[noreturn]] void fail_by_status(Running& running, const ChildLimits& limits, const std::string& where)
{
    const int status = running.wait();
    if (running.is_late() || (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU))
        throw Error("reading it took too long, and was given up", where, try_others);
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL)
        throw Error("reading it was ended by the system, which may be short of memory", where, try_others);
    if (WIFSIGNALED(status))
        throw Error(fmt::format("reading it crashed (signal {})", WTERMSIG(status)), where, try_others);
    if (WIFEXITED(status) && WEXITSTATUS(status) == lacked_memory)
        fail_for_memory(limits, where);
    throw Error("reading it failed without a word", where, try_others);
}

/// Thrown when the bytes of the child end before its message is complete.
class EndsEarly : public std::exception {};

[[noreturn]] void throw_error(ByteReader& reader, const std::string& where)
{
    constexpr size_t most_characters = 4000;
    ErrorParts error;
    receive(reader, error);
    for (std::string* const part : {&error.what, &error.where, &error.remedy})
        part->resize(std::min(part->size(), most_characters));
    if (error.where.empty() && error.remedy.empty())
        error.remedy = try_others;
    const std::string& place = error.where.empty() ? where : error.where;
    if (error.is_outside_scope)
        throw OutsideScope(error.what, place, error.remedy);
    throw Error(error.what, place, error.remedy);
}

void take_messages(Running& running, const std::function<void(ByteReader&)>& receive_result,
                   const ChildLimits& limits, const std::string& where)
{
    ByteReader reader(
        [&running](std::span<std::byte> target) {
            const size_t count = running.read_some(target);
            return count > 0 ? count : throw EndsEarly();
        },
        limits.memory_bytes, where);
    for (Message message = Message::progress; message != Message::result;) {
        receive(reader, message);
        switch (message) {
        case Message::progress: {
            double share = 0.0;
            receive(reader, share);
            running.take_progress(share);
            break;
        }
        case Message::result:
            break;
        case Message::error:
            throw_error(reader, where);
        case Message::out_of_memory:
            fail_for_memory(limits, where);
        }
    }
    receive_result(reader);
    uint32_t mark = 0;
    receive(reader, mark);
    if (mark != end_mark)
        reader.damaged();
}

struct Pipe {
    Descriptor from_child;
    Descriptor to_parent;
};

Pipe open_pipe(const std::string& where)
{
    std::array<int, 2> numbers{};
    if (pipe2(numbers.data(), O_CLOEXEC) != 0)
        throw Error(fmt::format("cannot open a pipe ({})", std::strerror(errno)), where);
    Pipe ends{.from_child = Descriptor(numbers[0]), .to_parent = Descriptor(numbers[1])};
    constexpr int pipe_bytes = 1 << 20; // fewer changes between the two processes
    (void)fcntl(numbers[0], F_SETPIPE_SZ, pipe_bytes);
    // The child replaces the standard streams. If this process has closed one of them, the pipe may have its
    // number.
    if (numbers[1] <= STDERR_FILENO) {
        const int higher = fcntl(numbers[1], F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
        if (higher < 0)
            throw Error(fmt::format("cannot open a pipe ({})", std::strerror(errno)), where);
        ends.to_parent.reset(higher);
    }
    return ends;
}

} // namespace

void run(const std::function<Send()>& work, const std::function<void(ByteReader&)>& receive,
         const ChildLimits& limits, const std::string& where)
{
    auto [from_child, to_parent] = open_pipe(where);
    const pid_t process = fork();
    if (process == 0)
        be_child(to_parent.number(), work, limits);
    const int fork_errno = errno;
    to_parent.reset(-1);
    if (process < 0)
        throw Error(fmt::format("cannot start a process to read it in ({})", std::strerror(fork_errno)),
                    where);
    Running running(process, std::move(from_child), limits.wall_s);
    try {
        take_messages(running, receive, limits, where);
    } catch (const EndsEarly&) {
        fail_by_status(running, limits, where);
    } catch (const std::bad_alloc&) {
        throw Error("does not fit into memory", where);
    }
}

} // namespace child

ChildLimits limits_for_file(const std::filesystem::path& path, const ReadScope& scope)
{
    // Half a minute suffices for the largest picture and for a hundred million vertices. A small file may
    // name some hundreds of pictures beside it.
    constexpr uint64_t base_s = 600;
    constexpr uint64_t each_mebibyte_s = 4;
    constexpr uint64_t most_s = 7200;
    // Twice the memory of the largest pictures that a scene may have.
    constexpr uint64_t base_bytes = uint64_t{4} << 30U;
    constexpr uint64_t bytes_each_byte = 64;
    std::error_code failed;
    const uintmax_t found = std::filesystem::file_size(path, failed);
    const uint64_t size = failed ? 0 : std::min<uint64_t>(found, uint64_t{1} << 40U);
    ChildLimits limits{.scope = scope};
    limits.cpu_s = static_cast<uint32_t>(std::min(base_s + each_mebibyte_s * (size >> 20U), most_s));
    limits.wall_s = 2.0 * limits.cpu_s;
    // A small file may name large buffers beside it.
    constexpr uint64_t most_bytes = uint64_t{1} << 40U;
    // What a decoder needs beside its buffers. Its buffers are estimated before they are allocated, and an
    // estimate tells more than an allocation that fails.
    constexpr uint64_t least_bytes = uint64_t{256} << 20U;
    limits.memory_bytes = std::min({std::max(base_bytes + bytes_each_byte * size, free_memory_bytes() / 2),
                                    most_bytes, std::max(JobLimits::of_thread().memory_bytes, least_bytes)});
    return limits;
}

} // namespace estampe
