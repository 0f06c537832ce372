// SPDX-License-Identifier: MIT
#include "techniques/haze/haze.hpp"

#include <algorithm>
#include <cmath>

#include "shaders/haze_comp.hpp"
#include "shaders/haze_left_comp.hpp"
#include "style/parameter.hpp"
#include "techniques/haze/haze.glsl.h"

namespace estampe::haze {
namespace {

shared::HazeConstants constants_of(const HazeInputs& in, const HazeStyle& style)
{
    return {.start_m = style.start_m,
            .halves_per_m = 1.0F / style.reach_m,
            .ink = style.ink,
            .line_reach_px = static_cast<uint32_t>(std::ceil(std::max(in.line_half_px, 0.0F))) + 1U};
}

} // namespace

HazeLayers add_haze(gpu::Graph& graph, const HazeInputs& in, const HazeStyle& style, gpu::ImageId sky,
                    const HazeLayers& layers)
{
    auto pass = graph.compute("haze", shaders::haze_comp);
    pass.uniform(in.frame).sample(in.depth).sample(sky);
    const HazeLayers faded{.wash = pass.modify(layers.wash),
                           .hatch = pass.modify(layers.hatch),
                           .lines = pass.modify(layers.lines)};
    pass.read(in.tiles.value_or(in.frame)).variant(in.tiles ? shared::haze_has_tiles : 0U);
    pass.push(constants_of(in, style));
    if (in.tiles) {
        pass.dispatch_indirect(*in.tiles);
    } else {
        pass.dispatch_over(in.size_px.x, in.size_px.y);
    }
    return faded;
}

gpu::BufferId add_ink_left(gpu::Graph& graph, const HazeInputs& in, const HazeStyle& style)
{
    auto pass = graph.compute("haze/left", shaders::haze_left_comp);
    pass.uniform(in.frame).sample(in.depth);
    const gpu::BufferId left = pass.write(
        graph.buffer("haze/left", {.size_bytes = sizeof(glm::vec2) * in.size_px.x * in.size_px.y}));
    pass.push(constants_of(in, style)).dispatch_over(in.size_px.x, in.size_px.y);
    return left;
}

const style::Table<HazeStyle>& haze_table()
{
    static const auto table =
        style::Table<HazeStyle>("haze",
                                "Haze: distant parts fade into the sky, or take on the colour of the air")
            .auto_toggle("enabled", &HazeStyle::enabled,
                         "Lets distant parts of the scene fade. true: always; false: never; auto: if the "
                         "scene has a terrain.")
            .number("start_m", &HazeStyle::start_m, {0.0F, 1e6F}, "m",
                    "Distance from the camera at which haze begins: less fades nearer parts, too")
            .number("reach_m", &HazeStyle::reach_m, {0.01F, 1e6F}, "m",
                    "Distance beyond haze.start_m at which a colour has faded by half. At twice this "
                    "distance, three quarters have faded. Less gives denser haze.")
            .number("ink", &HazeStyle::ink, {0.0F, 16.0F}, "",
                    "How much faster strokes and lines fade with distance than colour fades. More leaves "
                    "only colour in the distance, 0 keeps strokes and lines at any distance.")
            .number("tint", &HazeStyle::tint, {0.0F, 1.0F}, "",
                    "How much far objects take on the colour of the air. 0 keeps their own colour, 1 gives "
                    "them the colour of the air in the far distance. Works without haze.enabled.")
            .color("tint_color", &HazeStyle::tint_color,
                   "Colour of the air that tints far objects. Only used when haze.tint is above 0.")
            .number("tint_distance_m", &HazeStyle::tint_distance_m, {0.001F, 1e6F}, "m",
                    "Distance at which objects have taken on half of the air's colour: less tints nearer "
                    "objects. Only used when haze.tint is above 0.")
            .number("hatching", &HazeStyle::hatching, {0.0F, 1.0F}, "",
                    "Share of the hatching's darkness that is left in the far distance. 0 fades to white "
                    "paper, 1 does not fade. Works without haze.enabled.")
            .number("hatching_distance_m", &HazeStyle::hatching_distance_m, {0.001F, 1e6F}, "m",
                    "Distance at which hatching has faded halfway: less fades nearer to the camera. Only "
                    "used when haze.hatching is below 1.");
    return table;
}

} // namespace estampe::haze
