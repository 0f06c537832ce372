// SPDX-License-Identifier: MIT
#include "techniques/terrain/slabs/slabs.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "core/hash.hpp"
#include "gpu/resources.hpp"
#include "shaders/slab_across_comp.hpp"
#include "shaders/slab_down_comp.hpp"
#include "shaders/slab_hop_comp.hpp"
#include "shaders/slab_roofs_comp.hpp"
#include "shaders/slab_shade_comp.hpp"
#include "shaders/slab_slide_comp.hpp"
#include "style/parameter.hpp"

namespace estampe::terrain {
namespace {

int times(double value, double one)
{
    return static_cast<int>(std::lround(value * one));
}

uint32_t share(float value)
{
    return static_cast<uint32_t>(times(static_cast<double>(value), 65536.0));
}

/// Number of slabs by which heights may differ at the angle of repose, over a distance in cells.
int difference_at_repose(const SlabStyle& style, double cells)
{
    const auto slope = std::tan(glm::radians(static_cast<double>(style.repose_deg)));
    return std::max(1, static_cast<int>(slope * cells * static_cast<double>(style.cell_m) /
                                        static_cast<double>(style.slab_m)));
}

/// Wind direction of a simulation step, in radians. Multiples of the golden ratio spread the directions
/// evenly over any number of steps.
double wind_rad(const SlabStyle& style, uint64_t step)
{
    const auto turn = static_cast<double>(static_cast<uint32_t>(step) * 2654435769U) / 2147483648.0 - 1.0;
    return glm::radians(static_cast<double>(style.wind_deg) +
                        turn * static_cast<double>(style.wind_spread_deg));
}

} // namespace

shared::SlabConstants slab_constants(const SlabStyle& style, uint32_t side, uint64_t step)
{
    // Largest fall per cell of the lee's roof (an imaginary surface that descends from each crest). With the
    // limit, the fall over twice the field's side fits in 32 bits.
    constexpr int steepest_drop = 1 << 19;
    constexpr int greatest_gain = 1 << 16;
    const double wind = wind_rad(style, step);
    const glm::dvec2 downwind(std::cos(wind), std::sin(wind));
    const bool along_y = std::abs(downwind.y) > std::abs(downwind.x);
    const double along = along_y ? downwind.y : downwind.x;
    const double slope = (along_y ? downwind.x : downwind.y) / std::abs(along);
    const auto slab_m = static_cast<double>(style.slab_m);
    const double drop = std::tan(glm::radians(static_cast<double>(style.lee_deg))) *
                        static_cast<double>(style.cell_m) / slab_m / std::abs(along);
    const glm::dvec2 hop = static_cast<double>(style.hop_cells) * downwind;
    return {.side = side,
            .step = static_cast<uint32_t>(step),
            .seed = static_cast<uint32_t>(style.seed),
            .along_y = along_y ? 1U : 0U,
            .sign = along > 0.0 ? 1 : -1,
            .slope = times(slope, side) * static_cast<int>(65536 / side),
            .phase = static_cast<int>((static_cast<uint32_t>(step) * 40503U) & 0xFFFFU),
            .drop = std::min(times(drop, 256.0), steepest_drop),
            .hop_x = times(hop.x, 256.0),
            .hop_y = times(hop.y, 256.0),
            .mean = times(static_cast<double>(style.depth_m) / slab_m, 1.0),
            .gain =
                std::min(times(static_cast<double>(style.speedup_per_m) * slab_m, 65536.0), greatest_gain),
            .lift = share(style.lift_share),
            .on_sand = share(style.stay_on_sand),
            .on_rock = share(style.stay_on_rock)};
}

shared::SlideConstants slide_constants(const SlabStyle& style, uint32_t side, int slide)
{
    // Sand slides within blocks of 2 x 2 cells, which take four offsets in turn. The second offset is
    // diagonal to the first offset.
    const auto phase = static_cast<uint32_t>(slide) & 3U;
    return {.side = side,
            .first_x = phase & 1U,
            .first_y = (phase ^ (phase >> 1U)) & 1U,
            .beside = difference_at_repose(style, 1.0),
            .aslant = difference_at_repose(style, std::sqrt(2.0))};
}

namespace {

/// Largest number of passes per frame graph for simulation steps. The graph's remaining passes are reserved
/// for other work.
constexpr uint32_t most_passes = 240;
constexpr double most_slabs = 1 << 20; ///< largest number of slabs on a cell at the start

void check_side(uint32_t side)
{
    if (!std::has_single_bit(side) || side < 64 || side > 1024) {
        throw std::logic_error("a field of slabs has a side of 64, 128, 256, 512 or 1024 cells");
    }
}

uint32_t slabs_of(double height_m, const SlabStyle& style)
{
    const double slabs = height_m / static_cast<double>(style.slab_m);
    return slabs > 0.0 ? static_cast<uint32_t>(std::lround(std::min(slabs, most_slabs))) : 0U;
}

std::vector<uint32_t> flat_start(const SlabStyle& style, uint32_t side)
{
    constexpr double unevenness_m = 1.0;
    check_side(side);
    std::vector<uint32_t> slabs;
    for (uint64_t i = 0; i < static_cast<uint64_t>(side) * side; ++i) {
        Hash hash;
        hash.add(style.seed);
        hash.add(i);
        const double random = static_cast<double>(hash.value() >> 32U) / 2147483648.0 - 1.0;
        slabs.push_back(slabs_of(static_cast<double>(style.depth_m) + unevenness_m * random, style));
    }
    return slabs;
}

std::vector<uint32_t> start_from(const SlabStyle& style, uint32_t side, std::span<const float> heights_m)
{
    check_side(side);
    if (heights_m.size() != static_cast<size_t>(side) * side) {
        throw std::logic_error("a field of slabs wants a height for each of its cells");
    }
    std::vector<uint32_t> slabs;
    for (const float height_m : heights_m) {
        slabs.push_back(slabs_of(static_cast<double>(height_m), style));
    }
    return slabs;
}

gpu::BufferId add_step(gpu::Graph& graph, const SlabStyle& style, const shared::SlabConstants& slab,
                       gpu::BufferId last, gpu::BufferId next)
{
    const uint64_t size_bytes = sizeof(uint32_t) * uint64_t{slab.side} * slab.side;
    auto piece = graph.compute("slabs/roofs", shaders::slab_roofs_comp);
    piece.sample(last, gpu::Format::r32ui);
    const gpu::BufferId roofs = piece.write(graph.buffer(
        "slabs/roofs", {.size_bytes = sizeof(int32_t) * uint64_t{slab.side} * shared::slab_pieces}));
    piece.push(slab).dispatch_over(shared::slab_pieces, slab.side);
    auto shade = graph.compute("slabs/shade", shaders::slab_shade_comp);
    shade.sample(last, gpu::Format::r32ui).read(roofs);
    next = shade.write(next);
    const gpu::BufferId ground = shade.write(graph.buffer("slabs/ground", {.size_bytes = size_bytes}));
    shade.push(slab).dispatch_over(shared::slab_pieces, slab.side);
    auto hop = graph.compute("slabs/hop", shaders::slab_hop_comp);
    hop.sample(last, gpu::Format::r32ui).sample(ground, gpu::Format::r32ui);
    next = hop.modify(next);
    hop.push(slab).dispatch_over(slab.side, slab.side);
    for (int i = 0; i < style.slides; ++i) {
        auto slide = graph.compute("slabs/slide", shaders::slab_slide_comp);
        next = slide.modify(next);
        slide.push(slide_constants(style, slab.side, i)).dispatch_over(slab.side / 2, slab.side / 2);
    }
    return next;
}

gpu::ImageId add_height(gpu::Graph& graph, const shared::SlabHeightConstants& height, gpu::BufferId last,
                        gpu::BufferId next)
{
    const gpu::ImageDesc desc{.width = height.side, .height = height.side, .format = gpu::Format::r32f};
    auto across = graph.compute("slabs/across", shaders::slab_across_comp);
    across.sample(last, gpu::Format::r32ui).sample(next, gpu::Format::r32ui);
    const gpu::ImageId half = across.write(graph.image("slabs/across", desc));
    across.push(height).dispatch_over(height.side, height.side);
    auto down = graph.compute("slabs/down", shaders::slab_down_comp);
    down.sample(half);
    const gpu::ImageId image = down.write(graph.image("slabs/height", desc));
    down.push(height).dispatch_over(height.side, height.side);
    return image;
}

} // namespace

SlabField::SlabField(gpu::Device& device, const SlabStyle& style, uint32_t side)
    : SlabField(device, side, flat_start(style, side))
{
}

SlabField::SlabField(gpu::Device& device, const SlabStyle& style, uint32_t side,
                     std::span<const float> heights_m)
    : SlabField(device, side, start_from(style, side, heights_m))
{
}

SlabField::SlabField(gpu::Device& device, uint32_t side, const std::vector<uint32_t>& slabs)
    : states_{gpu::upload_buffer(device, "slabs", slabs), gpu::upload_buffer(device, "slabs", slabs)},
      side_(side)
{
}

uint32_t SlabField::most_steps(const SlabStyle& style)
{
    return most_passes / (3U + static_cast<uint32_t>(style.slides));
}

gpu::ImageId SlabField::add_steps(gpu::Graph& graph, const SlabStyle& style, uint32_t count, float fraction)
{
    if (count > most_steps(style)) {
        throw std::logic_error("more steps of slabs than one graph takes");
    }
    std::array<gpu::BufferId, 2> states{gpu::import_whole(graph, "slabs/even", states_[0]),
                                        gpu::import_whole(graph, "slabs/odd", states_[1])};
    for (uint32_t i = 0; i < count; ++i) {
        const uint32_t last = newest_;
        newest_ = 1 - newest_;
        states[newest_] =
            add_step(graph, style, slab_constants(style, side_, steps_++), states[last], states[newest_]);
    }
    return add_height(graph,
                      {.side = side_,
                       .radius = static_cast<uint32_t>(style.smooth_cells),
                       .slab_m = style.slab_m,
                       .fraction = fraction > 0.0F ? std::min(fraction, 1.0F) : 0.0F},
                      states[1 - newest_], states[newest_]);
}

gpu::ImageId SlabField::add_moment(gpu::Graph& graph, const SlabStyle& style, double moment, uint32_t most)
{
    const double missing = std::ceil(moment) - static_cast<double>(steps_);
    const uint32_t possible = std::min(most, most_steps(style));
    const uint32_t count =
        missing > 0.0 ? static_cast<uint32_t>(std::min(missing, static_cast<double>(possible))) : 0;
    const double before = static_cast<double>(steps_ + count) - 1.0;
    return add_steps(graph, style, count, static_cast<float>(moment - before));
}

const style::Table<SlabStyle>& slab_table()
{
    static const auto table =
        style::Table<SlabStyle>("slabs", "Simulated dunes: sand that the wind moves in thin slabs")
            .number("cell_m", &SlabStyle::cell_m, {0.05F, 20.0F}, "m",
                    "Size of a cell (square) of the dune simulation: less gives finer dunes")
            .number("slab_m", &SlabStyle::slab_m, {0.01F, 2.0F}, "m",
                    "Height of one slab (thin piece) of sand that the wind moves. A tenth of slabs.cell_m "
                    "keeps slopes at the angle slabs.repose_deg.")
            .number("depth_m", &SlabStyle::depth_m, {0.0F, 100.0F}, "m",
                    "Mean depth of the sand that lies on rock. Little sand makes single dunes, much sand "
                    "makes a sea of dunes.")
            .number("wind_deg", &SlabStyle::wind_deg, {-360.0F, 360.0F}, "deg",
                    "Direction in which the wind blows over the dune field: 0 is the x axis of the field, 90 "
                    "its y axis. Dunes look best when the wind blows along an axis.")
            .number("wind_spread_deg", &SlabStyle::wind_spread_deg, {0.0F, 90.0F}, "deg",
                    "How far the wind over the dunes turns to either side at random. 0 always blows in one "
                    "direction, more changes the direction more.")
            .number("hop_cells", &SlabStyle::hop_cells, {0.25F, 32.0F}, "cells",
                    "Distance that the wind carries a slab (thin piece) of sand in one hop: more carries "
                    "sand farther")
            .number("speedup_per_m", &SlabStyle::speedup_per_m, {0.0F, 1.0F}, "1/m",
                    "How much farther slabs (thin pieces) of sand hop for each metre above the mean depth. "
                    "More makes the slopes towards the wind less steep.")
            .number("lift_share", &SlabStyle::lift_share, {0.0F, 1.0F}, "",
                    "Share of the cells (squares) of sand from which the wind tries to lift a slab in one "
                    "step. More moves dunes faster.")
            .number("stay_on_sand", &SlabStyle::stay_on_sand, {0.01F, 1.0F}, "",
                    "Share of the slabs (thin pieces) of sand that stay where they land on sand. More moves "
                    "sand less far.")
            .number("stay_on_rock", &SlabStyle::stay_on_rock, {0.01F, 1.0F}, "",
                    "Share of the slabs (thin pieces) of sand that stay where they land on bare rock. More "
                    "moves sand less far.")
            .number("lee_deg", &SlabStyle::lee_deg, {1.0F, 60.0F}, "deg",
                    "Angle below the horizontal down to which a dune's crest shelters the ground behind from "
                    "the wind. More makes the sheltered area shorter.")
            .number("repose_deg", &SlabStyle::repose_deg, {5.0F, 60.0F}, "deg",
                    "Steepest slope of sand (angle of repose): sand on steeper slopes slides down. More "
                    "gives steeper dunes.")
            .integer("slides", &SlabStyle::slides, {0, 64}, "",
                     "Number of times that sand may slide down in one step: 4 lets sand slide once in each "
                     "direction")
            .integer("smooth_cells", &SlabStyle::smooth_cells, {0, 8}, "cells",
                     "Distance over which the heights of dunes are smoothed. More hides the stairs that "
                     "slabs (thin pieces) of sand form.")
            .integer(
                "seed", &SlabStyle::seed, {0, 1000000}, "",
                "Number that selects the random details of the dunes: another number gives another desert");
    return table;
}

} // namespace estampe::terrain
