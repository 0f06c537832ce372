// SPDX-License-Identifier: MIT
#pragma once

// What the program says on stderr while it works: warnings, notes, how far it is.

#include <chrono>
#include <string>
#include <vector>

namespace estampe::app {

using Clock = std::chrono::steady_clock;

[[nodiscard]] inline double seconds_since(Clock::time_point start)
{
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Writes "estampe: warning: ..." to standard error for each.
void print_warnings(const std::vector<std::string>& warnings);

/// Writes "estampe: note: ..." to standard error for each.
void print_notes(const std::vector<std::string>& notes);

/// How far a long job is and how long it still takes, on stderr: in place on a terminal, else a line for
/// every tenth.
class Progress {
public:
    /// Of a job that begins with `done` of it, 0 to 1, behind it.
    Progress(std::string job, double done);

    /// `done` is followed by `what`, such as "frame 3 of 48".
    void show(double done, const std::string& what = {});

    /// Takes the line off a terminal, for others to write there.
    void clear() const;

private:
    std::string job_;
    bool is_terminal_;
    double first_;
    double next_;
    Clock::time_point start_ = Clock::now();
};

} // namespace estampe::app
