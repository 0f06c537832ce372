// SPDX-License-Identifier: MIT
#pragma once

// Automatic exposure: a histogram of the page's light, to which the exposure adapts over time.

#include <optional>

#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"
#include "techniques/light/light.glsl.h"
#include "techniques/light/light.hpp"

namespace estampe::light {

/// The automatic exposure, kept from picture to picture.
class ExposureMemory {
public:
    /// Prepares for a picture at scene time `time_s`, and returns how many stops the exposure may change;
    /// negative: no limit. The exposure starts again after a jump back in time or after another metering
    /// mode.
    [[nodiscard]] float prepare(gpu::Device& device, const LightStyle& style, double time_s);

    /// Call this before the next picture shows another scene.
    void forget() { time_s_.reset(); }

    /// Scene time of the last picture; none if its exposure was not metered by the page.
    [[nodiscard]] const std::optional<double>& time_s() const { return time_s_; }

    /// Continues from a picture at scene time `time_s`.
    void recall(gpu::Buffer state, double time_s)
    {
        state_ = std::move(state);
        time_s_ = time_s;
    }

    /// Holds shared::ExposureState.
    [[nodiscard]] gpu::Buffer& buffer() { return state_; }

private:
    gpu::Buffer state_;
    std::optional<double> time_s_; ///< scene time of the last picture
};

struct ExposureInputs {
    gpu::ImageId light;
    gpu::ImageId draw;
    gpu::BufferId state; ///< ExposureState, all zero before the first frame
    bool adapts = true;  ///< false: reuses the last frame's exposure, for further samples of a picture
    float compensation_stops = 0.0F; ///< brightens the picture beyond the metered exposure
    float most_change_stops = -1.0F; ///< largest change since the last frame; negative: no limit
    glm::uvec2 size_px{0};
};

struct Exposed {
    gpu::ImageId light;
    gpu::BufferId state;
};

/// Scales the light so that its mean logarithm over the metered pixels becomes that of 1. Metered are lit
/// pixels from the 70th to the 90th percentile of brightness. Without lit pixels the exposure stays.
///
/// Writes  the scaled light; the state
/// Cost    two full-screen dispatches and one of a single thread
[[nodiscard]] Exposed add_exposure(gpu::Graph& graph, const ExposureInputs& in);

} // namespace estampe::light
