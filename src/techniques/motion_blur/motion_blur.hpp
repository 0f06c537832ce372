// SPDX-License-Identifier: MIT
#pragma once

// What moves while the shutter is open is blurred along its way, or drawn with speed lines or smear strokes:
// strokes of a dry brush behind it, as animators and comic artists draw it.

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

/// Speed lines or smear strokes: drawn marks of motion.
struct MotionMarks {
    bool enabled = false;
    float length = 5.0F;
    float spacing_mm = 3.0F;
    float width_mm = 0.0F;
    float from_mm = 0.0F;
    glm::vec3 ink = style::srgb(0x1c1a20);
};

struct MotionBlurStyle {
    bool enabled = false; ///< the blur; speed lines and smear strokes have their own
    Mode mode = Mode::tiles;
    float shutter_deg = 180.0F;
    float frames_per_s = 24.0F;
    float largest_mm = 12.0F;
    MotionMarks speed_lines{.width_mm = 0.3F, .from_mm = 1.5F};
    MotionMarks smear{.width_mm = 2.5F, .from_mm = 1.0F};
    int seed = 1;
};

[[nodiscard]] const style::Table<MotionBlurStyle>& motion_blur_table();

/// A scene has about that many seeds, shared alike by its draws; and each draw four at least, up to four
/// times that many in all.
inline constexpr uint32_t smear_seed_count = 2048;

/// Places on the triangles (three vertices and a draw) whose numbers are in `of`, spread by area in the pose
/// of `places` over each draw. The same for the same triangles. Cost: linear.
[[nodiscard]] std::vector<shared::SmearSeed> spread_seeds(std::span<const uint32_t> of,
                                                          std::span<const glm::uvec4> triangles,
                                                          std::span<const glm::vec3> places);

/// Seeds of smear strokes on the device, made when a style first asks for smear strokes.
struct SmearSeeds {
    gpu::Buffer places;
    uint32_t count = 0;
    bool is_made = false;
};

[[nodiscard]] SmearSeeds upload_seeds(gpu::Device& device, const std::vector<shared::SmearSeed>& seeds);

/// Of the scene.
struct SmearScene {
    gpu::BufferId frame;
    gpu::BufferId triangles;
    gpu::BufferId posed_vertices;
    gpu::BufferId posed_vertices_before;
    glm::mat4 clip_from_anchor_before; ///< shifted within a pixel as the frame's
    SmearSeeds* seeds;
};

/// Of the page.
struct SmearPage {
    gpu::ImageId page;        ///< rgba32ui: in its last word the way of half the exposure
    gpu::ImageId owner_depth; ///< r32f: of what a line belongs to
    gpu::ImageId depth;       ///< r32f
    glm::uvec2 size_px{0};
};

/// What all passes share, `size_px`, the seeds and the camera before aside.
[[nodiscard]] shared::SmearConstants smear_constants_of(const MotionBlurStyle& style, float scale,
                                                        float most_px, float pixels_per_mm);

/// Draws smear strokes into `lines`. Where nothing moves, or the scene has nothing to move, they keep their
/// bits.
///
/// Cost    one thread a seed that goes to the edge of its body; one a seed that is compared with all others
///         where it gave a stroke; lists of 64 x 64 pixels; a pass over the page, of 63 strokes a pixel at
///         most
[[nodiscard]] gpu::ImageId add_smear(gpu::Graph& graph, const SmearScene& scene, const SmearPage& page,
                                     gpu::ImageId lines, shared::SmearConstants constants);

/// How long the shutter is open, in seconds.
[[nodiscard]] double exposure_s(const MotionBlurStyle& style);

/// Whether the style asks for anything that hangs on motion.
[[nodiscard]] bool is_wanted(const MotionBlurStyle& style);

