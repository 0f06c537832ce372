// SPDX-License-Identifier: MIT
#pragma once

// Lines that are found in screen space (between pixels), and the style settings of all lines.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <estampe/read_scope.hpp>

#include "gpu/execution_profile.hpp"
#include "gpu/graph/graph.hpp"
#include "shaders/shared.hpp"
#include "shaders/tone.glsl.h"
#include "style/parameter.hpp"
#include "techniques/contour/chains/chains.glsl.h"

namespace estampe::contour {

enum class Lines : uint8_t { chains, page };

enum class Silhouettes : uint8_t { smooth, edges };

enum class BrushFit : uint8_t { repeat, stretch };

enum class PressureFrom : uint8_t { light, turn, both };

enum class Joints : uint8_t { round, mitre };

/// Style settings of one kind of line.
struct LineStyle {
    bool enabled = true;
    float width_mm = 0.24F;       ///< width of the line in millimetres on the page
    float width_m = 0.0F;         ///< width of the line in metres of the scene; unless 0, replaces `width_mm`
    std::string brush;            ///< name of a brush or path of a picture; empty uses ContourStyle::brush
    std::optional<glm::vec3> ink; ///< linear colour of the line; if not set, ContourStyle::ink
};

/// Style settings of hidden lines, which are drawn with dashes.
struct HiddenStyle {
    bool enabled = false;
    float width_mm = 0.2F;
    float dash_mm = 1.6F;
    float gap_mm = 1.2F;
};

struct ContourStyle {
    bool enabled = true;
    Lines lines = Lines::chains;
    Silhouettes silhouettes = Silhouettes::smooth;
    glm::vec3 ink = style::srgb(0x141318);
    LineStyle outline{.width_mm = 0.58F};
    LineStyle border;
    LineStyle crease{.width_mm = 0.2F};
    float crease_deg = 60.0F;
    LineStyle marked;
    LineStyle ridge{.enabled = false};
    LineStyle valley{.enabled = false};
    float ridge_deg = 15.0F;
    LineStyle suggestive{.enabled = false};
    float suggestive_growth = 15.0F;
    float suggestive_deg = 20.0F;
    LineStyle crest{.width_mm = 0.3F};
    float crest_deg = 3.0F;
    LineStyle intersection;
    LineStyle shadow_edge{.enabled = false};
    LineStyle leaf{.width_mm = 0.2F};
    float clump_mm = 2.0F;
    float depth_step = 1.0F;
    std::string brush = "pen";
    ReadScope scope; ///< Limits the files that the style may name; no parameter
    BrushFit brush_fit = BrushFit::repeat;
    float brush_mm = 0.0F;
    Joints joints = Joints::round;
    float pressure = 0.65F;
    PressureFrom pressure_from = PressureFrom::light;
    float rank = 0.5F;
    float lost = 0.0F;
    float spared = 0.0F;
    float gap_mm = 0.0F;
    float distance_thinning = 0.7F;
    float shortest_mm = 1.5F;
    float taper_mm = 6.0F;
    float overshoot_mm = 0.0F;
    float wobble_mm = 0.0F;
    int strokes = 1;
    float retrace_mm = 0.5F;
    float jitter_ends_mm = 0.0F;
    float jitter_offset_mm = 0.0F;
    float jitter_width = 0.0F;
    HiddenStyle hidden;
    int seed = 1;
};

/// Name and help text of one kind of line in the style.
struct LineKind {
    const char* name;  ///< name of the kind's table in the style: "outline" for [contour.outline]
    const char* place; ///< where lines of the kind run, for the help text: "around objects"
    LineStyle ContourStyle::*style;
};

/// Kinds of lines in the style, indexed by shared::line_silhouette and so on. The style's outlines are
/// silhouettes, the open edges of a mesh (shared::line_border), and lines around clumps of leaves
/// (shared::line_clump). The style's borders separate materials (shared::line_boundary).
inline constexpr std::array<LineKind, shared::line_kind_count> line_kinds{
    {{"outline", "around objects", &ContourStyle::outline},
     {"outline", "where surfaces end", &ContourStyle::outline},
     {"border", "between two materials", &ContourStyle::border},
     {"crease", "along sharp folds", &ContourStyle::crease},
     {"marked", "along edges that the file marks", &ContourStyle::marked},
     {"ridge", "along rounded folds outwards (ridges)", &ContourStyle::ridge},
     {"valley", "along grooves (valleys)", &ContourStyle::valley},
     {"suggestive", "along almost-outlines (suggestive contours)", &ContourStyle::suggestive},
     {"crest", "along crests of dunes", &ContourStyle::crest},
     {"intersection", "where surfaces pass through each other", &ContourStyle::intersection},
     {"shadow_edge", "along edges of the sun's shadows", &ContourStyle::shadow_edge},
     {"outline", "around clumps of leaves", &ContourStyle::outline},
     {"leaf", "where the light ends on clumps of leaves", &ContourStyle::leaf}}};

[[nodiscard]] inline const LineStyle& line_style(const ContourStyle& style, uint32_t kind)
{
    return style.*line_kinds.at(kind).style;
}

[[nodiscard]] inline bool has_lines(const ContourStyle& style, uint32_t kind)
{
    return line_style(style, kind).enabled;
}

/// Width of a kind of line in millimetres on the page; 0 if the style does not draw the kind. Widths in
/// metres are ignored: hidden lines and the length of a brush depend only on the width on the page.
[[nodiscard]] inline float width_on_page_mm(const ContourStyle& style, uint32_t kind)
{
    const LineStyle& line = line_style(style, kind);
    return line.enabled ? line.width_mm : 0.0F;
}

[[nodiscard]] inline const glm::vec3& ink_of_kind(const ContourStyle& style, uint32_t kind)
{
    const std::optional<glm::vec3>& ink = line_style(style, kind).ink;
    return ink ? *ink : style.ink;
}

/// Whether the style sets the ink of at least one kind of line.
[[nodiscard]] bool has_inks_by_kind(const ContourStyle& style);

/// Names of the built-in brushes. A brush name in the style that is not in the list is the path of a picture.
inline const std::vector<std::string>& brush_names()
{
    static const std::vector<std::string> names{"pen", "pencil", "charcoal", "brush"};
    return names;
}

[[nodiscard]] const style::Table<ContourStyle>& contour_table();

struct BrushImages;

/// The mesh on which crests are drawn: a terrain shaped by wind.
struct CrestMesh {
    uint32_t first_vertex = 0;
    uint32_t vertex_count = 0;   ///< number of vertices of all meshes; the mesh with crests comes last
    glm::vec2 along{1.0F, 0.0F}; ///< unit vector of the direction towards which the wind blows, as (x, z)
};

struct ContourInputs {
    gpu::BufferId frame; ///< buffer with the FrameGlobals of the current frame
    gpu::BufferId visibility;
    gpu::BufferId triangles;
    gpu::BufferId posed_vertices;
    gpu::BufferId draws;
    gpu::BufferId materials;
    std::optional<CrestMesh> crests; ///< the mesh on which crests are drawn; empty if there is none
    bool own_outlines = false;       ///< at least one material sets the ink and width of its outline
    gpu::ImageId draw;
    gpu::ImageId depth;
    gpu::ImageId normal;
    gpu::ImageId coordinate;
    gpu::ImageId light;
    /// Image of the visible share of the sun at each pixel, see light::LitPixels. Set only if the edges of
    /// shadows are drawn.
    std::optional<gpu::ImageId> sun;
    /// Image with the number of the see-through draw (primitive of a mesh) at each pixel. The image is a
    /// single texel if the scene has no see-through surfaces.
    gpu::ImageId screen_draw;
    bool has_screen = false;
    bool only_cut = false; ///< draws lines only where a texture's alpha cuts the surface
    /// The scene has foliage, and chains draw lines around clumps of it instead of around every leaf.
    bool has_clumps = false;
    uint32_t first_cut_triangle = 0; ///< number of the first triangle of surfaces that alpha cuts
    shared::ToneConstants tone{};    ///< tone curve of the style, for marks on foliage
    gpu::ExecutionProfile execution;
    bool is_moving = false;         ///< the scene or the camera has moved since the previous frame
    BrushImages* brushes = nullptr; ///< brush pictures of contour chains; null if all lines are plain
    float pixels_per_mm = 1.0F;
    float line_step_px = 3.0F; ///< approximate distance between samples on chains, in pixels
    /// Size of a pixel in metres of the scene, at a distance of one metre from the eye. In parallel
    /// projection, the size is equal at all distances.
    float pixel_m_at_one = 0.001F;
    glm::uvec2 size_px{0};
    /// For each draw (primitive of a mesh in one place): the number of its style variant (the style of
    /// certain materials or objects), as r32ui texels. Set if surfaces have style variants.
    std::optional<gpu::BufferId> variant_of_draw;
    /// One VariantLines (widths and inks) per style variant (the style of certain materials or objects), for
    /// chains. Set if surfaces have style variants, or if has_inks_by_kind() is true for some variant.
    std::optional<gpu::BufferId> variant_lines;
    bool has_inks_by_kind = false;
    /// Visibility buffer of the surfaces that can hide contour lines. Set only if the scene also has surfaces
    /// that hide no lines, for example clear glass.
    std::optional<gpu::BufferId> line_hiders;
};

/// For lines in screen space: the largest distance in pixels at which a seed (short piece of line) can still
/// cover a pixel.
[[nodiscard]] uint32_t reach_px(const ContourStyle& style, float pixels_per_mm);

/// Draws lines in screen space. Where identity, depth or normal changes between pixels, the shader places a
/// seed (a short piece of line) where the nearer triangle ends. Jump flooding gives every pixel its nearest
/// seed. The distance to that seed decides how much of the pixel the line covers, so lines are antialiased
/// and can have any width.
///
/// Writes  rgba8: square root of the ink's linear colour; coverage in alpha, 0 paper to 1 ink
/// Cost    two full-screen dispatches, and one for each doubling of the width
/// Source  Saito and Takahashi, "Comprehensible Rendering of 3-D Shapes", 1990; Rong and Tan, "Jump
/// Flooding", 2006
[[nodiscard]] gpu::ImageId add_contours(gpu::Graph& graph, const ContourInputs& in,
                                        const ContourStyle& style);

/// Whether a style leaves lines white in solid black.
[[nodiscard]] bool spares_lines(const ContourStyle& style);

/// For lines that are left white in solid black: the largest distance in pixels at which the black decides.
[[nodiscard]] uint32_t spare_reach_px(const ContourStyle& style, float pixels_per_mm);

/// Hatching and lines, in the formats of hatch::add_hatch() and add_contours().
struct InkImages {
    gpu::ImageId hatch;
    gpu::ImageId lines;
};

/// Leaves lines white where the lines run through solid black, by the style's value `spared`. The hatching of
/// `ink` must mark solid black, see hatch::HatchInputs::marks_solid; the returned hatching has no marks.
/// Cost: one full-screen dispatch.
[[nodiscard]] InkImages add_spared(gpu::Graph& graph, const InkImages& ink, const ContourStyle& style,
                                   float pixels_per_mm);

} // namespace estampe::contour
