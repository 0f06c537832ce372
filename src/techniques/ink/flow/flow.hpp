// SPDX-License-Identifier: MIT
#pragma once

// Where ink flows, as the shaders take it: waves of a stream function, and what a picture adds to it.

#include <array>
#include <string>
#include <vector>

#include "techniques/ink/ink.glsl.h"
#include "techniques/ink/ink_style.hpp"

namespace estampe::ink {

/// One wave of the stream function, and how it moves.
struct Wave {
    shared::InkWave wave;
    double phase = 0.0; ///< at the moment 0, in turns
    double turns_per_s = 0.0;
};

using Waves = std::array<Wave, shared::ink_wave_count>;

/// Waves on the page, whose velocity is `swirl_mm_per_s` on the root mean square.
[[nodiscard]] Waves page_waves(const InkStyle& style);

/// The same for the unit sphere around an eye that sees `mm_per_rad` of the page in a radian.
[[nodiscard]] Waves sphere_waves(const InkStyle& style, float mm_per_rad);

/// Of each wave at a moment, in turns, 0 to 1.
[[nodiscard]] std::array<float, shared::ink_wave_count> phases_at(const Waves& waves, double time_s);

/// The stream function of waves and wind at a place of the page, square millimetres a second.
[[nodiscard]] float stream_at(const Waves& waves, const std::array<float, shared::ink_wave_count>& phases,
                              glm::vec2 wind_mm_per_s, glm::vec2 place_mm);

/// In millimetres a second to the right and down.
[[nodiscard]] glm::vec2 wind_mm_per_s(const InkStyle& style);

/// Velocities of a picture of flow, `shared::ink_map_side` each way, row by row: red is to the right, green
/// is down, half of each is none. Throws Error naming the file when it is no picture.
[[nodiscard]] std::vector<glm::vec2> read_flow(const std::string& path);

/// The stream function whose flow on a page of that size is nearest to those velocities: what flows together
/// or apart in them is left out. At the same nodes. Cost: some milliseconds.
[[nodiscard]] std::vector<float> stream_of_flow(const std::vector<glm::vec2>& velocities, glm::vec2 page_mm);

} // namespace estampe::ink
