// SPDX-License-Identifier: MIT
#pragma once

// Exposure by what is on the page: a histogram of its light, to which the eye adapts in time.

#include <optional>

#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"
#include "techniques/light/light.glsl.h"
#include "techniques/light/light.hpp"

namespace estampe::light {

/// What the eye is used to, from picture to picture.
class ExposureMemory {
public:
    /// Makes ready for a picture at a moment of the scene, and returns how many stops the exposure may
    /// change; negative: any. Going back in time, or another way of metering in between, makes the eye look
    /// afresh.
    [[nodiscard]] float prepare(gpu::Device& device, const LightStyle& style, double time_s);

    /// The next picture is of something else.
    void forget() { time_s_.reset(); }

    /// Of the last picture; nothing if its exposure was not metered.
    [[nodiscard]] const std::optional<double>& time_s() const { return time_s_; }

    /// The next picture follows on one at that moment.
    void recall(gpu::Buffer state, double time_s)
    {
        state_ = std::move(state);
        time_s_ = time_s;
    }

    /// ExposureState.
    [[nodiscard]] gpu::Buffer& buffer() { return state_; }

private:
    gpu::Buffer state_;
    std::optional<double> time_s_; ///< of the last picture
};

struct ExposureInputs {
    gpu::ImageId light;
    gpu::ImageId draw;
    gpu::BufferId state; ///< ExposureState, all zero before the first frame
    bool adapts = true;  ///< false: the exposure of the frame before, for further samples of a picture
    float compensation_stops = 0.0F; ///< brighter than metered
    float most_change_stops = -1.0F; ///< from the frame before; negative: any
    glm::uvec2 size_px{0};
};

struct Exposed {
    gpu::ImageId light;
    gpu::BufferId state;
};

/// Brightens the light so that the mean logarithm of the well-lit parts, from the seventieth to the ninetieth
/// percentile of the pixels that show something lit, comes to one. Where nothing is lit, the exposure stays.
///
/// Writes  light, as it was made; the state
/// Cost    two full-screen dispatches and one of a single thread
[[nodiscard]] Exposed add_exposure(gpu::Graph& graph, const ExposureInputs& in);

} // namespace estampe::light
