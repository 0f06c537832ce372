// SPDX-License-Identifier: MIT
#pragma once

// Trails in sand: what walks or is dragged over the ground presses it down and throws up a rim, the rim
// slumps, and the wind fills it again. Heights beside those of the ground, in a window that follows somebody;
// and the trails of a terrain as a picture of it has them: tracks of its file, and what a program presses in.

#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/terrain.hpp>
#include <estampe/trails.hpp>

#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"
#include "techniques/terrain/terrain.glsl.h"

namespace estampe::terrain {

/// Something pressed in at a moment.
struct TimedStamp {
    TrailStamp stamp;
    double time_s = 0.0;
};

/// What a track presses in, one after the other: prints to the left and to the right, no two quite alike, or
/// short drags. The curve is Catmull and Rom's, "A Class of Local Interpolating Splines", 1974. Cost: linear
/// in its length.
[[nodiscard]] std::vector<TimedStamp> stamps_of(const TerrainTrack& track);

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

/// When and about where trails are to be seen.
struct FootprintMoment {
    double time_s = 0.0;
    glm::dvec2 centre_m{0.0};
    bool follows = false; ///< comes right after the one before, in a film: prints go on from there
};

class Footprints {
public:
    explicit Footprints(const TerrainDescription& terrain);

    /// Takes a terrain's trails and tracks; what a program has pressed in stays if they are the same.
    void set(const TerrainDescription& terrain);

    /// Pressed in at the next moment. See TrailField::press().
    void press(std::span<const TrailStamp> stamps);

    /// Goes to a moment. One that follows lets sand slump and be filled step by step; any other is made
    /// afresh, so that it looks the same whatever was seen before. Back in time, what a program has pressed
    /// in since is forgotten.
    void prepare(gpu::Device& device, const FootprintMoment& moment);

    /// See TrailField::is_behind().
    [[nodiscard]] bool is_behind() const { return field_ && field_->is_behind(); }

    void add_catching_up(gpu::Graph& graph) { field_->add_catching_up(graph, trails_); }

    /// What add_step() gives; nothing where nobody has walked. Once a graph.
    [[nodiscard]] std::optional<TrailImage> add_image(gpu::Graph& graph);

    /// Side of the square that is seen, in metres.
    [[nodiscard]] double extent_m() const { return static_cast<double>(trails_.extent_m); }

private:
    void make_afresh(gpu::Device& device, double time_s);
    void walk_on(double time_s);

    TerrainTrails trails_;
    std::vector<TerrainTrack> tracks_;
    std::vector<TimedStamp> steps_; ///< of all tracks, in the order of time
    size_t next_step_ = 0;
    std::vector<TrailStamp> waiting_;   ///< for the next moment, by the program
    std::vector<TimedStamp> pressed_;   ///< by the program
    std::unique_ptr<TrailField> field_; ///< where anybody has walked
    bool is_made_afresh_ = false;
    FootprintMoment moment_;
    uint32_t ticks_due_ = 0;
};

struct ReliefInputs {
    gpu::BufferId frame; ///< FrameGlobals
    gpu::ImageId draw;
    gpu::ImageId depth;
    gpu::ImageId normal; ///< rg32ui: shading, smooth
    glm::uvec2 size_px{0};
    uint32_t terrain_draw = 0;
    glm::dvec2 anchor_m{0.0};
    glm::vec3 towards_sun{0.0F}; ///< unit; 0: there is none
};

/// Bends the shading normals of the terrain by trails, and from the sun where these shade themselves.
///
/// Writes  a new version of `normal`: on pixels of the terrain within the image
/// Cost    one full-screen dispatch
[[nodiscard]] gpu::ImageId add_trail_relief(gpu::Graph& graph, const ReliefInputs& in,
                                            const TrailImage& trails);

} // namespace estampe::terrain
