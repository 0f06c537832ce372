// SPDX-License-Identifier: MIT
#include "techniques/transparency/transparency.hpp"

#include <algorithm>

#include "gpu/transfers.hpp"
#include "shaders/sheet_comp.hpp"
#include "shaders/transparency_comp.hpp"
#include "style/parameter.hpp"
#include "techniques/transparency/transparency_variant.glsl.h"

namespace estampe::transparency {
namespace {

gpu::ImageDesc draw_image(glm::uvec2 size_px)
{
    return {.width = size_px.x, .height = size_px.y, .format = gpu::Format::r32ui};
}

gpu::ImageDesc color_image(glm::uvec2 size_px)
{
    return {.width = size_px.x, .height = size_px.y, .format = gpu::Format::rgba8};
}

/// Binds the data that describes transparent surfaces.
void bind_surfaces(gpu::Pass& pass, const TransparencyInputs& in)
{
    pass.uniform(in.frame).sample(in.solid_visibility, gpu::Format::rg32ui);
    pass.sample(in.triangles)
        .sample(in.posed_vertices)
        .sample(in.draws)
        .sample(in.rest_vertices)
        .sample(in.materials);
    for (const gpu::ImageId texture : in.textures) {
        pass.sample(texture, gpu::Sampling::linear_repeat);
    }
}

} // namespace

Transparency add_transparency(gpu::Graph& graph, const TransparencyInputs& in)
{
    const size_t layers = std::min<size_t>(in.layers.size(), most_layers);
    const auto blank = [&](gpu::ImageId image) {
        return in.tiles ? gpu::add_fill(graph, "screen/blank", image, glm::vec4(0.0F)) : image;
    };
    const gpu::ImageId blank_draw = blank(graph.image("screen/draw", draw_image(in.size_px)));
    const gpu::ImageId blank_color = blank(graph.image("screen/color", color_image(in.size_px)));
    auto pass = graph.compute("screen", shaders::transparency_comp);
    bind_surfaces(pass, in);
    for (size_t i = 0; i < most_layers; ++i) {
        pass.sample(in.layers[std::min(i, layers - 1)], gpu::Format::rg32ui);
    }
    const gpu::ImageId draw = in.tiles ? pass.modify(blank_draw) : pass.write(blank_draw);
    const gpu::ImageId color = in.tiles ? pass.modify(blank_color) : pass.write(blank_color);
    pass.read(in.tiles.value_or(in.solid_visibility));
    pass.variant(in.texture_classes | static_cast<uint32_t>(layers - 1) << shared::screen_layers_shift |
                 (in.tiles ? shared::screen_has_tiles : 0U));
    if (in.tiles) {
        pass.dispatch_indirect(*in.tiles);
    } else {
        pass.dispatch_over(in.size_px.x, in.size_px.y);
    }
    return {draw, color};
}

gpu::ImageId add_sheet(gpu::Graph& graph, const TransparencyInputs& in, gpu::BufferId layer,
                       gpu::ImageId painted, gpu::ImageId wash)
{
    auto pass = graph.compute("screen/sheet", shaders::sheet_comp);
    bind_surfaces(pass, in);
    pass.sample(layer, gpu::Format::rg32ui).sample(painted);
    const gpu::ImageId laid = pass.modify(wash);
    pass.variant(in.texture_classes).dispatch_over(in.size_px.x, in.size_px.y);
    return laid;
}

Transparency add_no_transparency(gpu::Graph& graph)
{
    return {gpu::add_filled_image(graph, "screen/no draw", draw_image(glm::uvec2(1)), glm::vec4(0.0F)),
            gpu::add_filled_image(graph, "screen/no color", color_image(glm::uvec2(1)), glm::vec4(0.0F))};
}

const style::Table<TransparencyStyle>& transparency_table()
{
    static const auto table =
        style::Table<TransparencyStyle>("transparency",
                                        "Transparent surfaces: how glass and other BLEND materials are drawn")
            .choice("mode", &TransparencyStyle::mode, {{"ink", Mode::ink}, {"sorted", Mode::sorted}},
                    "How see-through surfaces such as glass (BLEND materials of glTF) are drawn. ink: as one "
                    "flat tint over the things behind; sorted: each surface is lit and painted, from back to "
                    "front.")
            .integer("layers", &TransparencyStyle::layers, {1, most_sorted_layers}, "",
                     "Largest number of see-through surfaces that are drawn over each other, the nearest "
                     "first. More shows more surfaces behind each other and takes more time. At most 4 are "
                     "drawn when transparency.mode is ink.")
            .number("opaque_above", &TransparencyStyle::opaque_above, {0.02F, 1.0F}, "",
                    "Opacity from which parts of see-through surfaces are drawn as solid. Less gives more of "
                    "hair, leaves and feathers their own light, strokes and lines; only the softer rest is "
                    "see-through. 1 draws no part as solid.");
    return table;
}

} // namespace estampe::transparency
