// SPDX-License-Identifier: MIT
#pragma once

// Ink that flows out of the drawing over the page. A prescribed flow moves the ink, so no equation of motion
// is solved. The ink is kept from picture to picture.

#include <array>
#include <functional>
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
    glm::vec2 window_min_mm{0.0F}; ///< upper left corner of the rectangle inside the page's margin
    glm::vec2 window_max_mm{0.0F};
    /// Angle of one millimetre in the middle of the page; 0 in parallel projection, where ink in a cube
    /// around the eye is not possible.
    float rad_per_mm = 0.0F;

    [[nodiscard]] glm::vec2 size_mm() const { return glm::vec2(size_px) / pixels_per_mm; }
};

/// The grid of ink cells: over the page and a margin, or on the six faces of a cube around the eye, stored
/// one below the other.
struct Grid {
    glm::uvec2 size{0};
    glm::vec2 margin_cells{0.0F};
    float cells_per_px = 1.0F;
    float mm_per_cell = 1.0F; ///< size of a cell; on a cube, in the middle of a face
    /// Cells per side of a cube face without gutters (extra cells beyond the edges); 0: no cube.
    uint32_t face_side = 0;

    [[nodiscard]] uint64_t cell_count() const { return uint64_t{size.x} * size.y; }

    bool operator==(const Grid&) const = default;
};

[[nodiscard]] Grid grid_of(const InkStyle& style, const Page& page);

/// The time for which ink flows in one picture.
struct Time {
    double from_s = 0.0; ///< time of the kept ink
    double to_s = 0.0;
    uint32_t steps = 0;   ///< number of equal steps from `from_s` to `to_s`
    bool is_fresh = true; ///< no ink is kept yet, so ink starts new
};

/// Divides the time since the last picture into steps of at most the length that the style asks for. Ink
/// starts new, `age_s` ago, if there is no previous time `before_s`, or if the time since `before_s` is
/// negative or more than a second. The steps are lengthened if there would be more than about a hundred
/// steps.
[[nodiscard]] Time time_of(const InkStyle& style, double time_s, std::optional<double> before_s);

/// The camera, and the camera's motion since the last picture.
struct View {
    /// transform from the current picture's clip space to the last picture's clip space, without jitter
    glm::mat4 before_from_clip{1.0F};
    bool is_moved = false;    ///< `before_from_clip` is not the identity
    bool has_motion = false;  ///< some objects moved since the last picture
    float plane_depth = 0.0F; ///< reversed depth of a plane in front of the eye, for Follow::advance
    glm::vec3 forward{0.0F, 0.0F, -1.0F};
    glm::vec3 up{0.0F, 1.0F, 0.0F};
};

/// All decisions about the ink of one picture: grid, steps and constants.
struct Plan {
    Grid grid;
    Time time;
    shared::InkGlobals globals;
    std::vector<shared::InkStep> steps;
    shared::InkSpots spots; ///< spots at the picture's time, equal for all steps
    /// Bits for the shaders of all passes; the first step also has the bits of `first_variant`.
    uint32_t variant = 0;
    uint32_t first_variant = 0;
    /// Per draw call: whether the draw call gives ink; empty: all draw calls give ink.
    std::vector<uint32_t> mask;
    /// A further stream function, at the nodes of a flow map, in square millimetres per second. The vector is
    /// empty if there is no further stream function.
    std::vector<float> stream;
    std::vector<float> zone_shapes; ///< fields of the zones that have one, ink_shape_side nodes each way
};

[[nodiscard]] Plan plan_of(const InkStyle& style, const Page& page, const Time& time, const View& view,
                           const std::vector<shared::InkZone>& zones);

/// Adds a stream function to the flow of a plan: `shared::ink_map_side` nodes each way over the page, in
/// square millimetres per second. add_stream() has no effect on ink in a cube around the eye.
void add_stream(Plan& plan, std::vector<float> stream);

/// A ball of hot air that expands in front of the page, for add_blast().
struct PageBlast {
    glm::vec2 middle_mm{0.0F}; ///< middle of the ball on the page, from the upper left corner
    /// Cubed radius of the ball at a time, in cubic millimetres of the page.
    std::function<float(double time_s)> cubed_radius_mm3;
};

/// Adds a blast to the flow of a plan, which pushes ink away from the blast's middle. Has no effect on ink in
/// a cube around the eye, or beyond shared::most_ink_blasts blasts.
void add_blast(Plan& plan, const PageBlast& blast);

/// Makes a plan that shows the ink of `plan` on the page at another resolution, without further steps.
[[nodiscard]] Plan shown_on(const Plan& plan, const Page& page);

