// SPDX-License-Identifier: MIT
#include "techniques/light/exposure/exposure.hpp"

#include "gpu/resources.hpp"
#include "shaders/adapt_comp.hpp"
#include "shaders/expose_comp.hpp"
#include "shaders/meter_comp.hpp"

namespace estampe::light {

float ExposureMemory::prepare(gpu::Device& device, const LightStyle& style, double time_s)
{
    const bool meters = style.metering == Metering::page;
    const bool goes_on = meters && time_s_ && time_s >= *time_s_ && !state_.empty();
    if (!goes_on && (meters || state_.empty())) {
        state_ = gpu::upload_buffer(device, "exposure", std::vector<shared::ExposureState>(1));
    }
    const bool is_slow = goes_on && style.adapt_stops_per_s > 0.0F;
    const float most = is_slow ? style.adapt_stops_per_s * static_cast<float>(time_s - *time_s_) : -1.0F;
    time_s_ = meters ? std::optional(time_s) : std::nullopt;
    return most;
}

Exposed add_exposure(gpu::Graph& graph, const ExposureInputs& in)
{
    gpu::BufferId state = in.state;
    if (in.adapts) {
        auto meter = graph.compute("light/meter", shaders::meter_comp);
        meter.sample(in.light).sample(in.draw);
        state = meter.modify(state);
        meter.dispatch_over(in.size_px.x, in.size_px.y);
        auto adapt = graph.compute("light/adapt", shaders::adapt_comp);
        state = adapt.modify(state);
        adapt
            .push(shared::AdaptConstants{.compensation_stops = in.compensation_stops,
                                         .most_change_stops = in.most_change_stops})
            .dispatch(1);
    }
    auto expose = graph.compute("light/expose", shaders::expose_comp);
    expose.sample(in.light).sample(in.draw).read(state);
    const gpu::ImageId light = expose.write(graph.image(
        "light/exposed", {.width = in.size_px.x, .height = in.size_px.y, .format = gpu::Format::rgba16f}));
    expose.dispatch_over(in.size_px.x, in.size_px.y);
    return {.light = light, .state = state};
}

} // namespace estampe::light
