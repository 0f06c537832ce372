// SPDX-License-Identifier: MIT
#pragma once

// Motion during the exposure. Moving objects are blurred along their motion, or drawn with speed lines or
// smear strokes. Smear strokes are dry brush strokes behind an object, as animators and comic artists draw
// them.

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"
#include "style/parameter.hpp"
#include "techniques/motion_blur/motion_blur.glsl.h"

namespace estampe::motion_blur {

enum class Mode : uint8_t { tiles, own, stretched, velocity };

/// Style of speed lines or of smear strokes: drawn marks of motion.
struct MotionMarks {
    bool enabled = false;
    float length = 5.0F;
    float spacing_mm = 3.0F;
    float width_mm = 0.0F;
    float from_mm = 0.0F;
    glm::vec3 ink = style::srgb(0x1c1a20);
};

struct MotionBlurStyle {
    bool enabled = false; ///< turns the blur on; speed lines and smear strokes have their own switches
    Mode mode = Mode::tiles;
    float shutter_deg = 180.0F;
    float frames_per_s = 24.0F;
    float largest_mm = 12.0F;
    MotionMarks speed_lines{.width_mm = 0.3F, .from_mm = 1.5F};
    MotionMarks smear{.width_mm = 2.5F, .from_mm = 1.0F};
    int seed = 1;
};

[[nodiscard]] const style::Table<MotionBlurStyle>& motion_blur_table();

/// Approximate number of seeds (possible starts) of smear strokes in a scene, divided equally between the
/// draw calls. Each draw call has at least four seeds, so a scene may have up to four times the approximate
/// number.
inline constexpr uint32_t smear_seed_count = 2048;

/// Distributes seeds (possible starts) of smear strokes evenly over the area of each draw (mesh primitive) of
/// a scene, in the pose `places`. `of` lists the triangles to use, and `triangles` has three vertices and a
/// draw per triangle. The result depends only on the triangles and the pose. Cost: linear.
[[nodiscard]] std::vector<shared::SmearSeed> spread_seeds(std::span<const uint32_t> of,
                                                          std::span<const glm::uvec4> triangles,
                                                          std::span<const glm::vec3> places);

/// Seeds of smear strokes on the device. The seeds are made when a style uses smear strokes for the first
/// time.
struct SmearSeeds {
    gpu::Buffer places;
    uint32_t count = 0;
    bool is_made = false;
};

[[nodiscard]] SmearSeeds upload_seeds(gpu::Device& device, const std::vector<shared::SmearSeed>& seeds);

/// The inputs of smear strokes that come from the scene.
struct SmearScene {
    gpu::BufferId frame;
    gpu::BufferId triangles;
    gpu::BufferId posed_vertices;
    gpu::BufferId posed_vertices_before;
    glm::mat4 clip_from_anchor_before; ///< camera of the previous frame, with its subpixel jitter
    SmearSeeds* seeds;
};

/// The inputs of smear strokes that come from the page.
struct SmearPage {
    gpu::ImageId page; ///< packed layers, rgba32ui; the last word is the displacement in half the exposure
    /// R32f: reversed depth. At a pixel of a contour line, it is the depth of the surface to which the line
    /// belongs.
    gpu::ImageId owner_depth;
    gpu::ImageId depth; ///< r32f: reversed depth (1 at the near plane)
    glm::uvec2 size_px{0};
};

/// Returns the constants of all passes of smear strokes, except `size_px`, the seeds and the previous camera.
[[nodiscard]] shared::SmearConstants smear_constants_of(const MotionBlurStyle& style, float scale,
                                                        float most_px, float pixels_per_mm);

/// Draws smear strokes into the ink layer `lines`. The layer `lines` stays bit-identical if nothing moves, or
/// if the scene has nothing that can move.
///
/// Cost    one thread per seed, which walks to the edge of its body; one thread per stroke, which compares
///         the stroke with all others; lists for blocks of 64 x 64 pixels; one pass over the page with at
///         most 63 strokes per pixel
[[nodiscard]] gpu::ImageId add_smear(gpu::Graph& graph, const SmearScene& scene, const SmearPage& page,
                                     gpu::ImageId lines, shared::SmearConstants constants);

/// Exposure time of the shutter, in seconds.
[[nodiscard]] double exposure_s(const MotionBlurStyle& style);

/// Returns whether the style draws motion blur, speed lines or smear strokes.
[[nodiscard]] bool is_wanted(const MotionBlurStyle& style);

/// Returns the constants of all passes of motion blur and speed lines. `scale` is the factor from motion on
/// the page to the displacement in half the exposure. `line_half_px` is half the width of the scene's widest
/// line.
[[nodiscard]] shared::MotionBlurConstants constants_of(const MotionBlurStyle& style, float scale,
                                                       float pixels_per_mm, float line_half_px);

struct VelocityShapeInputs {
    gpu::BufferId posed_vertices;
    gpu::BufferId posed_vertices_before;
    /// Transforms positions of the previous frame, so that the current camera sees them at the place where
    /// the previous camera saw them.
    glm::mat4 now_from_before{1.0F};
    float share = 0.0F; ///< the motion times `share` is the displacement in half the exposure
};

/// Vertices of a shape that is drawn only to get a velocity per pixel: its current and its previous vertices.
struct VelocityShape {
    gpu::BufferId vertices;
    gpu::BufferId before;
};

/// Data that a mode of motion blur keeps between frames; most modes keep nothing.
class Memory {
public:
    Memory();
    ~Memory();
    Memory(const Memory&) = delete;
    Memory& operator=(const Memory&) = delete;
    Memory(Memory&&) = delete;
    Memory& operator=(Memory&&) = delete;

