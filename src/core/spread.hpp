// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace estampe {

/// Median and quartiles of a measured quantity.
struct Spread {
    double low = 0.0;
    double median = 0.0;
    double high = 0.0;
};

/// Computes the median and quartiles of `values`, which must not be empty.
[[nodiscard]] inline Spread spread_of(std::vector<double> values)
{
    std::ranges::sort(values);
    const auto at = [&](double share) {
        return values[static_cast<size_t>(std::lround(share * static_cast<double>(values.size() - 1)))];
    };
    return {.low = at(0.25), .median = at(0.5), .high = at(0.75)};
}

/// Computes the median of `values`, which must not be empty.
[[nodiscard]] inline double median_of(std::vector<double> values)
{
    return spread_of(std::move(values)).median;
}

} // namespace estampe
