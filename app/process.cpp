// SPDX-License-Identifier: MIT
#include "process.hpp"

#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <system_error>
#include <thread>

#include <unistd.h>

#include "core/failure.hpp"
#include "core/file.hpp"
#include "piped_scene.hpp"

namespace estampe::app {
namespace {

constexpr std::array watched{SIGINT, SIGTERM, SIGHUP};
std::atomic<bool> is_told = false;
std::atomic<bool> is_to_stop = false;

sigset_t watched_set()
{
    sigset_t set;
    sigemptyset(&set);
    for (const int number : watched) {
        sigaddset(&set, number);
    }
    return set;
}

bool is_ignored(int number)
{
    struct sigaction action {};

    return sigaction(number, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

/// Ends the program by raising the signal, so that a shell can report which signal ended it.
[[noreturn]] void end_by(int number)
{
    remove_all_pending();
    remove_piped_scenes();
    std::signal(number, SIG_DFL);
    const sigset_t set = watched_set();
    pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
    kill(getpid(), number);
    _exit(1);
}

void wait_for_signals()
{
    const sigset_t set = watched_set();
    for (int number = 0; sigwait(&set, &number) == 0;) {
        if (is_ignored(number) && (!is_told || number == SIGHUP)) {
            continue; // The signal was ignored before, as nohup does with SIGHUP
        }
        if (is_told && !is_to_stop.exchange(true)) {
            continue;
        }
        end_by(number);
    }
}

} // namespace

void watch_signals()
{
    std::signal(SIGXFSZ, SIG_IGN);
    const sigset_t set = watched_set();
    // The signals are blocked in all threads that start later; a single thread waits for the signals.
    pthread_sigmask(SIG_BLOCK, &set, nullptr);
    try {
        std::thread(wait_for_signals).detach();
    } catch (const std::system_error&) {
        // Unblocked signals have their default effect: they end the program.
        pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
    }
}

namespace {

std::terminate_handler usual_end = nullptr;
pid_t own_id = 0;

bool is_out_of_memory()
{
    try {
        if (const std::exception_ptr thrown = std::current_exception()) {
            std::rethrow_exception(thrown);
        }
    } catch (const std::bad_alloc&) {
        return true;
    } catch (...) {
        return false;
    }
    return false;
}

[[noreturn]] void end_at_once()
{
    static std::atomic<bool> is_ending = false;
    thread_local bool is_ending_here = false;
    // A forked child must not delete the files of its parent.
    if (is_out_of_memory() && getpid() == own_id) {
        if (is_ending_here) {
            _exit(1); // Memory ran out while temporary files were deleted
        }
        while (is_ending.exchange(true)) {
            pause(); // Another thread ends the program
        }
        is_ending_here = true;
        for (const char* const part : {"estampe: error: ", out_of_memory, "\n"}) {
            static_cast<void>(std::fputs(part, stderr));
        }
        remove_all_pending();
        remove_piped_scenes();
        _exit(1);
    }
    usual_end();
    std::abort();
}

} // namespace

void end_well_without_memory()
{
    own_id = getpid();
    usual_end = std::set_terminate(end_at_once);
}

void tell_of_signals()
{
    is_told = true;
}

bool was_told_to_stop()
{
    return is_to_stop;
}

namespace {

/// Environment variable with which Mesa's shader compiler is configured.
constexpr const char* setting = "GALLIVM_PERF";

} // namespace

bool compile_quickly()
{
    return std::getenv(setting) == nullptr && setenv(setting, "nopt", 1) == 0;
}

void compile_well()
{
    unsetenv(setting);
}

void compile_quickly_if_soon_drawn(const RenderCommand& command)
{
    constexpr uint64_t most_pixels = uint64_t{1} << 22U;
    const DrawOptions& draw = command.draw;
    if (command.repeat == 1 && !command.film &&
        uint64_t{draw.page.width} * draw.page.height * draw.samples <= most_pixels) {
        compile_quickly();
    }
}

} // namespace estampe::app
