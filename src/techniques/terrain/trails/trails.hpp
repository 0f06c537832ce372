// SPDX-License-Identifier: MIT
#pragma once

// Trails in sand: what walks or is dragged over the ground presses it down and throws up a rim, the rim
// slumps, and the wind fills it again. Heights beside those of the ground, in a window that follows somebody.

#include <deque>
#include <span>

#include <glm/glm.hpp>

#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"
#include "style/parameter.hpp"

namespace estampe::terrain {

struct TrailStyle {
    float half_life_s = 90.0F;
    float repose_deg = 33.0F;
    int slumps = 8;
};

inline const style::Table<TrailStyle>& trail_table()
{
    static const auto table =
        style::Table<TrailStyle>("trails", "Footprints and trails in sand")
            .number("half_life_s", &TrailStyle::half_life_s, {0.1F, 1e6F}, "s",
                    "Time after which the wind has filled half of a trail's depth")
            .number("repose_deg", &TrailStyle::repose_deg, {5.0F, 80.0F}, "deg",
                    "Angle beyond which a rim slumps; damp sand stands steeper")
            .integer("slumps", &TrailStyle::slumps, {0, 16}, "",
                     "Steps of 1/30 s through which sand slumps after something was pressed in");
    return table;
}

/// What is pressed into the ground: a bar from one place to another with round ends. Places are x and z of
/// the world in metres.
struct TrailStamp {
    glm::dvec2 from_m{0.0};
    glm::dvec2 to_m{0.0};
    float from_radius_m = 0.1F;
    float to_radius_m = 0.1F;
    float depth_m = 0.04F; ///< of the sole under level ground; ground that is lower stays
    float rim_m = 0.08F;   ///< width of the rim around it; its height follows from the sand displaced

    [[nodiscard]] static TrailStamp disc(glm::dvec2 place_m, float radius_m, float depth_m);
    [[nodiscard]] static TrailStamp drag(glm::dvec2 from_m, glm::dvec2 to_m, float radius_m, float depth_m);
    /// A shoe so long with its middle at `place_m`, narrower at the heel; `towards` need not be of length 1.
    [[nodiscard]] static TrailStamp foot(glm::dvec2 place_m, glm::dvec2 towards, float length_m = 0.3F,
                                         float depth_m = 0.04F);
};

/// Heights to be added to those of the ground, and where they lie.
struct TrailImage {
    gpu::ImageId height; ///< r32f, metres; 0 at the edge, so that Sampling::linear is level beyond it
    glm::dvec2 corner_m; ///< x and z of the image's corner: its first texel's centre is half a texel on
    double texel_m = 0.0;
};

/// A square window of texels that follows a point by whole texels: those that stay within keep their values
/// bit for bit, wherever the window goes. Time passes in steps of 1/30 s, so that how it is split among
/// frames does not matter.
class TrailField {
public:
    /// `side` is in texels: a power of two, 16 to 1024; anything else is an std::logic_error.
    TrailField(gpu::Device& device, uint32_t side = 512, double extent_m = 32.0);

    /// Things to press in, one after the other, at the next add_step(). Those that touch nothing of the
    /// window, are not finite, or are longer than 100 m, are left out.
    void press(std::span<const TrailStamp> stamps);

    /// Lets `ticks` of 1/120 s pass with the window about `centre_m` (where that is not finite it stays), and
    /// hands out the heights. What waits is pressed in first, at most most_presses() a graph; the rest waits
    /// on. The graph must be run, and graphs in the order in which they were given to the field, which must
    /// outlive their runs. Once a graph. Cost    a dispatch for the image; where steps pass or the window
    /// moves one more, for each stamp one of
    ///         one workgroup, for each step that slumps four of a quarter of the threads
    [[nodiscard]] TrailImage add_step(gpu::Graph& graph, const TrailStyle& style, uint32_t ticks,
                                      glm::dvec2 centre_m);

    [[nodiscard]] static constexpr uint32_t most_presses() { return 32; }

    [[nodiscard]] uint32_t side() const { return side_; }

    [[nodiscard]] double texel_m() const { return texel_m_; }

    /// Heights in metres: the texel of the ground of number n is kept at n modulo the side, in x and in y.
    [[nodiscard]] gpu::Buffer& heights() { return heights_; }

private:
    [[nodiscard]] gpu::BufferId add_presses(gpu::Graph& graph, gpu::BufferId heights);
    [[nodiscard]] gpu::BufferId add_passing_steps(gpu::Graph& graph, const TrailStyle& style, uint32_t steps,
                                                  gpu::BufferId heights);
    [[nodiscard]] gpu::BufferId add_slump(gpu::Graph& graph, const TrailStyle& style, gpu::BufferId heights);
    [[nodiscard]] gpu::BufferId add_fill(gpu::Graph& graph, const TrailStyle& style, glm::i64vec2 moved,
                                         uint32_t steps, gpu::BufferId heights) const;

    gpu::Buffer heights_;
    uint32_t side_;
    double texel_m_;
    glm::i64vec2 first_{0}; ///< number of the window's first texel on the ground
    uint32_t ticks_ = 0;    ///< that have passed since the last step
    int slumps_left_ = 0;
    std::deque<TrailStamp> waiting_;
};

} // namespace estampe::terrain
