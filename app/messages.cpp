// SPDX-License-Identifier: MIT
#include "messages.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>

#include <unistd.h>

#include <fmt/format.h>

#include "core/text.hpp"

namespace estampe::app {

void print_warnings(const std::vector<std::string>& warnings)
{
    for (const std::string& warning : warnings) {
        say(fmt::format("estampe: warning: {}\n", shortened(one_line(warning))));
    }
}

void print_notes(const std::vector<std::string>& notes)
{
    for (const std::string& note : notes) {
        say(fmt::format("estampe: note: {}\n", shortened(one_line(note))));
    }
}

namespace {

std::string in_words(double seconds)
{
    const int64_t whole = std::llround(seconds);
    return whole < 60     ? fmt::format("{} s", whole)
           : whole < 3600 ? fmt::format("{} min {} s", whole / 60, whole % 60)
                          : fmt::format("{} h {} min", whole / 3600, whole / 60 % 60);
}

} // namespace

Progress::Progress(std::string job, double done)
    : job_(std::move(job)), is_terminal_(isatty(STDERR_FILENO) != 0), first_(done), next_(done)
{
}

void Progress::show(double done, const std::string& what)
{
    if (!is_terminal_ && done < next_) {
        return;
    }
    next_ = done + 0.1;
    const double share = (done - first_) / std::max(1.0 - first_, 1e-9);
    const double spent_s = seconds_since(start_);
    say(fmt::format("{}estampe: {}: {:.0f} %{}{}{}", is_terminal_ ? "\r\x1b[K" : "", job_, 100.0 * done,
                    what.empty() ? "" : ", " + what,
                    share > 0.0 ? fmt::format(", {} left", in_words(spent_s * (1.0 - share) / share)) : "",
                    is_terminal_ ? "" : "\n"));
    std::fflush(stderr);
}

void Progress::clear() const
{
    if (is_terminal_) {
        say("\r\x1b[K");
    }
}

} // namespace estampe::app
