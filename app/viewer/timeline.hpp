// SPDX-License-Identifier: MIT
#pragma once

#include <estampe/scene.hpp>

namespace estampe::viewer {

/// Where the scene's animation is, and how it goes on.
struct Timeline {
    double time_s = 0.0;
    double length_s = 0.0; ///< 0: nothing moves
    double speed = 1.0;
    bool is_playing = false;
    bool loops = true;
    bool is_endless = false; ///< something moves for ever, and nothing is repeated
    Index animation = 0;

    [[nodiscard]] bool moves() const { return is_endless || length_s > 0.0; }

    /// Plays on by so much of the clock's time. At the end, if there is one, it begins again or stops.
    void advance(double seconds);
    /// To a moment, within the animation.
    void seek(double moment_s);
    void toggle_playing();
};

} // namespace estampe::viewer
