// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <estampe/trails.hpp>

namespace estampe::terrain {

/// Something pressed in at a moment.
struct TimedStamp {
    TrailStamp stamp;
    double time_s = 0.0;
};

/// What a track presses in, one after the other: prints to the left and to the right, no two quite alike, or
/// short drags. The curve is Catmull and Rom's, "A Class of Local Interpolating Splines", 1974. Cost: linear
/// in its length.
[[nodiscard]] std::vector<TimedStamp> stamps_of(const TerrainTrack& track);

} // namespace estampe::terrain
