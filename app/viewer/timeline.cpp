// SPDX-License-Identifier: MIT
#include "viewer/timeline.hpp"

#include <algorithm>
#include <cmath>

namespace estampe::viewer {

void Timeline::advance(double seconds)
{
    if (!is_playing || !moves()) {
        return;
    }
    time_s += seconds * speed;
    if (is_endless || (time_s >= 0.0 && time_s < length_s)) {
        return;
    }
    if (loops) {
        time_s -= length_s * std::floor(time_s / length_s);
    } else {
        time_s = std::clamp(time_s, 0.0, length_s);
        is_playing = false;
    }
}

void Timeline::seek(double moment_s)
{
    if (moves()) {
        time_s = is_endless ? std::max(moment_s, 0.0) : std::clamp(moment_s, 0.0, length_s);
    }
}

void Timeline::toggle_playing()
{
    if (!moves()) {
        return;
    }
    is_playing = !is_playing;
    if (is_playing && !is_endless && !loops && time_s >= length_s) {
        time_s = 0.0;
    }
}

} // namespace estampe::viewer
