// SPDX-License-Identifier: MIT
#pragma once

// The flow of ink: waves of a stream function, and flow maps from pictures.

#include <array>
#include <string>
#include <vector>

#include "techniques/ink/ink.glsl.h"
#include "techniques/ink/ink_style.hpp"

namespace estampe::ink {

/// One wave of the ink's stream function, and the wave's motion.
struct Wave {
    shared::InkWave wave;
    double phase = 0.0; ///< phase in turns at time 0
    double turns_per_s = 0.0;
};

using Waves = std::array<Wave, shared::ink_wave_count>;

/// Makes the waves of ink on the page. The root mean square velocity of the waves is `swirl_mm_per_s`.
[[nodiscard]] Waves page_waves(const InkStyle& style);

/// Makes the waves of ink on the unit sphere around the eye, where one radian spans `mm_per_rad` of the page.
[[nodiscard]] Waves sphere_waves(const InkStyle& style, float mm_per_rad);

/// Phase of each wave at `time_s`, in turns, 0 to 1.
[[nodiscard]] std::array<float, shared::ink_wave_count> phases_at(const Waves& waves, double time_s);

/// The stream function of waves and wind at a place of the page, in square millimetres per second.
[[nodiscard]] float stream_at(const Waves& waves, const std::array<float, shared::ink_wave_count>& phases,
                              glm::vec2 wind_mm_per_s, glm::vec2 place_mm);

/// The style's wind that moves ink, in mm/s to the right and down.
[[nodiscard]] glm::vec2 wind_mm_per_s(const InkStyle& style);

/// Reads the velocities of a flow map picture, `shared::ink_map_side` rows and columns, row by row. Red is
///       the speed to the right, green the speed down; a channel's middle value means no flow. Throws Error
///       with the file's name if the file is no picture or lies outside of `scope`.
[[nodiscard]] std::vector<glm::vec2> read_flow(const std::string& path, const ReadScope& scope = {});

/// Fits a stream function at the nodes of `velocities`, so that the function's flow on a page of `page_mm` is
/// nearest to the velocities. The divergent part of the velocities is lost. Cost: some milliseconds.
[[nodiscard]] std::vector<float> stream_of_flow(const std::vector<glm::vec2>& velocities, glm::vec2 page_mm);

} // namespace estampe::ink
