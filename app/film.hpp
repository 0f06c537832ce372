// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "options.hpp"

namespace estampe::app {

/// Draws the frames that `command.film` asks for, and the film of them. Throws Error when a signal stopped
/// it, once the frame in hand is drawn and all that was drawn is whole.
void draw_film(const RenderCommand& command);

/// What drawing alone took.
struct FilmCost {
    double drawing_s = 0.0;     ///< of all frames, by the clock on the wall
    std::vector<double> gpu_ms; ///< of those whose passes were not timed; of several samples, of one
    uint32_t timed_frames = 0;  ///< the others
    std::map<std::string, double> gpu_ms_of_passes; ///< of these
};

/// The same with a renderer that has the scene. Signals have to be watched, as tell_of_signals() does.
FilmCost draw_film(Renderer& renderer, const Scene& scene, const RenderCommand& command);

} // namespace estampe::app
