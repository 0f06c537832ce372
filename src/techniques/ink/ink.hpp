// SPDX-License-Identifier: MIT
#pragma once

// Ink that flows out of the drawing over the page. A prescribed flow advects the ink, without an equation of
// motion to solve, and the ink is stored from picture to picture.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"
#include "techniques/ink/ink.glsl.h"
#include "techniques/ink/ink_style.hpp"

namespace estampe::ink {

/// The page that ink flows over, and the camera's scale.
struct Page {
    glm::uvec2 size_px{0};
    float pixels_per_mm = 1.0F;
    glm::vec2 window_min_mm{0.0F}; ///< the rectangle inside the page's margin
    glm::vec2 window_max_mm{0.0F};
    /// Angle of one millimetre in the middle of the page; 0 in parallel projection, which has no cube around
    /// the eye.
    float rad_per_mm = 0.0F;

    [[nodiscard]] glm::vec2 size_mm() const { return glm::vec2(size_px) / pixels_per_mm; }
};

/// Cells of ink: over the page and a margin, or on the six faces of a cube, one below the other.
struct Grid {
    glm::uvec2 size{0};
    glm::vec2 margin_cells{0.0F};
    float cells_per_px = 1.0F;
    float mm_per_cell = 1.0F; ///< on a cube, in the middle of a face
    uint32_t face_side = 0;   ///< cells per side of a face without its gutters; 0: no cube

    [[nodiscard]] uint64_t cell_count() const { return uint64_t{size.x} * size.y; }

    bool operator==(const Grid&) const = default;
};

[[nodiscard]] Grid grid_of(const InkStyle& style, const Page& page);

/// The time that the ink flows for in one picture.
struct Time {
    double from_s = 0.0; ///< time of the ink that is kept
    double to_s = 0.0;
    uint32_t steps = 0;   ///< number of equal steps from `from_s` to `to_s`
    bool is_fresh = true; ///< no ink is kept yet
};

/// Steps of at most the length that the style asks for. Ink starts again, `age_s` ago, if there is no
/// `before_s`, or if the time since then is negative or more than a second; the steps are then longer if
/// there would be more than about a hundred.
[[nodiscard]] Time time_of(const InkStyle& style, double time_s, std::optional<double> before_s);

/// The camera, and its motion since the last picture.
struct View {
    glm::mat4 before_from_clip{1.0F}; ///< from this picture's clip space to the last picture's, unjittered
    bool is_moved = false;            ///< `before_from_clip` is not the identity
    bool has_motion = false;          ///< some objects moved
    float plane_depth = 0.0F;         ///< reversed depth of a plane in front of the eye, for Follow::advance
    glm::vec3 forward{0.0F, 0.0F, -1.0F};
    glm::vec3 up{0.0F, 1.0F, 0.0F};
};

/// Everything that one picture does with the ink.
struct Plan {
    Grid grid;
    Time time;
    shared::InkGlobals globals;
    std::vector<shared::InkStep> steps;
    shared::InkSpots spots; ///< at the picture's time, the same for all steps
    uint32_t variant = 0;   ///< of all passes; the first step also has the bits of `first_variant`
    uint32_t first_variant = 0;
    std::vector<uint32_t> mask; ///< one per draw call: whether it gives ink; empty: all do
    /// A further stream function, at the nodes of a flow map, in square millimetres per second. Empty: none.
    std::vector<float> stream;
};

[[nodiscard]] Plan plan_of(const InkStyle& style, const Page& page, const Time& time, const View& view,
                           const std::vector<shared::InkZone>& zones);

/// Adds a stream function to the flow of a plan: `shared::ink_map_side` nodes each way over the page, in
/// square millimetres per second. Has no effect around the eye.
void add_stream(Plan& plan, std::vector<float> stream);

/// A plan that shows the ink of `plan` on the same page at another resolution, without further steps.
[[nodiscard]] Plan shown_on(const Plan& plan, const Page& page);

/// The ink that is kept from picture to picture.
class Memory {
public:
    /// Allocates what the plan needs. Forgets the ink of another grid, so a plan for a new grid must start
    /// fresh. Throws Error when memory runs out, or when `flow_map` of the style cannot be read.
    void ensure(gpu::Device& device, const InkStyle& style, const Plan& plan);

