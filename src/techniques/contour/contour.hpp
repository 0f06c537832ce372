// SPDX-License-Identifier: MIT
#pragma once

// Lines drawn in screen space, and the style of all lines.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "gpu/execution_profile.hpp"
#include "gpu/graph/graph.hpp"
#include "shaders/shared.hpp"
#include "style/parameter.hpp"
#include "techniques/contour/chains/chains.glsl.h"

namespace estampe::contour {

enum class Lines : uint8_t { chains, page };

enum class Silhouettes : uint8_t { smooth, edges };

enum class BrushFit : uint8_t { repeat, stretch };

enum class PressureFrom : uint8_t { light, turn, both };

enum class Joints : uint8_t { round, mitre };

enum class Hidden : uint8_t { none, dashed };

struct ContourStyle {
    bool drawn = true;
    Lines lines = Lines::chains;
    Silhouettes silhouettes = Silhouettes::smooth;
    glm::vec3 ink = style::srgb(0x141318);
    float outline_mm = 0.58F; ///< width on the page; line_kind_keys lists the settings of each kind of line
    float boundary_mm = 0.24F;
    float crease_mm = 0.2F;
    float crease_deg = 60.0F;
    float marked_mm = 0.24F;
    float ridge_mm = 0.0F;
    float valley_mm = 0.0F;
    float ridge_deg = 15.0F;
    float suggestive_mm = 0.0F;
    float suggestive_growth = 15.0F;
    float suggestive_deg = 20.0F;
    float crest_mm = 0.3F;
    float crest_deg = 3.0F;
    float intersection_mm = 0.24F;
    float shadow_mm = 0.0F;
    float depth_step = 1.0F;
    std::string brush = "pen";
    std::string outline_brush;      ///< brush of outlines; empty uses `brush`
    std::string boundary_brush;     ///< brush of boundaries; empty uses `brush`
    std::string crease_brush;       ///< brush of creases; empty uses `brush`
    std::string marked_brush;       ///< brush of marked edges; empty uses `brush`
    std::string ridge_brush;        ///< brush of ridges; empty uses `brush`
    std::string valley_brush;       ///< brush of valleys; empty uses `brush`
    std::string suggestive_brush;   ///< brush of suggestive contours; empty uses `brush`
    std::string crest_brush;        ///< brush of crests; empty uses `brush`
    std::string intersection_brush; ///< brush of intersections; empty uses `brush`
    std::string shadow_brush;       ///< brush of edges of shadows; empty uses `brush`
    BrushFit brush_fit = BrushFit::repeat;
    float brush_mm = 0.0F;
    float outline_m = 0.0F; ///< width in the scene; unless 0, replaces the width on the page
    float boundary_m = 0.0F;
    float crease_m = 0.0F;
    float marked_m = 0.0F;
    float ridge_m = 0.0F;
    float valley_m = 0.0F;
    float suggestive_m = 0.0F;
    float crest_m = 0.0F;
    float intersection_m = 0.0F;
    float shadow_m = 0.0F;
    Joints joints = Joints::round;
    float pressure = 0.65F;
    PressureFrom pressure_from = PressureFrom::light;
    float distance_thinning = 0.7F;
    float taper_mm = 6.0F;
    float overshoot_mm = 0.0F;
    float wobble_mm = 0.0F;
    int strokes = 1;
    float retrace_mm = 0.5F;
    float jitter_ends_mm = 0.0F;
    float jitter_offset_mm = 0.0F;
    float jitter_width = 0.0F;
    Hidden hidden = Hidden::none;
    float hidden_mm = 0.2F;
    float hidden_dash_mm = 1.6F;
    float hidden_gap_mm = 1.2F;
    int seed = 1;
};

/// Settings that each kind of line has.
struct LineKindKeys {
    const char* name;  ///< prefix of the style keys
    const char* place; ///< where such lines run, for help: "lines around objects"
    float ContourStyle::*width_mm;
    float ContourStyle::*width_m;
    std::string ContourStyle::*brush;
};

/// Indexed by kind of line: shared::line_silhouette and so on.
inline constexpr std::array<LineKindKeys, shared::line_kind_count> line_kind_keys{{
    {"outline", "around objects", &ContourStyle::outline_mm, &ContourStyle::outline_m,
     &ContourStyle::outline_brush},
    {"outline", "where surfaces end", &ContourStyle::outline_mm, &ContourStyle::outline_m,
     &ContourStyle::outline_brush},
    {"boundary", "between materials", &ContourStyle::boundary_mm, &ContourStyle::boundary_m,
     &ContourStyle::boundary_brush},
    {"crease", "along sharp folds", &ContourStyle::crease_mm, &ContourStyle::crease_m,
     &ContourStyle::crease_brush},
    {"marked", "along marked edges", &ContourStyle::marked_mm, &ContourStyle::marked_m,
     &ContourStyle::marked_brush},
    {"ridge", "along ridges", &ContourStyle::ridge_mm, &ContourStyle::ridge_m, &ContourStyle::ridge_brush},
    {"valley", "along valleys", &ContourStyle::valley_mm, &ContourStyle::valley_m,
     &ContourStyle::valley_brush},
    {"suggestive", "along suggestive contours", &ContourStyle::suggestive_mm, &ContourStyle::suggestive_m,
     &ContourStyle::suggestive_brush},
    {"crest", "along crests of dunes", &ContourStyle::crest_mm, &ContourStyle::crest_m,
     &ContourStyle::crest_brush},
    {"intersection", "where surfaces pass through each other", &ContourStyle::intersection_mm,
     &ContourStyle::intersection_m, &ContourStyle::intersection_brush},
    {"shadow", "along edges of the sun's shadows", &ContourStyle::shadow_mm, &ContourStyle::shadow_m,
     &ContourStyle::shadow_brush},
}};

/// Whether a style draws a kind of line, because it has a width on the page or in the scene.
[[nodiscard]] inline bool has_lines(const ContourStyle& style, uint32_t kind)
{
    const LineKindKeys& keys = line_kind_keys.at(kind);
    return style.*keys.width_mm > 0.0F || style.*keys.width_m > 0.0F;
}

/// Width of a kind of line on the page. Hidden lines and the length of a brush need it, because they ignore
/// widths in the scene. If the style has only a width in the scene, a usual width; 0 if it has none.
[[nodiscard]] inline float width_on_page_mm(const ContourStyle& style, uint32_t kind)
{
    constexpr float usual_mm = 0.3F;
    const float width_mm = style.*line_kind_keys.at(kind).width_mm;
    return width_mm > 0.0F || !has_lines(style, kind) ? width_mm : usual_mm;
}

/// Names of the built-in brushes; any other name is the path of a picture.
inline const std::vector<std::string>& brush_names()
{
    static const std::vector<std::string> names{"pen", "pencil", "charcoal", "brush"};
    return names;
}

[[nodiscard]] const style::Table<ContourStyle>& contour_table();

struct BrushImages;

/// The mesh whose crests have lines: a wind-shaped terrain.
struct CrestMesh {
    uint32_t first_vertex = 0;
    uint32_t vertex_count = 0;   ///< number of vertices of all meshes; this mesh is the last
    glm::vec2 along{1.0F, 0.0F}; ///< direction that the wind blows to, along x and z; unit
};

struct ContourInputs {
    gpu::BufferId frame; ///< FrameGlobals
    gpu::BufferId visibility;
    gpu::BufferId triangles;
    gpu::BufferId posed_vertices;
    gpu::BufferId draws;
    gpu::BufferId materials;
    std::optional<CrestMesh> crests; ///< set if chains run along crests
    bool own_outlines = false;       ///< some material has its own outline
    gpu::ImageId draw;
    gpu::ImageId depth;
    gpu::ImageId normal;
    gpu::ImageId coordinate;
    gpu::ImageId light;
    std::optional<gpu::ImageId> sun; ///< as light::LitPixels; only if edges of shadows are drawn
    gpu::ImageId screen_draw;        ///< draw image of see-through surfaces; one texel if there are none
    bool has_screen = false;
    bool only_cut = false; ///< lines only where the alpha of a texture cuts the surface
    gpu::ExecutionProfile execution;
    bool is_moving = false;         ///< the scene or the camera has moved since the previous frame
    BrushImages* brushes = nullptr; ///< brushes for chains; null if only the pen is used
    float pixels_per_mm = 1.0F;
    float line_step_px = 3.0F;     ///< approximate spacing of samples on chains
    float pixel_m_at_one = 0.001F; ///< size of a pixel at a distance of one; parallel: at any distance
    glm::uvec2 size_px{0};
    std::optional<gpu::BufferId> look_of_draw; ///< set if surfaces have style variants: r32ui texels
    std::optional<gpu::BufferId> line_looks;   ///< set with it: LineLook of each variant; only for chains
    /// Visibility of the surfaces that hide chains, if it differs from all solid surfaces: clear glass hides
    /// none.
    std::optional<gpu::BufferId> line_hiders;
};

/// Largest distance in pixels from a pixel to the seeds of the lines that cover it, for lines in screen
/// space.
[[nodiscard]] uint32_t reach_px(const ContourStyle& style, float pixels_per_mm);

/// Draws lines in screen space: discontinuities of identity, depth and normal become seeds, placed where the
/// front triangle ends. Jump flooding gives every pixel its nearest seed, and from it an antialiased line of
/// any width.
///
/// Writes  rgba8: square root of the ink's linear colour; coverage in alpha, 0 paper to 1 ink
/// Cost    two full-screen dispatches, and one for each doubling of the width
/// Source  Saito and Takahashi, "Comprehensible Rendering of 3-D Shapes", 1990; Rong and Tan, "Jump
/// Flooding", 2006
[[nodiscard]] gpu::ImageId add_contours(gpu::Graph& graph, const ContourInputs& in,
                                        const ContourStyle& style);

} // namespace estampe::contour
