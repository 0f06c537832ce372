// SPDX-License-Identifier: MIT
#pragma once

// Writes measured results as tables, JSON and plots.

#include <string>

#include <nlohmann/json.hpp>

#include "core/spread.hpp"
#include "lab/series.hpp"

namespace estampe::lab {

[[nodiscard]] std::string text_of(const BenchResult& result);
[[nodiscard]] std::string csv_of(const BenchResult& result);
[[nodiscard]] std::string json_of(const BenchResult& result);

/// Reads the output of json_of(). Throws Error that names the file if the file has another format.
[[nodiscard]] BenchResult read_bench_json(const std::string& path);

/// Plots cost over work on logarithmic axes, with a reference line of cost proportional to work.
[[nodiscard]] std::string plot_of(const BenchSeries& series, const BenchResult& result);

/// Ratio of the second result's cost to the first's, point by point, with an error range from the quartiles
/// of both. Throws Error if the results have no point in common.
[[nodiscard]] std::string comparison_of(const BenchResult& before, const BenchResult& after);

[[nodiscard]] inline nlohmann::ordered_json spread_json(const Spread& spread)
{
    return {{"low", spread.low}, {"median", spread.median}, {"high", spread.high}};
}

} // namespace estampe::lab
