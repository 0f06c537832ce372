// SPDX-License-Identifier: MIT
#include "viewer/resolution.hpp"

#include <algorithm>
#include <cmath>

namespace estampe::viewer {

void Resolution::drawn(double scale, double seconds)
{
    constexpr double step = 1.0 / 16.0;
    constexpr double room = 0.9; ///< for what comes beside drawing
    if (seconds > wanted_s && slow_s_ == 0.0) {
        slow_s_ = seconds;
        return;
    }
    const double counts_s = slow_s_ > 0.0 ? std::min(slow_s_, seconds) : seconds;
    slow_s_ = seconds > wanted_s ? seconds : 0.0;
    // Time goes as pixels do; the part that does not is met by going there in several steps.
    const double fitting = scale * std::sqrt(room * wanted_s / std::max(counts_s, 1e-4));
    const double next = std::clamp(std::floor(fitting / step) * step, least, 1.0);
    if (next < scale_ && counts_s > wanted_s) {
        scale_ = next;
        slow_s_ = 0.0;
    } else if (next > scale_) {
        // There would be room even if all time went as pixels do, so it does not go to and fro. Never twice
        // as many pixels at once.
        scale_ = std::min(next, std::max(scale_ + step, 1.4 * scale_));
    }
}

} // namespace estampe::viewer
