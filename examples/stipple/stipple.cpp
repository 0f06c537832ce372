// SPDX-License-Identifier: MIT
#include "stipple.hpp"

#include <algorithm>

#include "shaders/stipple_comp.hpp"
#include "stipple.glsl.h"

namespace estampe::stipple {

gpu::ImageId add_stipple(gpu::Graph& graph, const StippleInputs& in, const StippleStyle& style)
{
    constexpr float least_cell_px = 2.0F; // in smaller cells a dot would reach beyond the neighbouring cells
    auto pass = graph.compute("stipple", shaders::stipple_comp);
    pass.sample(in.darkness);
    const gpu::ImageId ink = pass.write(graph.image(
        "stipple/ink", {.width = in.size_px.x, .height = in.size_px.y, .format = gpu::Format::r16f}));
    pass.push(
            shared::StippleConstants{.size_px = in.size_px,
                                     .cell_px = std::max(style.spacing_mm * in.pixels_per_mm, least_cell_px),
                                     .jitter = style.jitter,
                                     .seed = 7})
        .dispatch_over(in.size_px.x, in.size_px.y);
    return ink;
}

} // namespace estampe::stipple
