// SPDX-License-Identifier: MIT
#pragma once

// Ink that flows out of what is drawn, over the page: carried by a given flow, so that no equation of motion
// is solved, and remembered from picture to picture.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"
#include "techniques/ink/ink.glsl.h"
#include "techniques/ink/ink_style.hpp"

namespace estampe::ink {

/// The page that ink flows over, and the eye that sees it.
struct Page {
    glm::uvec2 size_px{0};
    float pixels_per_mm = 1.0F;
    glm::vec2 window_min_mm{0.0F}; ///< what its margin leaves
    glm::vec2 window_max_mm{0.0F};
    /// What a millimetre in its middle is in radians; 0 in parallel projection, which has no cube around the
    /// eye.
    float rad_per_mm = 0.0F;

    [[nodiscard]] glm::vec2 size_mm() const { return glm::vec2(size_px) / pixels_per_mm; }
};

/// Cells of ink: over the page and a margin, or on the six faces of a cube, one below the other.
struct Grid {
    glm::uvec2 size{0};
    glm::vec2 margin_cells{0.0F};
    float cells_per_px = 1.0F;
    float mm_per_cell = 1.0F; ///< of a cube, in the middle of a face
    uint32_t face_side = 0;   ///< cells of a face without its gutters; 0: no cube

    [[nodiscard]] uint64_t cell_count() const { return uint64_t{size.x} * size.y; }

    bool operator==(const Grid&) const = default;
};

[[nodiscard]] Grid grid_of(const InkStyle& style, const Page& page);

/// How the picture follows on what the ink was before.
struct Time {
    double from_s = 0.0; ///< of the ink that is there
    double to_s = 0.0;
    uint32_t steps = 0;   ///< of equal length between them
    bool is_fresh = true; ///< there is none yet
};

/// Steps of at most the length that the style asks for. Without `before_s`, or where the time since then is
/// negative or more than a second, ink starts afresh, `age_s` ago; then longer ones keep them to a hundred or
/// so.
[[nodiscard]] Time time_of(const InkStyle& style, double time_s, std::optional<double> before_s);

/// How the camera stands to how it stood in the picture before.
struct View {
    glm::mat4 before_from_clip{1.0F}; ///< from clip space of the page now, unjittered
    bool is_moved = false;            ///< that is not the identity
    bool has_motion = false;          ///< part of the scene moved by itself
    float plane_depth = 0.0F;         ///< reversed depth of a plane before the eye, for Follow::advance
    glm::vec3 forward{0.0F, 0.0F, -1.0F};
    glm::vec3 up{0.0F, 1.0F, 0.0F};
};

/// What a picture does with the ink.
struct Plan {
    Grid grid;
    Time time;
    shared::InkGlobals globals;
    std::vector<shared::InkStep> steps;
    shared::InkSpots spots; ///< of the picture's moment, for all of its steps
    uint32_t variant = 0;   ///< of the passes; that of the first step has `first_variant` besides
    uint32_t first_variant = 0;
    std::vector<uint32_t> mask; ///< one a draw: whether it gives ink; empty: all do
    /// A stream function besides, at the nodes of a flow map: square millimetres a second. Empty: none.
    std::vector<float> stream;
};

[[nodiscard]] Plan plan_of(const InkStyle& style, const Page& page, const Time& time, const View& view,
                           const std::vector<shared::InkZone>& zones);

/// Lets the flow of a stream function of `shared::ink_map_side` nodes each way over the page, square
/// millimetres a second, carry the ink of a plan besides. Around the eye there is none.
void add_stream(Plan& plan, std::vector<float> stream);

/// The ink of `plan`, which has flowed, as it lies on the same page in other pixels: no step is left to take.
[[nodiscard]] Plan shown_on(const Plan& plan, const Page& page);

/// What the ink is in from picture to picture.
class Memory {
public:
    /// Makes room for what the plan needs; what is remembered of another grid is forgotten, whose plan must
    /// start afresh. Throws Error when memory runs out, or when `flow_map` of the style cannot be read.
    void ensure(gpu::Device& device, const InkStyle& style, const Plan& plan);

