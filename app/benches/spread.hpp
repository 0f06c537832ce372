// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace estampe::app {

/// The middle of what was measured, and its quartiles.
struct Spread {
    double low = 0.0;
    double median = 0.0;
    double high = 0.0;
};

/// Of at least one value.
[[nodiscard]] inline Spread spread_of(std::vector<double> values)
{
    std::ranges::sort(values);
    const auto at = [&](double share) {
        return values[static_cast<size_t>(std::lround(share * static_cast<double>(values.size() - 1)))];
    };
    return {.low = at(0.25), .median = at(0.5), .high = at(0.75)};
}

} // namespace estampe::app
