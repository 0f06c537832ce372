// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <map>
#include <string>
#include <vector>

#include <estampe/renderer.hpp>

#include "core/spread.hpp"

namespace estampe::bench {

/// Measures wall time from its construction on.
class WallClock {
public:
    [[nodiscard]] double ms() const
    {
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin_).count();
    }

private:
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// GPU time of all passes together.
[[nodiscard]] double sum_ms(const std::vector<PassTiming>& passes);

/// What repeated measurements of one thing took.
class Rounds {
public:
    /// One round, and the passes that it consists of if they were timed.
    void add(double ms, const std::vector<PassTiming>& passes = {});

    [[nodiscard]] const std::vector<double>& times_ms() const { return times_ms_; }

    // These require at least one round.
    [[nodiscard]] double mean_ms() const;
    [[nodiscard]] double most_ms() const;

    /// "1.234 ms (1.200 to 1.300)": median and quartiles.
    [[nodiscard]] std::string text() const;

    /// A line for each pass, the most expensive first: its name, its mean time per round, and its time in the
    /// slowest round.
    [[nodiscard]] std::string passes_table() const;

private:
    std::vector<double> times_ms_;
    std::map<std::string, double> passes_ms_;  ///< of all rounds
    std::map<std::string, double> slowest_ms_; ///< of the slowest round
};

} // namespace estampe::bench
