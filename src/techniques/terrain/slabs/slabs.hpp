// SPDX-License-Identifier: MIT
#pragma once

// Sand that the wind moves in slabs: dunes that grow, wander and merge on a square without edge, and not a
// slab more or less than there was. What it gives is a height image that repeats.

#include <array>
#include <span>

#include <glm/glm.hpp>

#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"
#include "style/parameter.hpp"
#include "techniques/terrain/terrain.glsl.h"

namespace estampe::terrain {

struct SlabStyle {
    float cell_m = 1.0F;
    float slab_m = 0.1F;
    float depth_m = 5.0F;
    float wind_deg = 0.0F;
    float wind_spread_deg = 15.0F;
    float hop_cells = 5.0F;
    float speedup_per_m = 0.06F;
    float lift_share = 0.4F;
    float stay_on_sand = 0.6F;
    float stay_on_rock = 0.4F;
    float lee_deg = 15.0F;
    float repose_deg = 33.0F;
    int slides = 8;
    int smooth_cells = 2;
    int seed = 1;
};

[[nodiscard]] const style::Table<SlabStyle>& slab_table();

/// A square of cells whose edges meet, and the slabs on them.
///
/// The same style, start and steps give the same slabs on every device, bit for bit. Sand is counted in whole
/// slabs: there are as many after any number of steps as at the start.
class SlabField {
public:
    /// Sand of the style's depth, a metre up and down at random. `side` is in cells: a power of two, 64 to
    /// 1024; anything else is an std::logic_error.
    SlabField(gpu::Device& device, const SlabStyle& style, uint32_t side = 512);
    /// From heights in metres, row by row, rounded to slabs; `side` times `side` of them. What is negative or
    /// no number is bare rock.
    SlabField(gpu::Device& device, const SlabStyle& style, uint32_t side, std::span<const float> heights_m);

    /// Lets `count` steps pass, and hands out heights in metres: r32f, `side` texels square, a cell each, to
    /// be sampled with Sampling::linear_repeat. `fraction` runs from 0, before the last step, to 1, after it,
    /// so that motion between steps is smooth; with a `count` of 0 it is of the steps that passed before.
    ///
    /// The graph must be run, and graphs in the order in which they were given to the field, which must
    /// outlive their runs. Once a graph.
    /// Throws  std::logic_error for more than most_steps() in one graph
    /// Cost    a step: three dispatches, and one of a quarter of the threads for each of `slides`; heights:
    /// two Source  Werner, "Eolian dunes: computer simulations and attractor interpretation", Geology 23,
    /// 1995;
    ///         Momiji, Carretero-Gonzalez, Bishop and Warren, "Simulation of the effect of wind speedup in
    ///         the formation of transverse dune fields", Earth Surface Processes and Landforms 25, 2000
    [[nodiscard]] gpu::ImageId add_steps(gpu::Graph& graph, const SlabStyle& style, uint32_t count,
                                         float fraction = 1.0F);

    /// The same for a moment counted in steps: 3.25 is a quarter of the way from state 3 to 4. What is
    /// missing to it is caught up with `most` steps a graph; a moment that has passed shows the state before
    /// the last.
    [[nodiscard]] gpu::ImageId add_moment(gpu::Graph& graph, const SlabStyle& style, double moment,
                                          uint32_t most);

    /// As many steps as one graph takes.
    [[nodiscard]] static uint32_t most_steps(const SlabStyle& style);

    [[nodiscard]] uint32_t side() const { return side_; }

    /// Steps that have passed, or will have when the graphs so far have been run.
    [[nodiscard]] uint64_t steps() const { return steps_; }

    /// Slabs on each cell, row by row: one word each.
    [[nodiscard]] gpu::Buffer& slabs() { return states_[newest_]; }

private:
    SlabField(gpu::Device& device, uint32_t side, const std::vector<uint32_t>& slabs);

    std::array<gpu::Buffer, 2> states_; ///< before and after the last step
    uint32_t newest_ = 0;
    uint32_t side_ = 0;
    uint64_t steps_ = 0;
};

/// Of a step, whose wind is one of those within the spread.
[[nodiscard]] shared::SlabConstants slab_constants(const SlabStyle& style, uint32_t side, uint64_t step);

/// Of one of a step's slides.
[[nodiscard]] shared::SlideConstants slide_constants(const SlabStyle& style, uint32_t side, int slide);

} // namespace estampe::terrain