    /// Returns whether the style's mode of motion blur needs a call of set_vertices() first.
    [[nodiscard]] bool lacks_vertices(const MotionBlurStyle& style) const;

    /// Sets the vertices of the scene in the rest pose (without animation). Cost: n log n.
    void set_vertices(gpu::Device& device, std::span<const glm::vec3> places,
                      std::span<const uint32_t> draw_of_vertex);

    /// Forgets the stored vertices. Call this function when the scene's vertices have changed.
    void forget();

private:
    friend std::optional<VelocityShape> add_velocity_shape(gpu::Graph&, Memory&, const VelocityShapeInputs&,
                                                           const MotionBlurStyle&);
    struct Kept;
    std::unique_ptr<Kept> kept_;
};

/// Returns the shape whose motion must be passed as MotionBlurInputs::motion, if the style's mode stretches
/// shapes beyond their outlines. Returns none if no shape is stretched and the scene's own motion is used.
[[nodiscard]] std::optional<VelocityShape> add_velocity_shape(gpu::Graph& graph, Memory& memory,
                                                              const VelocityShapeInputs& in,
                                                              const MotionBlurStyle& style);

struct MotionBlurInputs {
    /// Rgba32f: motion in pixels to the right and down; previous reversed depth; 1 where the motion is known.
    gpu::ImageId motion;
    /// Motion of the surfaces before shapes are stretched, used where `motion` is 0. The two images differ
    /// only in the style's mode `stretched`.
    gpu::ImageId own_motion;
    gpu::ImageId depth;   ///< r32f: reversed depth (1 at the near plane), 0 where no surface is visible
    gpu::ImageId wash;    ///< rgba16f: transmittance of the paint
    gpu::ImageId hatch;   ///< r16f: coverage by hatching
    gpu::ImageId lines;   ///< rgba8: colour and coverage of lines
    gpu::ImageId sky_ink; ///< r16f: coverage by the sky's strokes
    bool has_sky = false; ///< the sky has strokes; otherwise `sky_ink` is not used
    glm::uvec2 size_px{0};
    glm::uvec2 window_min_px{0}; ///< corner of the window, outside of which tiles of the page stay unchanged
    glm::uvec2 window_max_px{~0U};
    std::optional<SmearScene> smear; ///< inputs of smear strokes; set if the style draws them
    /// Finds the longest motion in a tile with one thread per pixel instead of one thread per tile; faster on
    /// a GPU.
    bool by_groups = false;
};

struct MotionBlurLayers {
    gpu::ImageId wash;
    gpu::ImageId hatch;
    gpu::ImageId lines;
    bool holds_sky = true; ///< after the blur, `hatch` contains the sky's strokes where no surface is visible
};

/// Blurs all layers together by the motion during the exposure, so that the finished picture looks blurred
/// while the paper stays sharp. Then draws speed lines and smear strokes over the layers.
///
/// Writes  the layers in place, or new layers; still pixels over which nothing moves stay bit-identical
/// Cost    one pass over the page for packing, two over its tiles, one over the tiles that a moving surface
///         passes over, with at most 64 texels per pixel; speed lines: three more passes with at most 16
///         lines per pixel; smear strokes: the cost of add_smear()
[[nodiscard]] MotionBlurLayers add_motion_blur(gpu::Graph& graph, const MotionBlurInputs& in,
                                               const MotionBlurStyle& style,
                                               shared::MotionBlurConstants constants,
                                               const shared::SmearConstants& smear);

} // namespace estampe::motion_blur
