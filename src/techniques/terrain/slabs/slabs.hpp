// SPDX-License-Identifier: MIT
#pragma once

// Sand that the wind moves in slabs (small units of constant volume). Dunes grow, wander and merge on a
// square that repeats at its edges. The number of slabs is constant. The result is an image of heights that
// repeats.

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

/// A square field of cells that repeats at its edges, with a number of sand slabs on each cell.
///
/// Equal style, start and number of steps give equal slabs on every device, bit for bit. Sand is counted in
/// whole slabs, and their number never changes.
class SlabField {
public:
    /// Starts with the style's depth of sand, plus random differences of up to a metre. `side` is the number
    /// of cells per side: a power of two, 64 to 1024; other values throw std::logic_error.
    SlabField(gpu::Device& device, const SlabStyle& style, uint32_t side = 512);
    /// Starts with heights in metres, one for each of `side` x `side` cells, row by row. Heights are rounded
    /// to whole slabs (units of sand). A negative height or NaN is bare rock.
    SlabField(gpu::Device& device, const SlabStyle& style, uint32_t side, std::span<const float> heights_m);

    /// Simulates `count` steps, and returns heights in metres: r32f, `side` x `side` texels, one per cell,
    /// for Sampling::linear_repeat. `fraction` interpolates between the heights before the last step (0) and
    /// after it (1), so that motion is smooth. With a `count` of 0, the function interpolates the last step
    /// of earlier calls.
    ///
    /// The caller must run the graph. Graphs must run in the order in which they were passed to the field,
    /// and the field must outlive the runs. Call once per graph.
    ///
    /// Throws  std::logic_error for more than most_steps() in one graph
    /// Cost    per step three dispatches, and one of a quarter of the threads for each of `slides`; two for
    ///         heights
    /// Source  Werner, "Eolian dunes: computer simulations and attractor interpretation", Geology 23, 1995;
    ///         Momiji, Carretero-Gonzalez, Bishop and Warren, "Simulation of the effect of wind speedup in
    ///         the formation of transverse dune fields", Earth Surface Processes and Landforms 25, 2000
    [[nodiscard]] gpu::ImageId add_steps(gpu::Graph& graph, const SlabStyle& style, uint32_t count,
                                         float fraction = 1.0F);

    /// Simulates steps up to a moment, which is counted in steps: 3.25 is a quarter of the way from state 3
    /// to state 4. Simulates at most `most` steps per graph until the moment is reached. A moment in the past
    /// shows the state before the last step.
    [[nodiscard]] gpu::ImageId add_moment(gpu::Graph& graph, const SlabStyle& style, double moment,
                                          uint32_t most);

    /// The largest number of steps that one graph can simulate.
    [[nodiscard]] static uint32_t most_steps(const SlabStyle& style);

    [[nodiscard]] uint32_t side() const { return side_; }

    /// Number of steps that have passed when all graphs so far have run.
    [[nodiscard]] uint64_t steps() const { return steps_; }

    /// Number of slabs (units of sand) on each cell, row by row, one word per cell.
    [[nodiscard]] gpu::Buffer& slabs() { return states_[newest_]; }

private:
    SlabField(gpu::Device& device, uint32_t side, const std::vector<uint32_t>& slabs);

    /// Slabs (units of sand) on each cell, before and after the last step.
    std::array<gpu::Buffer, 2> states_;
    uint32_t newest_ = 0;
    uint32_t side_ = 0;
    uint64_t steps_ = 0;
};

/// Constants of a simulation step, with a wind direction within the style's spread.
[[nodiscard]] shared::SlabConstants slab_constants(const SlabStyle& style, uint32_t side, uint64_t step);

/// Constants of one slide: one of several passes per step in which steep sand slides.
[[nodiscard]] shared::SlideConstants slide_constants(const SlabStyle& style, uint32_t side, int slide);

} // namespace estampe::terrain
