// SPDX-License-Identifier: MIT
#pragma once

// Trails in sand: what walks or is dragged over the ground presses it down and throws up a rim, the rim
// slumps, and the wind fills it again. Heights beside those of the ground, in a window that follows somebody.

#include <deque>
#include <span>

#include <glm/glm.hpp>

#include <estampe/trails.hpp>

#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"
#include "techniques/terrain/trails/track.hpp"
#include "techniques/terrain/trails/trails.glsl.h"

namespace estampe::terrain {

/// Heights to be added to those of the ground, and where they lie.
struct TrailImage {
    gpu::ImageId height; ///< r32f, metres; 0 at the edge, so that Sampling::linear is level beyond it
    glm::dvec2 corner_m; ///< x and z of the image's corner: its first texel's centre is half a texel on
    double texel_m = 0.0;
};

/// A square window of texels that follows a point by whole texels: those that stay within keep their values
/// bit for bit, wherever the window goes, and what it comes upon is as it was pressed, as old as it is. Time
/// passes in steps of 1/30 s, so that how it is split among frames does not matter.
class TrailField {
public:
    /// `side` is in texels: a power of two, 16 to 1024; anything else is an std::logic_error.
    TrailField(gpu::Device& device, uint32_t side = 512, double extent_m = 32.0);

    /// Things to press in, one after the other, at the next add_step(). Those that are not finite, or longer
    /// than 100 m, are left out. The last most_known() are remembered.
    void press(std::span<const TrailStamp> stamps);

    /// Something that was pressed in so long ago, in seconds: seen where the window comes upon it from now
    /// on.
    void remember(const TrailStamp& stamp, double age_s);

    /// Lets time pass at once: the next add_step() makes all texels anew, of what is remembered, as old as it
    /// is then.
    void pass(uint32_t ticks);

    /// Takes the window about a place; where that is not finite it stays.
    void go_to(const TerrainTrails& style, glm::dvec2 centre_m);

    /// Whether more of what is remembered comes into the window than one step takes: then graphs with
    /// add_catching_up() alone are to be run first.
    [[nodiscard]] bool is_behind() const { return arriving_.size() > most_presses(); }

    void add_catching_up(gpu::Graph& graph, const TerrainTrails& style);

    /// Lets `ticks` of 1/120 s pass with the window about `centre_m` (where that is not finite it stays), and
    /// hands out the heights. What waits is pressed in first, at most most_presses() a graph; the rest waits
    /// on. The graph must be run, and graphs in the order in which they were given to the field, which must
    /// outlive their runs. Once a graph. Cost    a dispatch for the image; where steps pass or the window
    /// moves one more, for each stamp one of
    ///         one workgroup, for each step that slumps four of a quarter of the threads
    [[nodiscard]] TrailImage add_step(gpu::Graph& graph, const TerrainTrails& style, uint32_t ticks,
                                      glm::dvec2 centre_m);

    [[nodiscard]] static constexpr uint32_t most_presses() { return 32; }

    [[nodiscard]] static constexpr size_t most_known() { return 4096; }

    /// Whether anything was ever pressed in, or waits to be.
    [[nodiscard]] bool is_trodden() const { return !known_.empty() || !waiting_.empty(); }

    [[nodiscard]] uint32_t side() const { return side_; }

    [[nodiscard]] double texel_m() const { return texel_m_; }

    /// Heights in metres: the texel of the ground of number n is kept at n modulo the side, in x and in y.
    [[nodiscard]] gpu::Buffer& heights() { return heights_; }

private:
    struct Known {
        TrailStamp stamp;
        int64_t pressed_ticks = 0; ///< on the clock of the field
    };

    [[nodiscard]] gpu::BufferId add_arriving(gpu::Graph& graph, const TerrainTrails& style, size_t most,
                                             gpu::BufferId heights);
    [[nodiscard]] gpu::BufferId add_presses(gpu::Graph& graph, gpu::BufferId heights);
    [[nodiscard]] static gpu::BufferId add_press(gpu::Graph& graph, const shared::TrailPress& press,
                                                 gpu::BufferId heights);
    void know(const Known& known);
    [[nodiscard]] gpu::BufferId add_passing_steps(gpu::Graph& graph, const TerrainTrails& style,
                                                  uint32_t steps, gpu::BufferId heights);
    [[nodiscard]] gpu::BufferId add_slump(gpu::Graph& graph, const TerrainTrails& style,
                                          gpu::BufferId heights);
    [[nodiscard]] gpu::BufferId add_fill(gpu::Graph& graph, const TerrainTrails& style, glm::i64vec2 moved,
                                         uint32_t steps, gpu::BufferId heights) const;

    gpu::Buffer heights_;
    uint32_t side_;
    double texel_m_;
    glm::i64vec2 first_{0};  ///< number of the window's first texel on the ground
    bool is_placed_ = false; ///< the window has been somewhere
    uint32_t ticks_ = 0;     ///< that have passed since the last step
    int slumps_left_ = 0;
    std::deque<TrailStamp> waiting_;
    std::deque<Known> known_;        ///< the oldest first
    glm::i64vec2 moved_{0};          ///< texels that the window has moved by, which are yet to be made even
    bool is_arriving_whole_ = false; ///< all texels are
    std::deque<shared::TrailPress> arriving_; ///< what of the known lies in them
    int64_t now_ticks_ = 0;
};

} // namespace estampe::terrain
