// SPDX-License-Identifier: MIT
#pragma once

// Trails in sand. A person or an object that moves over the ground presses the sand down and raises a rim.
// The rim slumps, and the wind fills the trail again. Trails are heights that are added to the ground's
// heights, in a window that follows a point. The trails of a picture come from the tracks of the terrain's
// file and from stamps of the program.

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

/// A stamp and the time when it is pressed in.
struct TimedStamp {
    TrailStamp stamp;
    double time_s = 0.0;
};

/// The stamps of a track in their order: left and right footprints, each slightly different, or short drags.
/// The curve is that of Catmull and Rom, "A Class of Local Interpolating Splines", 1974. Cost: linear in its
/// length.
[[nodiscard]] std::vector<TimedStamp> stamps_of(const TerrainTrack& track);

/// Heights to add to the ground's heights, and their position.
struct TrailImage {
    gpu::ImageId height; ///< r32f, metres; 0 at the edge, so that Sampling::linear is level beyond
    glm::dvec2 corner_m; ///< x and z of the image's corner, half a texel before its first centre
    double texel_m = 0.0;
};

/// A square window of texels that follows a point in steps of whole texels. Texels that stay inside keep
/// their values bit for bit, wherever the window goes. In newly entered texels, known stamps are repeated at
/// their age. Time passes in steps of 1/30 s, so that results do not depend on how time is divided into
/// frames.
class TrailField {
public:
    /// `side` is in texels: a power of two, 16 to 1024; other values throw std::logic_error.
    TrailField(gpu::Device& device, uint32_t side = 512, double extent_m = 32.0);

    /// Adds stamps to press in, in order, at the next add_step(). Stamps that are not finite, or longer than
    /// 100 m, are ignored. The last most_known() stamps are remembered.
    void press(std::span<const TrailStamp> stamps);

    /// Remembers a stamp that was pressed in `age_s` seconds ago. It appears where the window newly enters
    /// from now on.
    void remember(const TrailStamp& stamp, double age_s);

    /// Lets time jump: the next add_step() rebuilds all texels from the remembered stamps at their new age.
    void pass(uint32_t ticks);

    /// Centres the window on a place; does nothing if the place is not finite.
    void go_to(const TerrainTrails& style, glm::dvec2 centre_m);

    /// Returns whether more remembered stamps enter the window than one step can press. If so, first run
    ///         graphs that contain only add_catching_up().
    [[nodiscard]] bool is_behind() const { return arriving_.size() > most_presses(); }

    void add_catching_up(gpu::Graph& graph, const TerrainTrails& style);

    /// Lets `ticks` of 1/120 s pass with the window centred on `centre_m` (unchanged if that is not finite),
    /// and returns the heights. Waiting stamps are pressed in first, at most most_presses() per graph; the
    /// others keep waiting. The graph must be run, in the order in which graphs were given to the field, and
    /// the field must outlive the runs. Call once per graph. Cost: one dispatch for the image; one more if
    /// steps pass or the window moves; one of a single workgroup per stamp; four of a quarter of the threads
    /// per step that slumps.
    [[nodiscard]] TrailImage add_step(gpu::Graph& graph, const TerrainTrails& style, uint32_t ticks,
                                      glm::dvec2 centre_m);

    [[nodiscard]] static constexpr uint32_t most_presses() { return 32; }

    [[nodiscard]] static constexpr size_t most_known() { return 4096; }

    /// Returns whether any stamp was ever pressed in or waits to be pressed.
    [[nodiscard]] bool is_trodden() const { return !known_.empty() || !waiting_.empty(); }

    [[nodiscard]] uint32_t side() const { return side_; }

    [[nodiscard]] double texel_m() const { return texel_m_; }

    /// Heights in metres. Texel number n of the ground is stored at n modulo the side, in x and in y.
    [[nodiscard]] gpu::Buffer& heights() { return heights_; }

private:
    struct Known {
        TrailStamp stamp;
        int64_t pressed_ticks = 0; ///< time on the field's clock
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
    bool is_placed_ = false; ///< the window has been placed once
    uint32_t ticks_ = 0;     ///< ticks since the last step
    int slumps_left_ = 0;
    std::deque<TrailStamp> waiting_;
    std::deque<Known> known_;        ///< the oldest first
    glm::i64vec2 moved_{0};          ///< movement of the window whose new texels are not levelled yet
    bool is_arriving_whole_ = false; ///< all texels are new
    std::deque<shared::TrailPress> arriving_; ///< known stamps to repeat in the new texels
    int64_t now_ticks_ = 0;
};

/// The time at which trails are shown, and the centre of the window.
struct FootprintMoment {
    double time_s = 0.0;
    glm::dvec2 centre_m{0.0};
    bool follows = false; ///< directly follows the previous moment, as in a film: trails continue from there
};

class Footprints {
public:
    explicit Footprints(const TerrainDescription& terrain);

    /// Sets a terrain's trails and tracks. If they are unchanged, the program's stamps are kept.
    void set(const TerrainDescription& terrain);

    /// Adds stamps for the next moment. See TrailField::press().
    void press(std::span<const TrailStamp> stamps);

    /// Goes to a moment. If it follows the previous one, sand slumps and is filled step by step. Any other
    /// moment is rebuilt, so that it does not depend on what was shown before. Going back in time forgets the
    /// program's stamps after that time.
    void prepare(gpu::Device& device, const FootprintMoment& moment);

    /// See TrailField::is_behind().
    [[nodiscard]] bool is_behind() const { return field_ && field_->is_behind(); }

    void add_catching_up(gpu::Graph& graph) { field_->add_catching_up(graph, trails_); }

    /// Returns the image of TrailField::add_step(); none if nobody has walked. Call once per graph.
    [[nodiscard]] std::optional<TrailImage> add_image(gpu::Graph& graph);

    /// Side of the window, in metres.
    [[nodiscard]] double extent_m() const { return static_cast<double>(trails_.extent_m); }

private:
    void make_afresh(gpu::Device& device, double time_s);
    void walk_on(double time_s);

    TerrainTrails trails_;
    std::vector<TerrainTrack> tracks_;
    std::vector<TimedStamp> steps_; ///< stamps of all tracks, in the order of time
    size_t next_step_ = 0;
    std::vector<TrailStamp> waiting_;   ///< the program's stamps for the next moment
    std::vector<TimedStamp> pressed_;   ///< the program's stamps up to now
    std::unique_ptr<TrailField> field_; ///< null until anybody has walked
    bool is_made_afresh_ = false;
    FootprintMoment moment_;
    uint32_t ticks_due_ = 0;
};

struct ReliefInputs {
    gpu::BufferId frame; ///< FrameGlobals
    gpu::ImageId draw;
    gpu::ImageId depth;
    gpu::ImageId normal; ///< rg32ui: shading normal, smooth normal
    glm::uvec2 size_px{0};
    uint32_t terrain_draw = 0;
    glm::dvec2 anchor_m{0.0};
    glm::vec3 towards_sun{0.0F}; ///< unit vector; 0 without a sun
};

/// Bends the terrain's shading normals by trails, and turns them away from the sun where trails shade
/// themselves.
///
/// Writes  a new version of `normal`, for pixels of the terrain within the image
/// Cost    one full-screen dispatch
[[nodiscard]] gpu::ImageId add_trail_relief(gpu::Graph& graph, const ReliefInputs& in,
                                            const TrailImage& trails);

} // namespace estampe::terrain
