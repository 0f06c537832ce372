// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include <estampe/scene.hpp>
#include <estampe/style.hpp>

#include "world_animator.hpp"

namespace estampe::viewer {

/// What was seen in the view while it was recorded: not pictures, but from where, when and how, so that a
/// film of it is drawn as finely as any, however slow the view was.
class Take {
public:
    struct Sample {
        double at_s = 0.0; ///< since it began
        Camera camera;
        double time_s = 0.0; ///< of the animation
        Index animation = 0;
        std::shared_ptr<const app::ChosenStyle> style;
    };

    /// In the order of time.
    void add(Sample sample) { samples_.push_back(std::move(sample)); }

    [[nodiscard]] bool empty() const { return samples_.empty(); }

    [[nodiscard]] double length_s() const { return samples_.empty() ? 0.0 : samples_.back().at_s; }

    /// Between two samples the camera goes straight, and so does the animation where it ran on; all else
    /// holds until the later one. To be called where there are samples.
    [[nodiscard]] Sample at(double seconds) const;

private:
    std::vector<Sample> samples_;
};

} // namespace estampe::viewer