/// The ink that is kept from picture to picture.
class Memory {
public:
    /// Allocates the buffers that the ink plan (the steps of one picture) needs. Discards kept ink of another
    /// grid, so a plan for a new grid must start with no ink. Throws Error when memory runs out, or when
    /// `flow_map` of the style cannot be read.
    void ensure(gpu::Device& device, const InkStyle& style, const Plan& plan);

    /// Prepares to show the kept ink on the page of `plan`, whose grid must be unchanged.
    void show(gpu::Device& device, const Plan& plan);

    /// Whether ink of `grid` is kept, so that a plan (the ink steps of one picture) can continue from the
    /// kept ink.
    [[nodiscard]] bool holds(const Grid& grid) const { return time_s_ && grid == grid_; }

    /// The time of the kept ink; empty if no ink is kept.
    [[nodiscard]] std::optional<double> time_s() const { return time_s_; }

    void forget() { time_s_.reset(); }

    /// Call end_picture() when the steps of `plan` have been drawn.
    void end_picture(const Plan& plan);

    /// Describes the ink that the next picture continues from.
    struct Kept {
        Grid grid;
        double time_s = 0.0;
        uint32_t sum_now = 0;
    };

    [[nodiscard]] std::optional<Kept> kept() const;
    /// Buffers that are kept between pictures: cells, depths and sums.
    [[nodiscard]] std::array<gpu::Buffer*, 3> kept_buffers();
    void recall(gpu::Device& device, const Kept& kept, std::array<gpu::Buffer, 3> buffers);
    /// Size in bytes of each kept buffer.
    [[nodiscard]] static std::array<uint64_t, 3> kept_bytes(const Grid& grid);

private:
    friend class Passes;

    void make_room(gpu::Device& device, const Grid& grid);

    Grid grid_;
    std::optional<double> time_s_;
    /// Double buffer of cells: 16 bits of wet ink and 16 bits of dry ink per cell.
    std::array<gpu::Buffer, 2> cells_;
    std::array<gpu::Buffer, 2> depths_;
    gpu::Buffer sums_;
    gpu::Buffer globals_;
    gpu::Buffer mask_;
    gpu::Buffer map_;
    gpu::Buffer zone_shapes_;
    std::vector<float> map_stream_; ///< stream function that fits the picture of the flow map
    bool holds_picture_ = false;    ///< `map_` holds `map_stream_` and nothing else
    std::string map_file_;
    glm::vec2 map_page_mm_{0.0F};
    uint32_t newest_ = 0;
    uint32_t newest_depth_ = 0;
    uint32_t sum_now_ = 0;
};

/// The images that give ink, or on which ink lies.
struct Inputs {
    gpu::BufferId frame;     ///< buffer with a FrameGlobals record
    gpu::ImageId hatch;      ///< r16f: ink of the hatching strokes
    gpu::ImageId lines;      ///< rgba8: contour lines, coverage in alpha
    gpu::ImageId light;      ///< rgba16f: light on surfaces, brightness in alpha
    gpu::ImageId draw;       ///< r32ui: draw call and flags per pixel
    gpu::ImageId depth;      ///< r32f: reversed depth
    gpu::ImageId coordinate; ///< rgba32f: surface coordinate of hatching strokes
    gpu::ImageId footprint;  ///< rgba32ui: pixel footprint, see shaders/surface_images.glsl
    /// Motion of surfaces; required if the view of the ink plan has motion.
    std::optional<gpu::ImageId> motion;
};

/// The flowing ink that a picture shows.
struct Flowing {
    gpu::BufferId globals;
    gpu::BufferId cells;
    gpu::BufferId sums;
    uint32_t sum_now = 0;
    uint32_t variant = 0;
};

/// Adds the ink steps of `plan`.
///
/// Cost    one dispatch over the grid for the sources; one per step, with 16 texel reads and twelve sines per
///         cell, 32 texel reads if something moved; one over a quarter of the page per step, or every four
///         steps in fresh ink
/// Source  Zanuttini, "Recherches en rendu non realiste temps reel", Universite Paris 8, 2008, section 6.5
[[nodiscard]] Flowing add_steps(gpu::Graph& graph, Memory& memory, const Plan& plan, const Inputs& in);

/// Shows the kept ink without a step, for a further sample of one picture.
[[nodiscard]] Flowing add_standing(gpu::Graph& graph, Memory& memory, const Plan& plan);

/// Draws the flowing ink as an rgba8 layer: square roots of the linear colour, coverage in alpha. Cost: one
/// full-screen dispatch with four texel reads per pixel.
[[nodiscard]] gpu::ImageId add_layer(gpu::Graph& graph, const Flowing& ink, gpu::BufferId frame,
                                     glm::uvec2 size_px);

} // namespace estampe::ink
