// SPDX-License-Identifier: MIT
#pragma once

// Trails in sand. A person or an object that moves over the ground presses the sand down and raises a rim.
// The rim slumps, and the wind fills the trail again. Trails are heights that are added to the ground's
// heights, in a window that follows a point. The trails of a picture come from the tracks in the terrain's
// file and from stamps that the program presses.

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

/// A stamp (a shape pressed into the sand, such as a footprint) and the time at which it is pressed.
struct TimedStamp {
    TrailStamp stamp;
    double time_s = 0.0;
};

/// The stamps of a track in their order: left and right footprints, each slightly different, or short pieces
/// of a drag mark. The track is the curve of Catmull and Rom, "A Class of Local Interpolating Splines", 1974.
/// Cost: linear in the length of the track.
[[nodiscard]] std::vector<TimedStamp> stamps_of(const TerrainTrack& track);

/// An image of heights that are added to the ground's heights, and its position.
struct TrailImage {
    /// R32f: height in metres; 0 at the edge, so that Sampling::linear gives level ground beyond the image.
    gpu::ImageId height;
    /// World x and z of the image's corner, half a texel before the centre of the first texel.
    glm::dvec2 corner_m;
    double texel_m = 0.0;
};

/// A square window of texels that follows a point in steps of whole texels. Texels that stay inside the
/// window keep their values bit for bit. In texels that enter the window, remembered stamps (pressed shapes)
/// are repeated at their age. Time passes in steps of 1/30 s, so the results do not depend on how time is
/// divided into frames.
class TrailField {
public:
    /// `side` is the number of texels per side: a power of two, 16 to 1024; other values throw
    /// std::logic_error.
    TrailField(gpu::Device& device, uint32_t side = 512, double extent_m = 32.0);

    /// Adds stamps (pressed shapes) that the next add_step() presses into the sand, in their order. Ignores
    /// stamps that are not finite or longer than 100 m. The field remembers the last most_known() stamps.
    void press(std::span<const TrailStamp> stamps);

    /// Remembers a stamp (a pressed shape) that was pressed `age_s` seconds ago. The stamp appears only in
    /// texels that enter the window from now on.
    void remember(const TrailStamp& stamp, double age_s);

    /// Lets the field's time jump by `ticks`. The next add_step() rebuilds all texels from the remembered
    /// stamps (pressed shapes) at their new age.
    void pass(uint32_t ticks);

    /// Centres the window on a place. Does nothing if the place is not finite.
    void go_to(const TerrainTrails& style, glm::dvec2 centre_m);

    /// Returns whether more remembered stamps (pressed shapes) enter the window than one step can press. If
    /// so, first run graphs that contain only add_catching_up().
    [[nodiscard]] bool is_behind() const { return arriving_.size() > most_presses(); }

    void add_catching_up(gpu::Graph& graph, const TerrainTrails& style);

    /// Lets `ticks` of 1/120 s pass with the window centred on `centre_m` (unchanged if `centre_m` is not
    /// finite), and returns the heights. First presses the waiting stamps (shapes), at most most_presses()
    /// per graph; further stamps keep waiting. Graphs must be run in the order in which they were given to
    /// the field, and the field must outlive the runs. Call once per graph. Cost: one dispatch for the image;
    /// one more dispatch if time steps pass or the window moves; a dispatch of one workgroup per stamp; per
    /// step that slumps, four dispatches of a quarter of the threads.
    [[nodiscard]] TrailImage add_step(gpu::Graph& graph, const TerrainTrails& style, uint32_t ticks,
                                      glm::dvec2 centre_m);

    [[nodiscard]] static constexpr uint32_t most_presses() { return 32; }

    [[nodiscard]] static constexpr size_t most_known() { return 4096; }

    /// Returns whether any stamp (pressed shape) was ever pressed or waits to be pressed.
    [[nodiscard]] bool is_trodden() const { return !known_.empty() || !waiting_.empty(); }

    [[nodiscard]] uint32_t side() const { return side_; }

    [[nodiscard]] double texel_m() const { return texel_m_; }

