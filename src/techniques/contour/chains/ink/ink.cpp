// SPDX-License-Identifier: MIT
#include "techniques/contour/chains/ink/ink.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

#include "gpu/resources.hpp"
#include "gpu/transfers.hpp"
#include "shaders/blank_page_comp.hpp"
#include "shaders/ink_brush_comp.hpp"
#include "shaders/ink_layer_comp.hpp"
#include "shaders/ink_pieces_comp.hpp"
#include "shaders/joints_comp.hpp"
#include "techniques/contour/chains/chains.glsl.h"
#include "techniques/contour/chains/chains.hpp"
#include "techniques/contour/chains/scan/scan.hpp"
#include "techniques/contour/chains/stroke/linked_lines.hpp"

namespace estampe::contour {
namespace {

/// Computes the next mip level: half as many columns and rows, but at least one column and one row.
std::vector<float> halved(const std::vector<float>& fine, size_t columns, size_t rows)
{
    const size_t step_x = columns > 1 ? 2 : 1;
    const size_t step_y = rows > 1 ? 2 : 1;
    std::vector<float> coarse;
    coarse.reserve(fine.size() / (step_x * step_y));
    for (size_t y = 0; y < rows; y += step_y) {
        for (size_t x = 0; x < columns; x += step_x) {
            const size_t right = x + step_x - 1;
            const size_t below = y + step_y - 1;
            coarse.push_back(0.25F * (fine[y * columns + x] + fine[y * columns + right] +
                                      fine[below * columns + x] + fine[below * columns + right]));
        }
    }
    return coarse;
}

std::vector<std::byte> bytes_of(const std::vector<float>& ink)
{
    std::vector<std::byte> bytes;
    bytes.reserve(ink.size());
    for (const float value : ink) {
        bytes.push_back(static_cast<std::byte>(std::lround(255.0F * std::clamp(value, 0.0F, 1.0F))));
    }
    return bytes;
}

gpu::LayerPixels levels_of(const BrushStrip& strip)
{
    gpu::LayerPixels pixels;
    std::vector<float> level = strip.ink;
    size_t columns = shared::brush_columns;
    size_t rows = shared::brush_rows;
    pixels.levels.push_back(bytes_of(level));
    while (columns > 1 || rows > 1) {
        level = halved(level, columns, rows);
        columns = std::max<size_t>(columns / 2, 1);
        rows = std::max<size_t>(rows / 2, 1);
        pixels.levels.push_back(bytes_of(level));
    }
    return pixels;
}

} // namespace

BrushImages upload_brushes(gpu::Device& device, const BrushSet& brushes)
{
    const gpu::ImageDesc desc{.width = shared::brush_columns,
                              .height = shared::brush_rows,
                              .format = gpu::Format::r8,
                              .layers = static_cast<uint32_t>(brushes.strips.size()),
                              .mips = static_cast<uint32_t>(std::bit_width(shared::brush_columns))};
    BrushImages images{.strips = gpu::Image(device, "brushes of lines", desc, true),
                       .layer_of_use = brushes.strip_of_use};
    gpu::upload_layers(device, images.strips,
                       [&](uint32_t layer) { return levels_of(brushes.strips[layer]); });
    for (size_t use = 0; use < images.widths_of_use.size(); ++use) {
        const auto& strip = brushes.strip_of_use.at(use);
        images.widths_of_use.at(use) = strip ? brushes.strips[*strip].widths : 1.0F;
    }
    return images;
}

namespace {

/// The inked pixels of a page, before the conversion to an ink layer.
struct Inked {
    gpu::BufferId pixels; ///< one word per pixel: coverage and ink
    gpu::BufferId tiles;  ///< list of the tiles that have ink, see ink_tiles.glsl
};

/// Length in millimetres after which a brush repeats along the line; 0 if the brush stretches over the whole
/// stroke.
float period_mm(const BrushImages& brushes, uint32_t use, const ContourStyle& style)
{
    if (use == shared::brush_hidden) {
        return style.hidden.dash_mm + style.hidden.gap_mm;
    }
    if (style.brush_fit == BrushFit::stretch) {
        return 0.0F;
    }
    const float own_mm = brushes.widths_of_use.at(use) * width_on_page_mm(style, use);
    return style.brush_mm > 0.0F ? style.brush_mm : std::max(own_mm, 0.1F);
}

/// Returns the constants of ink_brush.comp. `grid_page_px` is the size of the page that the sample grid
/// (which finds samples by position) covers.
shared::BrushConstants brush_constants(const ContourInputs& in, const ContourStyle& style,
                                       glm::uvec2 grid_page_px)
{
    shared::BrushConstants constants{
        .width = in.size_px.x, .height = in.size_px.y, .grid_page_px = grid_page_px};
    for (uint32_t use = 0; use < shared::brush_use_count; ++use) {
        const bool has_brushes = in.brushes != nullptr;
        constants.period_px[use] = has_brushes ? in.pixels_per_mm * period_mm(*in.brushes, use, style) : 0.0F;
        constants.layer_of_use[use] =
            has_brushes ? in.brushes->layer_of_use.at(use).value_or(shared::no_brush) : shared::no_brush;
    }
    return constants;
}

/// Adds a pass that inks lines from sample to sample.
void add_pieces(gpu::Graph& graph, const ContourInputs& in, const ChainStrokes& strokes,
                const HandDrawn& hand, const ContourStyle& style, Inked& inked)
{
    const bool has_brushes = in.brushes != nullptr;
    auto ink = has_brushes ? graph.compute("contour/ink brush", shaders::ink_brush_comp)
                           : graph.compute("contour/ink pieces", shaders::ink_pieces_comp);
    ink.read(strokes.sizes).sample(strokes.samples).read(hand.line_points);
    if (has_brushes) {
        ink.read(hand.touches);
        ink.sample(gpu::import_uploaded(graph, "brushes of lines", in.brushes->strips),
                   gpu::Sampling::linear_repeat);
    }
    inked.pixels = ink.modify(inked.pixels);
    inked.tiles = ink.modify(inked.tiles);
    if (has_brushes) {
        ink.push(brush_constants(in, style, in.size_px));
    } else {
        ink.push(shared::InkConstants{.width = in.size_px.x, .height = in.size_px.y, .ink_color = style.ink});
    }
    ink.dispatch_indirect(strokes.sizes, indirect_offset(shared::list_samples));
}

/// Adds a pass that fills the outer sides of corners where the lines before and after a sample meet.
void add_joints(gpu::Graph& graph, const ContourInputs& in, const ChainStrokes& strokes,
                const HandDrawn& hand, const ContourStyle& style, glm::uvec2 grid_page_px, Inked& inked)
{
    auto joints = graph.compute("contour/joints", shaders::joints_comp);
    joints.read(strokes.sizes).sample(strokes.samples);
    joints.sample(strokes.strokes_before, gpu::Format::r32ui).read(strokes.strokes);
    joints.read(hand.line_points).read(hand.touches).read(strokes.grid);
    inked.pixels = joints.modify(inked.pixels);
    inked.tiles = joints.modify(inked.tiles);
    joints.variant(in.brushes != nullptr ? shared::joints_has_brushes : 0U)
        .push(brush_constants(in, style, grid_page_px));
    joints.dispatch_indirect(strokes.sizes, indirect_offset(shared::list_samples));
}

/// An ink layer and the pixels that are inked next.
struct InkPage {
    Inked inked;
    gpu::ImageId layer;
};

/// Creates an ink layer without ink, or goes on with the layer `under`. A CPU clears each buffer and image by
/// a fill command, a GPU all of them in one dispatch; either is faster there.
InkPage add_page(gpu::Graph& graph, const ContourInputs& in, const shared::InkConstants& constants,
                 const std::optional<gpu::ImageId>& under)
{
    const uint64_t tiles = uint64_t{(in.size_px.x + 7) / 8} * ((in.size_px.y + 7) / 8);
    const uint64_t pixels_bytes = sizeof(uint32_t) * in.size_px.x * in.size_px.y + 16;
    const uint64_t tiles_bytes = 16 + 8 * tiles;
    const gpu::ImageDesc layer{
        .width = constants.width, .height = constants.height, .format = gpu::Format::rgba8};
    if (under || in.execution.clears_by_transfer()) {
        const Inked inked{gpu::add_zeros(graph, "contour/inked", pixels_bytes),
                          gpu::add_empty_list(graph, "contour/ink tiles", tiles_bytes)};
        return {inked, under ? *under
                             : gpu::add_filled_image(graph, "contour/blank layer", layer,
                                                     glm::vec4(glm::sqrt(constants.ink_color), 0.0F))};
    }
    auto pass = graph.compute("contour/blank page", shaders::blank_page_comp);
    const gpu::ImageId blank = pass.write(graph.image("contour/ink", layer));
    const Inked inked{pass.write(graph.buffer("contour/inked", {.size_bytes = pixels_bytes})),
                      pass.write(graph.buffer("contour/ink tiles", {.size_bytes = tiles_bytes}))};
    pass.push(constants).dispatch_over_page(constants.width, constants.height);
    return {inked, blank};
}

Inked add_ink(gpu::Graph& graph, const ContourInputs& in, const ShapedStrokes& shaped,
              const ContourStyle& style, glm::uvec2 grid_page_px, Inked inked)
{
    ContourInputs seen = in;
    seen.brushes = brushes_of_seen_lines(in.brushes);
    for (const HandDrawn& hand : shaped.hands) {
        add_pieces(graph, seen, shaped.strokes, hand, style, inked);
        if (style.joints == Joints::mitre) {
            add_joints(graph, seen, shaped.strokes, hand, style, grid_page_px, inked);
        }
    }
    if (shaped.hidden) {
        add_pieces(graph, in, shaped.hidden->first, shaped.hidden->second, style, inked);
    }
    return inked;
}

/// Inks strokes. `grid_page_px` is the size of the page that the sample grid (which finds samples by
/// position) covers.
gpu::ImageId add_ink_layer(gpu::Graph& graph, const ContourInputs& in, const ShapedStrokes& shaped,
                           const ContourStyle& style, glm::uvec2 grid_page_px,
                           const std::optional<gpu::ImageId>& under)
{
    const shared::InkConstants constants{
        .width = in.size_px.x, .height = in.size_px.y, .ink_color = style.ink};
    const InkPage page = add_page(graph, in, constants, under);
    const Inked inked = add_ink(graph, in, shaped, style, grid_page_px, page.inked);
    auto layer = graph.compute("contour/ink layer", shaders::ink_layer_comp);
    layer.read(inked.pixels)
        .sample(in.materials)
        .read(inked.tiles)
        .variant((in.own_outlines ? shared::ink_layer_has_own_outlines : 0U) |
                 (in.variant_lines ? shared::ink_layer_has_variants : 0U));
    const gpu::ImageId ink = layer.modify(page.layer);
    layer.sample(in.variant_lines.value_or(in.materials), gpu::Format::r32ui);
    layer.push(constants).dispatch_indirect(inked.tiles);
    return ink;
}

} // namespace

gpu::ImageId add_chain_contours(gpu::Graph& graph, const ContourInputs& in, LineMesh& mesh,
                                LineHistory* history, const ContourStyle& style,
                                std::optional<gpu::ImageId> under)
{
    const ShapedStrokes shaped = add_shaped_strokes(graph, in, mesh, history, style);
    return add_ink_layer(graph, in, shaped, style, in.size_px, under);
}

gpu::ImageId add_linked_contours(gpu::Graph& graph, const ContourInputs& in, LinkedLines& lines,
                                 const PartOfPage& part, const ContourStyle& style,
                                 std::optional<gpu::ImageId> under)
{
    return add_ink_layer(graph, in, take_part(graph, lines, part), style, lines.page_px, under);
}

} // namespace estampe::contour
