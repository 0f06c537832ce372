// SPDX-License-Identifier: MIT
#pragma once

// What was measured, for people and for programs.

#include <string>

#include <nlohmann/json.hpp>

#include "core/spread.hpp"
#include "lab/series.hpp"

namespace estampe::lab {

[[nodiscard]] std::string text_of(const BenchResult& result);
[[nodiscard]] std::string csv_of(const BenchResult& result);
[[nodiscard]] std::string json_of(const BenchResult& result);

/// What json_of() wrote. Throws Error, naming the file, when it is nothing of the kind.
[[nodiscard]] BenchResult read_bench_json(const std::string& path);

/// Cost over work on logarithmic axes, beside a line that rises as the work does.
[[nodiscard]] std::string plot_of(const BenchSeries& series, const BenchResult& result);

/// Cost of the second by that of the first, point by point, with how far it may be off by the quartiles of
/// both. Throws Error when they have no point in common.
[[nodiscard]] std::string comparison_of(const BenchResult& before, const BenchResult& after);

[[nodiscard]] inline nlohmann::ordered_json spread_json(const Spread& spread)
{
    return {{"low", spread.low}, {"median", spread.median}, {"high", spread.high}};
}

} // namespace estampe::lab
