// SPDX-License-Identifier: MIT
#pragma once

// Long jobs: background threads and progress reports.

#include <functional>
#include <future>

namespace estampe {

/// Launch policy of std::async for background work: a new thread, or, if no thread can be started, the thread
/// that requests the result.
inline constexpr std::launch launch_if_possible = std::launch::async | std::launch::deferred;

/// Receives the progress of long jobs that run in the current thread, until it is destroyed. Each thread can
/// have only one ProgressWatch at a time. Jobs report with report_progress().
class ProgressWatch {
public:
    /// Starts to receive progress. `go_on` receives the share of the job that is done, 0 to 1, and returns
    /// whether the job should continue.
    explicit ProgressWatch(std::function<bool(double share)> go_on);
    ~ProgressWatch();
    ProgressWatch(const ProgressWatch&) = delete;
    ProgressWatch& operator=(const ProgressWatch&) = delete;
};

/// Reports the progress of a job to the ProgressWatch of this thread, if any. Throws Error if the watch asks
/// to stop, TimeIsUp if the time limit of this thread is over.
void report_progress(double share);

} // namespace estampe
