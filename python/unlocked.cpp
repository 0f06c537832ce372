// SPDX-License-Identifier: MIT
// Python's global lock (GIL) and the end of the program.
#include <atomic>
#include <chrono>
#include <thread>

#include <unistd.h>

#include "bindings.hpp"

namespace estampe::python {
namespace {

std::atomic<int> unlocked_count = 0; ///< Number of living Unlocked, apart from those whose thread sleeps
std::atomic<bool> is_finished = false;
std::thread::id last_thread; ///< The thread that ends the program, once is_finished is set
const pid_t home_process = getpid();

/// Whether this thread must not hold the GIL any more.
bool must_sleep()
{
    return is_finished.load() && std::this_thread::get_id() != last_thread;
}

[[noreturn]] void sleep_forever()
{
    for (;;) {
        pause();
    }
}

} // namespace

Unlocked::Unlocked()
{
    // is_finished changes with the GIL held, so this thread is either counted or sees the end.
    if (must_sleep()) {
        state_ = PyEval_SaveThread();
        sleep_forever();
    }
    unlocked_count.fetch_add(1);
    state_ = PyEval_SaveThread();
}

Unlocked::~Unlocked()
{
    if (must_sleep()) {
        unlocked_count.fetch_sub(1);
        sleep_forever();
    }
    PyEval_RestoreThread(state_); // finish_threads() lets a thread that has come so far have the GIL
    unlocked_count.fetch_sub(1);
}

void finish_threads()
{
    if (getpid() != home_process) {
        return; // A forked process has no other threads, but the count of its parent
    }
    last_thread = std::this_thread::get_id();
    is_finished = true;
    const py::gil_scoped_release unlocked;
    while (unlocked_count.load() > 0) {
        constexpr std::chrono::milliseconds nap(1);
        std::this_thread::sleep_for(nap);
    }
}

} // namespace estampe::python
