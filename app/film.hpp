// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "options.hpp"

namespace estampe::app {

/// Draws the frames that `command.film` asks for, and encodes the film. After a signal, finishes the current
/// frame, leaves all output complete, and throws Error.
void draw_film(const RenderCommand& command);

/// Time spent on drawing a film, without the time for writing files.
struct FilmCost {
    double drawing_s = 0.0;     ///< Wall time of all frames together
    std::vector<double> gpu_ms; ///< GPU time per sample, of the frames without timed passes
    uint32_t timed_frames = 0;  ///< Number of frames in which each pass was timed
    /// GPU time of each pass, summed over the frames with timed passes.
    std::map<std::string, double> gpu_ms_of_passes;
};

/// Draws a film with a renderer that already has the scene. Call tell_of_signals() first, so that a signal
/// can stop the film between two frames.
FilmCost draw_film(Renderer& renderer, const Scene& scene, const RenderCommand& command);

} // namespace estampe::app