    /// Prepares to show the kept ink on the page of `plan`, whose grid must be the same.
    void show(gpu::Device& device, const Plan& plan);

    /// Whether ink of this grid is kept, so that a plan can continue from it.
    [[nodiscard]] bool holds(const Grid& grid) const { return time_s_ && grid == grid_; }

    /// The time of the kept ink; none if no ink is kept.
    [[nodiscard]] std::optional<double> time_s() const { return time_s_; }

    void forget() { time_s_.reset(); }

    /// Call this when the steps of `plan` have been drawn.
    void end_picture(const Plan& plan);

    /// Describes the ink that the next picture continues from.
    struct Kept {
        Grid grid;
        double time_s = 0.0;
        uint32_t sum_now = 0;
    };

    [[nodiscard]] std::optional<Kept> kept() const;
    /// Buffers of cells, depths and sums that are kept.
    [[nodiscard]] std::array<gpu::Buffer*, 3> kept_buffers();
    void recall(gpu::Device& device, const Kept& kept, std::array<gpu::Buffer, 3> buffers);
    /// Bytes of each of the kept buffers.
    [[nodiscard]] static std::array<uint64_t, 3> kept_bytes(const Grid& grid);

private:
    friend class Passes;

    void make_room(gpu::Device& device, const Grid& grid);

    Grid grid_;
    std::optional<double> time_s_;
    std::array<gpu::Buffer, 2> cells_; ///< 16 bits of wet ink and 16 bits of dry ink per cell
    std::array<gpu::Buffer, 2> depths_;
    gpu::Buffer sums_;
    gpu::Buffer globals_;
    gpu::Buffer mask_;
    gpu::Buffer map_;
    std::vector<float> map_stream_; ///< the stream function of the flow map's picture
    bool holds_picture_ = false;    ///< `map_` holds `map_stream_` and nothing else
    std::string map_file_;
    glm::vec2 map_page_mm_{0.0F};
    uint32_t newest_ = 0;
    uint32_t newest_depth_ = 0;
    uint32_t sum_now_ = 0;
};

/// The images that give ink.
struct Inputs {
    gpu::BufferId frame;                ///< FrameGlobals
    gpu::ImageId hatch;                 ///< r16f: ink of strokes
    gpu::ImageId lines;                 ///< rgba8, coverage in alpha
    gpu::ImageId light;                 ///< rgba16f, brightness in alpha
    gpu::ImageId draw;                  ///< r32ui, draw call and flags
    gpu::ImageId depth;                 ///< r32f, reversed
    gpu::ImageId coordinate;            ///< rgba32f, surface coordinate of strokes
    gpu::ImageId footprint;             ///< rgba32ui, see shaders/surface_images.glsl
    std::optional<gpu::ImageId> motion; ///< required if the plan's view has motion
};

/// The ink that a picture shows.
struct Flowing {
    gpu::BufferId globals;
    gpu::BufferId cells;
    gpu::BufferId sums;
    uint32_t sum_now = 0;
    uint32_t variant = 0;
};

/// Adds the steps of the plan.
///
/// Cost    one dispatch over the grid for the sources; one per step, with 16 texel reads and twelve sines per
///         cell, 32 texel reads if something moved; one over a quarter of the page per step, or every four
///         steps in fresh ink
/// Source  Zanuttini, "Recherches en rendu non realiste temps reel", Universite Paris 8, 2008, section 6.5
[[nodiscard]] Flowing add_steps(gpu::Graph& graph, Memory& memory, const Plan& plan, const Inputs& in);

/// Shows the kept ink without a step, for a further sample of the same picture.
[[nodiscard]] Flowing add_standing(gpu::Graph& graph, Memory& memory, const Plan& plan);

/// Draws the ink as an rgba8 layer: square roots of the linear colour, coverage in alpha. Cost: one
/// full-screen dispatch with four texel reads per pixel.
[[nodiscard]] gpu::ImageId add_layer(gpu::Graph& graph, const Flowing& ink, gpu::BufferId frame,
                                     glm::uvec2 size_px);

} // namespace estampe::ink
