// SPDX-License-Identifier: MIT
#pragma once

// What takes long: in threads beside, and telling how far it is.

#include <functional>
#include <future>

namespace estampe {

/// How std::async is to run what has time: in a thread of its own at once, or, where no thread can be
/// started, when its result is asked for.
inline constexpr std::launch launch_if_possible = std::launch::async | std::launch::deferred;

/// Hears how far a long job of this thread is, for as long as it lives; one at a time. The job itself knows
/// nothing of it but report_progress().
class ProgressWatch {
public:
    /// `go_on` is told the share that is done, 0 to 1, and says whether the rest is still wanted.
    explicit ProgressWatch(std::function<bool(double share)> go_on);
    ~ProgressWatch();
    ProgressWatch(const ProgressWatch&) = delete;
    ProgressWatch& operator=(const ProgressWatch&) = delete;
};

/// Tells the watch of this thread, if there is one. Throws Error when the rest is not wanted.
void report_progress(double share);

} // namespace estampe