/// What all passes share; `scale` is from motion on the page to the way in half the exposure, `line_half_px`
/// half the widest line of the scene.
[[nodiscard]] shared::MotionBlurConstants constants_of(const MotionBlurStyle& style, float scale,
                                                       float pixels_per_mm, float line_half_px);

struct VelocityShapeInputs {
    gpu::BufferId posed_vertices;
    gpu::BufferId posed_vertices_before;
    glm::mat4 now_from_before{1.0F}; ///< from where something stood to where it would be seen alike now
    float share = 0.0F;              ///< from motion to the way in half the exposure
};

/// A shape that is drawn for its velocities alone: its vertices now, and where they stood before.
struct VelocityShape {
    gpu::BufferId vertices;
    gpu::BufferId before;
};

/// What the style's mode keeps of the scene from frame to frame; most keep nothing.
class Memory {
public:
    Memory();
    ~Memory();
    Memory(const Memory&) = delete;
    Memory& operator=(const Memory&) = delete;
    Memory(Memory&&) = delete;
    Memory& operator=(Memory&&) = delete;

    /// Whether the style's mode needs set_vertices() first.
    [[nodiscard]] bool lacks_vertices(const MotionBlurStyle& style) const;

    /// `places` are of posed vertices at rest. Cost: n log n.
    void set_vertices(gpu::Device& device, std::span<const glm::vec3> places,
                      std::span<const uint32_t> draw_of_vertex);

    /// The scene has other vertices.
    void forget();

private:
    friend std::optional<VelocityShape> add_velocity_shape(gpu::Graph&, Memory&, const VelocityShapeInputs&,
                                                           const MotionBlurStyle&);
    struct Kept;
    std::unique_ptr<Kept> kept_;
};

/// The shape whose motion MotionBlurInputs wants, where the style's mode looks past the outlines of what
/// moves; none where that is the scene as it stands.
[[nodiscard]] std::optional<VelocityShape> add_velocity_shape(gpu::Graph& graph, Memory& memory,
                                                              const VelocityShapeInputs& in,
                                                              const MotionBlurStyle& style);

struct MotionBlurInputs {
    gpu::ImageId motion; ///< rgba32f: pixels to the right and down, the depth before, 1 where known
    gpu::ImageId
        own_motion;     ///< what of the page moves where nothing in `motion` does; the same unless stretched
    gpu::ImageId depth; ///< r32f: reversed, 0 where nothing is
    gpu::ImageId wash;  ///< rgba16f
    gpu::ImageId hatch; ///< r16f
    gpu::ImageId lines; ///< rgba8
    gpu::ImageId sky_ink; ///< r16f
    bool has_sky = false; ///< else there is no such ink
    glm::uvec2 size_px{0};
    glm::uvec2 window_min_px{0}; ///< tiles beyond the window are left as they are
    glm::uvec2 window_max_px{~0U};
    std::optional<SmearScene> smear; ///< where the style has it
    bool by_groups = false; ///< the pixels of a tile are looked at by as many threads, as GPUs like it
};

struct MotionBlurLayers {
    gpu::ImageId wash;
    gpu::ImageId hatch;
    gpu::ImageId lines;
    bool holds_sky = true; ///< `hatch` has the sky's ink where nothing is seen
};

/// Draws layers as they are seen while the shutter is open, all together, so that on paper they are the
/// picture blurred; and speed lines and smear strokes over them.
///
/// Writes  the layers in place, or new ones; what stands still, and is not passed by anything, keeps its bits
/// Cost    a pass over the page that packs it, two over its tiles, one of 64 texels a pixel at most over the
///         tiles that anything moves through; speed lines three more, of 16 lines a pixel at most; smear
///         strokes those of add_smear()
[[nodiscard]] MotionBlurLayers add_motion_blur(gpu::Graph& graph, const MotionBlurInputs& in,
                                               const MotionBlurStyle& style,
                                               shared::MotionBlurConstants constants,
                                               const shared::SmearConstants& smear);

} // namespace estampe::motion_blur
