// SPDX-License-Identifier: MIT
#include "techniques/terrain/slabs/slab_constants.hpp"

#include <algorithm>
#include <cmath>

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

/// Slabs that a cell's height may differ by over so many cells.
int difference_at_repose(const SlabStyle& style, double cells)
{
    const auto slope = std::tan(glm::radians(static_cast<double>(style.repose_deg)));
    return std::max(1, static_cast<int>(slope * cells * static_cast<double>(style.cell_m) /
                                        static_cast<double>(style.slab_m)));
}

/// Spread evenly, whatever number of steps is looked at: multiples of the golden ratio.
double wind_rad(const SlabStyle& style, uint64_t step)
{
    const auto turn = static_cast<double>(static_cast<uint32_t>(step) * 2654435769U) / 2147483648.0 - 1.0;
    return glm::radians(static_cast<double>(style.wind_deg) +
                        turn * static_cast<double>(style.wind_spread_deg));
}

} // namespace

shared::SlabConstants slab_constants(const SlabStyle& style, uint32_t side, uint64_t step)
{
    constexpr int steepest_drop = 1 << 19; // or the sum over two fields' length would not fit
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
    // Four places where blocks can begin; the second lies across a corner from the first.
    const auto phase = static_cast<uint32_t>(slide) & 3U;
    return {.side = side,
            .first_x = phase & 1U,
            .first_y = (phase ^ (phase >> 1U)) & 1U,
            .beside = difference_at_repose(style, 1.0),
            .aslant = difference_at_repose(style, std::sqrt(2.0))};
}

} // namespace estampe::terrain
