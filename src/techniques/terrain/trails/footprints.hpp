// SPDX-License-Identifier: MIT
#pragma once

// The trails of a terrain as a picture of it has them: tracks of its file, and what a program presses in.

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <estampe/terrain.hpp>

#include "techniques/terrain/trails/trails.hpp"

namespace estampe::terrain {

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
