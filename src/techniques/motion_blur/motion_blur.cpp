// SPDX-License-Identifier: MIT
// Blur spread over the longest way of tiles: McGuire, Hennessy, Bukowski and Osman, "A Reconstruction Filter
// for Plausible Motion Blur", I3D 2012; along two ways: Guertin, McGuire and Nowrouzezahrai, "A Fast and
// Stable Feature-Aware Motion Blur Filter", HPG 2014; before and behind apart: Jimenez, "Next Generation Post
// Processing in Call of Duty", SIGGRAPH 2014.
#include "techniques/motion_blur/motion_blur.hpp"

#include <algorithm>
#include <cmath>

#include "gpu/fills.hpp"
#include "shaders/blur_gather_comp.hpp"
#include "shaders/blur_own_comp.hpp"
#include "shaders/blur_pack_comp.hpp"
#include "shaders/blur_reach_comp.hpp"
#include "shaders/blur_tiles_comp.hpp"
#include "shaders/blur_tiles_wide_comp.hpp"
#include "shaders/speed_lines_comp.hpp"
#include "shaders/speed_seeds_comp.hpp"
#include "shaders/speed_tiles_comp.hpp"

namespace estampe::motion_blur {
namespace {

constexpr float longest_line_mm = 30.0F;

/// What moves, packed.
struct Packed {
    gpu::ImageId page;
    gpu::ImageId depth;
    gpu::ImageId hatch; ///< with the sky's strokes, if they are laid; else nothing
};

Packed add_pack(gpu::Graph& graph, const MotionBlurInputs& in, uint32_t variant,
                const shared::MotionBlurConstants& constants)
{
    auto pass = graph.compute("motion blur/pack", shaders::blur_pack_comp);
    pass.sample(in.depth).sample(in.motion).sample(in.wash).sample(in.hatch).sample(in.lines).sample(
        in.sky_ink);
    pass.sample(in.own_motion);
    const glm::uvec2 hatch_px = (variant & shared::blur_lays_sky) != 0U ? in.size_px : glm::uvec2(1);
    const Packed packed{
        .page = pass.write(
            graph.image("motion blur/page",
                        {.width = in.size_px.x, .height = in.size_px.y, .format = gpu::Format::rgba32ui})),
        .depth = pass.write(
            graph.image("motion blur/depth",
                        {.width = in.size_px.x, .height = in.size_px.y, .format = gpu::Format::r32f})),
        .hatch = pass.write(graph.image(
            "motion blur/hatch", {.width = hatch_px.x, .height = hatch_px.y, .format = gpu::Format::r16f}))};
    pass.variant(variant | (in.own_motion == in.motion ? 0U : shared::blur_is_stretched));
    pass.push(constants).dispatch_over_page(in.size_px.x, in.size_px.y);
    return packed;
}

/// The longest ways that reach tiles, and the tiles to draw.
struct Reach {
    gpu::ImageId ways;
    gpu::BufferId tiles; ///< see shaders/tile_list.glsl.h
};

Reach add_reach(gpu::Graph& graph, const MotionBlurInputs& in, gpu::ImageId page, uint32_t variant,
                const shared::MotionBlurConstants& constants)
{
    const glm::uvec2 tiles = (in.size_px + shared::blur_tile_px - 1U) / shared::blur_tile_px;
    const gpu::ImageDesc desc{.width = tiles.x, .height = tiles.y, .format = gpu::Format::rg16f};
    auto find = graph.compute("motion blur/tiles",
                              in.by_groups ? shaders::blur_tiles_wide_comp : shaders::blur_tiles_comp);
    find.sample(page);
    const gpu::ImageId found = find.write(graph.image("motion blur/tiles", desc));
    find.push(constants);
    if (in.by_groups) {
        find.dispatch(tiles.x, tiles.y);
    } else {
        find.dispatch_over(tiles.x, tiles.y);
    }
    const gpu::BufferId no_tiles = gpu::add_empty_tile_list(graph, "motion blur/passed", in.size_px);
    auto spread = graph.compute("motion blur/reach", shaders::blur_reach_comp);
    spread.sample(found);
    const gpu::ImageId ways = spread.write(graph.image("motion blur/reach", desc));
    const gpu::BufferId passed = spread.modify(no_tiles);
    spread.variant(variant).push(constants).dispatch_over(tiles.x, tiles.y);
    return {.ways = ways, .tiles = passed};
}

/// Blurs `layers` in place where anything moves.
void blur_in_place(gpu::Graph& graph, const MotionBlurInputs& in, const Packed& packed, uint32_t variant,
                   const shared::MotionBlurConstants& constants, MotionBlurLayers& layers)
{
    const Reach reach = add_reach(graph, in, packed.page, variant, constants);
    auto pass = graph.compute("motion blur", shaders::blur_gather_comp);
    pass.sample(packed.page).sample(packed.depth).sample(reach.ways);
    layers.wash = pass.modify(layers.wash);
    layers.hatch = pass.modify(layers.hatch);
    layers.lines = pass.modify(layers.lines);
    pass.read(reach.tiles);
    pass.variant(variant).push(constants).dispatch_indirect(reach.tiles);
}

MotionBlurLayers write_layers(gpu::Graph& graph, gpu::Pass& pass, glm::uvec2 size_px)
{
    const auto write = [&](const char* name, gpu::Format format) {
        return pass.write(graph.image(name, {.width = size_px.x, .height = size_px.y, .format = format}));
    };
    const gpu::ImageId wash = write("motion blur/wash", gpu::Format::rgba16f);
    const gpu::ImageId hatch = write("motion blur/hatch", gpu::Format::r16f);
    return {.wash = wash, .hatch = hatch, .lines = write("motion blur/lines", gpu::Format::rgba8)};
}

gpu::ImageId add_speed_lines(gpu::Graph& graph, const MotionBlurInputs& in, const Packed& packed,
                             gpu::ImageId lines, const shared::MotionBlurConstants& constants)
{
    const glm::uvec2 cells(glm::ceil(glm::vec2(in.size_px) / constants.cell_px));
    auto seed = graph.compute("speed lines/seeds", shaders::speed_seeds_comp);
    seed.sample(packed.page).sample(packed.depth);
    const gpu::ImageId seeds = seed.write(graph.image(
        "speed lines/seeds", {.width = cells.x, .height = cells.y, .format = gpu::Format::rgba32f}));
    seed.push(constants).dispatch_over(cells.x, cells.y);

    const glm::uvec2 tiles = (in.size_px + shared::blur_tile_px - 1U) / shared::blur_tile_px;
    auto list = graph.compute("speed lines/tiles", shaders::speed_tiles_comp);
    list.sample(seeds);
    const gpu::ImageId listed = list.write(graph.image(
        "speed lines/tiles",
        {.width = tiles.x * shared::most_speed_lines, .height = tiles.y, .format = gpu::Format::rgba32f}));
    list.push(constants).dispatch_over(tiles.x, tiles.y);

    auto draw = graph.compute("speed lines", shaders::speed_lines_comp);
    draw.sample(listed).sample(packed.page);
    const gpu::ImageId drawn = draw.modify(lines);
    draw.push(constants).dispatch_over(in.size_px.x, in.size_px.y);
    return drawn;
}

} // namespace

double exposure_s(const MotionBlurStyle& style)
{
    return static_cast<double>(style.shutter_deg) / 360.0 / static_cast<double>(style.frames_per_s);
}

bool is_wanted(const MotionBlurStyle& style)
{
    return style.shutter_deg > 0.0F && (style.mode != Mode::none || style.lines || style.smear);
}

shared::MotionBlurConstants constants_of(const MotionBlurStyle& style, float scale, float pixels_per_mm,
                                         float line_half_px)
{
    return {.scale = scale,
            .most_px = 0.5F * style.largest_mm * pixels_per_mm,
            .line_reach_px = std::ceil(std::max(line_half_px, 0.0F)) + 1.0F,
            .cell_px = std::max(style.lines_spacing_mm * pixels_per_mm, 2.0F),
            .line_length = 2.0F * style.lines_length,
            .line_most_px = longest_line_mm * pixels_per_mm,
            .line_half_px = 0.5F * style.lines_width_mm * pixels_per_mm,
            .line_from_px = 0.5F * style.lines_from_mm * pixels_per_mm,
            .seed = static_cast<uint32_t>(style.seed),
            .line_ink = style.lines_ink};
}

MotionBlurLayers add_motion_blur(gpu::Graph& graph, const MotionBlurInputs& in, const MotionBlurStyle& style,
                                 shared::MotionBlurConstants constants, const shared::SmearConstants& smear)
{
    constants.size_px = in.size_px;
    constants.window_min_px = in.window_min_px;
    constants.window_max_px = in.window_max_px;
    const uint32_t variant = in.has_sky ? shared::blur_has_sky : 0U;
    const bool blurs_within = style.mode == Mode::own || style.mode == Mode::stretched;
    const bool lays_sky = in.has_sky && style.mode != Mode::none && !blurs_within;
    const Packed packed = add_pack(graph, in, variant | (lays_sky ? shared::blur_lays_sky : 0U), constants);
    MotionBlurLayers layers{.wash = in.wash,
                            .hatch = lays_sky ? packed.hatch : in.hatch,
                            .lines = in.lines,
                            .holds_sky = lays_sky};
    if (blurs_within) {
        auto pass = graph.compute("motion blur", shaders::blur_own_comp);
        pass.sample(in.wash).sample(in.hatch).sample(in.lines).sample(in.sky_ink).sample(packed.page);
        layers = write_layers(graph, pass, in.size_px);
        pass.variant(variant).push(constants).dispatch_over(in.size_px.x, in.size_px.y);
    } else if (style.mode != Mode::none) {
        blur_in_place(graph, in, packed, style.mode == Mode::velocity ? shared::blur_shows_velocity : 0U,
                      constants, layers);
    }
    if (style.lines) {
        layers.lines = add_speed_lines(graph, in, packed, layers.lines, constants);
    }
    if (in.smear) {
        layers.lines = add_smear(
            graph, *in.smear,
            {.page = packed.page, .owner_depth = packed.depth, .depth = in.depth, .size_px = in.size_px},
            layers.lines, smear);
    }
    return layers;
}

} // namespace estampe::motion_blur
