// SPDX-License-Identifier: MIT
#pragma once

// Automatic exposure: a histogram of the page's light, to which the exposure adapts over time.

#include <optional>

#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"
#include "techniques/light/light.glsl.h"
#include "techniques/light/light.hpp"

namespace estampe::light {

/// Keeps the automatic exposure from picture to picture.
class ExposureMemory {
public:
    /// Prepares for a picture at scene time `time_s`, and returns how many stops the exposure may change;
    /// negative: no limit. The exposure starts new after a jump back in time or after another metering mode.
    [[nodiscard]] float prepare(gpu::Device& device, const LightStyle& style, double time_s);

    /// Discards the kept exposure. Call forget() before the next picture shows another scene.
    void forget() { time_s_.reset(); }

    /// Scene time of the last picture; empty if the last picture's exposure was not metered by the page.
    [[nodiscard]] const std::optional<double>& time_s() const { return time_s_; }

    /// Restores the exposure of a picture at scene time `time_s`, to continue from that exposure.
    void recall(gpu::Buffer state, double time_s)
    {
        state_ = std::move(state);
        time_s_ = time_s;
    }

    /// The device buffer with a shared::ExposureState record.
    [[nodiscard]] gpu::Buffer& buffer() { return state_; }

private:
    gpu::Buffer state_;
    std::optional<double> time_s_; ///< scene time of the last picture; empty if none is kept
};

struct ExposureInputs {
    gpu::ImageId light;
    gpu::ImageId draw;
    gpu::BufferId state; ///< ExposureState record; all zero before the first frame
    bool adapts = true;  ///< false: the last frame's exposure is used again, for further samples of a picture
    float compensation_stops = 0.0F; ///< stops by which the picture is brighter than metered
    /// Largest change of the exposure since the last frame; negative: no limit.
    float most_change_stops = -1.0F;
    glm::uvec2 size_px{0};
};

struct Exposed {
    gpu::ImageId light;
    gpu::BufferId state;
};

/// Scales the light so that the mean logarithm of the metered pixels' light becomes 0, the logarithm of 1.
/// The metered pixels are the lit ones from the 70th to the 90th percentile of brightness. Without lit pixels
/// the exposure stays.
///
/// Writes  the scaled light; the state
/// Cost    two full-screen dispatches and one of a single thread
[[nodiscard]] Exposed add_exposure(gpu::Graph& graph, const ExposureInputs& in);

} // namespace estampe::light
