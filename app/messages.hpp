// SPDX-License-Identifier: MIT
#pragma once

// Messages of the program on stderr: warnings, notes, progress.

#include <chrono>
#include <string>
#include <vector>

namespace estampe::app {

using Clock = std::chrono::steady_clock;

[[nodiscard]] inline double seconds_since(Clock::time_point start)
{
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Writes "estampe: warning: ..." to stderr for each warning.
void print_warnings(const std::vector<std::string>& warnings);

/// Writes "estampe: note: ..." to stderr for each note.
void print_notes(const std::vector<std::string>& notes);

/// Shows progress and remaining time of a long job on stderr. A terminal line is updated in place; if stderr
/// is not a terminal, one line per tenth of the job is written.
class Progress {
public:
    /// Starts to show the progress of a job. `done`, 0 to 1, is the share of the job that is complete at the
    /// start.
    Progress(std::string job, double done);

    /// Shows that the share `done` of the job is complete, followed by `what`, such as "frame 3 of 48".
    void show(double done, const std::string& what = {});

    /// Clears the progress line of a terminal; call this before other output.
    void clear() const;

private:
    std::string job_;
    bool is_terminal_;
    double first_;
    double next_;
    Clock::time_point start_ = Clock::now();
};

} // namespace estampe::app