    /// Heights of the trails in metres. Texel number n of the ground is stored at index n modulo the side, in
    /// x and in y.
    [[nodiscard]] gpu::Buffer& heights() { return heights_; }

private:
    struct Known {
        TrailStamp stamp;
        int64_t pressed_ticks = 0; ///< time at which the stamp was pressed, in ticks on the field's clock
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
    glm::i64vec2 first_{0};  ///< column and row number on the ground of the window's first texel
    bool is_placed_ = false; ///< the window has a position; false until it is placed for the first time
    uint32_t ticks_ = 0;     ///< ticks that have passed since the last time step
    int slumps_left_ = 0;
    std::deque<TrailStamp> waiting_;
    std::deque<Known> known_; ///< the remembered stamps, the oldest first
    /// Movement of the window, in texels, since new texels were last set to level ground.
    glm::i64vec2 moved_{0};
    bool is_arriving_whole_ = false;          ///< all texels of the window are new
    std::deque<shared::TrailPress> arriving_; ///< remembered stamps to repeat in the window's new texels
    int64_t now_ticks_ = 0;
};

/// The time at which trails are shown, and the centre of the window.
struct FootprintMoment {
    double time_s = 0.0;
    glm::dvec2 centre_m{0.0};
    /// True if the moment to show directly follows the previously shown moment, as in a film. The trails then
    /// continue.
    bool follows = false;
};

class Footprints {
public:
    explicit Footprints(const TerrainDescription& terrain);

    /// Sets the trails and tracks of a terrain. Keeps the program's stamps if trails and tracks are
    /// unchanged.
    void set(const TerrainDescription& terrain);

    /// Adds stamps for the next moment, see TrailField::press().
    void press(std::span<const TrailStamp> stamps);

    /// Sets the time at which the trails are shown. If the new moment follows the previously shown moment,
    /// sand slumps and trails are filled step by step. For any other moment, the trails are rebuilt, so that
    /// they do not depend on what was shown before. Going back to an earlier moment forgets the program's
    /// stamps (pressed shapes) after that moment.
    void prepare(gpu::Device& device, const FootprintMoment& moment);

    /// Returns whether more remembered stamps (pressed shapes) enter the window than one step can press, see
    /// TrailField::is_behind().
    [[nodiscard]] bool is_behind() const { return field_ && field_->is_behind(); }

    void add_catching_up(gpu::Graph& graph) { field_->add_catching_up(graph, trails_); }

    /// Returns the image of TrailField::add_step(), or none if nobody has walked. Call once per graph.
    [[nodiscard]] std::optional<TrailImage> add_image(gpu::Graph& graph);

    /// Side of the window of trails, in metres.
    [[nodiscard]] double extent_m() const { return static_cast<double>(trails_.extent_m); }

private:
    void make_afresh(gpu::Device& device, double time_s);
    void walk_on(double time_s);

    TerrainTrails trails_;
    std::vector<TerrainTrack> tracks_;
    std::vector<TimedStamp> steps_; ///< stamps (pressed shapes) of all tracks, sorted by time
    size_t next_step_ = 0;
    std::vector<TrailStamp> waiting_;   ///< the program's stamps (pressed shapes) for the next moment
    std::vector<TimedStamp> pressed_;   ///< the program's stamps (pressed shapes) up to the current moment
    std::unique_ptr<TrailField> field_; ///< the window of trails; null until the first stamp is pressed
    bool is_made_afresh_ = false;
    FootprintMoment moment_;
    uint32_t ticks_due_ = 0;
};

struct ReliefInputs {
    gpu::BufferId frame; ///< buffer with the FrameGlobals of the current frame
    gpu::ImageId draw;
    gpu::ImageId depth;
    gpu::ImageId normal; ///< rg32ui: shading normal in the first channel, smooth normal in the second
    glm::uvec2 size_px{0};
    uint32_t terrain_draw = 0;
    glm::dvec2 anchor_m{0.0};
    glm::vec3 towards_sun{0.0F}; ///< unit vector; zero if there is no sun
};

/// Tilts the terrain's shading normals by the slope of trails (footprints and drag marks), and turns them
/// away from the sun where trails shade themselves.
///
/// Writes  a new version of `normal`; the normals change at pixels of the terrain within the image of trails
/// Cost    one full-screen dispatch
[[nodiscard]] gpu::ImageId add_trail_relief(gpu::Graph& graph, const ReliefInputs& in,
                                            const TrailImage& trails);

} // namespace estampe::terrain
