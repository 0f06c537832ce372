// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "clock.hpp"

namespace estampe::app {

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