    /// Has the ink that is there laid on the page of `plan`, of the same grid.
    void show(gpu::Device& device, const Plan& plan);

    /// Whether ink of this grid is there to go on from.
    [[nodiscard]] bool holds(const Grid& grid) const { return time_s_ && grid == grid_; }

    /// Of the ink that is there.
    [[nodiscard]] std::optional<double> time_s() const { return time_s_; }

    void forget() { time_s_.reset(); }

    /// To be called when the steps of `plan` have been drawn.
    void end_picture(const Plan& plan);

    /// What the next picture takes from this one.
    struct Kept {
        Grid grid;
        double time_s = 0.0;
        uint32_t sum_now = 0;
    };

    [[nodiscard]] std::optional<Kept> kept() const;
    /// Cells, depths and sums of what is kept.
    [[nodiscard]] std::array<gpu::Buffer*, 3> kept_buffers();
    void recall(gpu::Device& device, const Kept& kept, std::array<gpu::Buffer, 3> buffers);
    /// Bytes of each of the kept buffers.
    [[nodiscard]] static std::array<uint64_t, 3> kept_bytes(const Grid& grid);

private:
    friend class Passes;

    void make_room(gpu::Device& device, const Grid& grid);

    Grid grid_;
    std::optional<double> time_s_;
    std::array<gpu::Buffer, 2> cells_; ///< two sixteenths of a word each: wet, dry
    std::array<gpu::Buffer, 2> depths_;
    gpu::Buffer sums_;
    gpu::Buffer globals_;
    gpu::Buffer mask_;
    gpu::Buffer map_;
    std::vector<float> map_stream_; ///< of the picture of flow
    bool holds_picture_ = false;    ///< the map is that alone
    std::string map_file_;
    glm::vec2 map_page_mm_{0.0F};
    uint32_t newest_ = 0;
    uint32_t newest_depth_ = 0;
    uint32_t sum_now_ = 0;
};

/// What ink is given by.
struct Inputs {
    gpu::BufferId frame;                ///< FrameGlobals
    gpu::ImageId hatch;                 ///< r16f
    gpu::ImageId lines;                 ///< rgba8, coverage in alpha
    gpu::ImageId light;                 ///< rgba16f, brightness in alpha
    gpu::ImageId draw;                  ///< r32ui
    gpu::ImageId depth;                 ///< r32f, reversed
    gpu::ImageId coordinate;            ///< rgba32f, of strokes
    gpu::ImageId footprint;             ///< rgba32ui, see shaders/surface_images.glsl
    std::optional<gpu::ImageId> motion; ///< where the plan's view has any
};

/// The ink that a picture shows.
struct Flowing {
    gpu::BufferId globals;
    gpu::BufferId cells;
    gpu::BufferId sums;
    uint32_t sum_now = 0;
    uint32_t variant = 0;
};

/// Lets the steps of the plan pass.
///
/// Cost    one dispatch over the grid for what is given; one a step, of 16 texels gathered and twelve sines a
///         cell, 32 texels where something moved; one over a quarter of the page a step, or four in fresh ink
/// Source  Zanuttini, "Recherches en rendu non realiste temps reel", Universite Paris 8, 2008, section 6.5
[[nodiscard]] Flowing add_steps(gpu::Graph& graph, Memory& memory, const Plan& plan, const Inputs& in);

/// The ink that is there already, for another sample of the same picture.
[[nodiscard]] Flowing add_standing(gpu::Graph& graph, Memory& memory, const Plan& plan);

/// What lies on the page: rgba8, roots of the linear colour, cover in alpha. Cost: one full-screen dispatch
/// of four texels a pixel.
[[nodiscard]] gpu::ImageId add_layer(gpu::Graph& graph, const Flowing& ink, gpu::BufferId frame,
                                     glm::uvec2 size_px);

} // namespace estampe::ink
