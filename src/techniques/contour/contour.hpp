// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "gpu/graph/graph.hpp"
#include "shaders/shared.hpp"
#include "style/parameter.hpp"

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
    float outline_mm = 0.42F;
    float boundary_mm = 0.24F;
    float crease_mm = 0.26F;
    float crease_deg = 34.0F;
    float marked_mm = 0.24F;
    float ridge_mm = 0.0F;
    float valley_mm = 0.0F;
    float ridge_deg = 15.0F;
    float suggestive_mm = 0.0F;
    float suggestive_growth = 15.0F;
    float suggestive_deg = 20.0F;
    float intersection_mm = 0.0F;
    float shadow_mm = 0.0F;
    float depth_step = 1.0F;
    std::string brush = "pen";
    std::string outline_brush;
    std::string boundary_brush;
    std::string crease_brush;
    BrushFit brush_fit = BrushFit::repeat;
    float brush_mm = 0.0F;
    float outline_m = 0.0F;
    float boundary_m = 0.0F;
    float crease_m = 0.0F;
    Joints joints = Joints::round;
    float pressure = 0.8F;
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

/// Brushes that are known by name; any other is the path of a picture.
inline const std::vector<std::string>& brush_names()
{
    static const std::vector<std::string> names{"pen", "pencil", "charcoal", "brush"};
    return names;
}

inline const style::Table<ContourStyle>& contour_table()
{
    static const auto table =
        style::Table<ContourStyle>("contour", "Ink lines where surfaces end, meet or fold")
            .toggle("drawn", &ContourStyle::drawn, "Whether there are lines at all")
            .choice(
                "lines", &ContourStyle::lines, {{"chains", Lines::chains}, {"page", Lines::page}},
                "How lines are found: strokes along true edges (chains), or breaks between pixels (page), "
                "which is the quicker for large meshes")
            .choice("silhouettes", &ContourStyle::silhouettes,
                    {{"smooth", Silhouettes::smooth}, {"edges", Silhouettes::edges}},
                    "Outlines of chains run across the faces as the shading bends, or along the edges")
            .color("ink", &ContourStyle::ink,
                   "Colour of the ink; a material with an outline of its own brings its own")
            .number("outline_mm", &ContourStyle::outline_mm, {0.0F, 20.0F}, "mm",
                    "Width around objects and before what lies behind")
            .number("boundary_mm", &ContourStyle::boundary_mm, {0.0F, 20.0F}, "mm", "Width between materials")
            .number("crease_mm", &ContourStyle::crease_mm, {0.0F, 20.0F}, "mm", "Width along sharp folds")
            .number("crease_deg", &ContourStyle::crease_deg, {1.0F, 180.0F}, "deg",
                    "Fold from which it is sharp")
            .number("marked_mm", &ContourStyle::marked_mm, {0.0F, 20.0F}, "mm",
                    "Width along edges that a glTF file marks, where chains then draw no other folds and "
                    "borders; 0 leaves the marks aside")
            .number("ridge_mm", &ContourStyle::ridge_mm, {0.0F, 20.0F}, "mm",
                    "Width along rounded folds outwards, drawn by chains; 0 draws none")
            .number("valley_mm", &ContourStyle::valley_mm, {0.0F, 20.0F}, "mm",
                    "Width along rounded folds inwards, drawn by chains; 0 draws none")
            .number("ridge_deg", &ContourStyle::ridge_deg, {0.5F, 180.0F}, "deg",
                    "How far a surface must turn over a hundredth of its object's size to be a rounded fold")
            .number(
                "suggestive_mm", &ContourStyle::suggestive_mm, {0.0F, 20.0F}, "mm",
                "Width of suggestive contours, where a surface would turn away if the eye moved, drawn by "
                "chains; 0 draws none")
            .number("suggestive_growth", &ContourStyle::suggestive_growth, {0.0F, 10000.0F}, "",
                    "How fast a surface there must begin to bend towards the eye, for objects of one size: "
                    "less draws more")
            .number("suggestive_deg", &ContourStyle::suggestive_deg, {1.0F, 89.0F}, "deg",
                    "Least angle between the view and a surface that has suggestive contours")
            .number("intersection_mm", &ContourStyle::intersection_mm, {0.0F, 20.0F}, "mm",
                    "Width where objects run into each other, drawn by chains; 0 draws none")
            .number("shadow_mm", &ContourStyle::shadow_mm, {0.0F, 20.0F}, "mm",
                    "Width along edges of the sun's shadows, drawn by chains; 0 draws none")
            .number("depth_step", &ContourStyle::depth_step, {0.05F, 100.0F}, "",
                    "How far a surface must fall away behind another to be lined: less draws more")
            .file_or_name("brush", &ContourStyle::brush, brush_names(),
                          "What draws the strokes of chains: a tool, or the PNG of one stroke from left to "
                          "right, in its alpha or in black on white")
            .file_or_name("outline_brush", &ContourStyle::outline_brush, brush_names(),
                          "Another brush around objects; empty for that of all")
            .file_or_name("boundary_brush", &ContourStyle::boundary_brush, brush_names(),
                          "Another brush between materials")
            .file_or_name("crease_brush", &ContourStyle::crease_brush, brush_names(),
                          "Another brush along sharp folds")
            .choice("brush_fit", &ContourStyle::brush_fit,
                    {{"repeat", BrushFit::repeat}, {"stretch", BrushFit::stretch}},
                    "A brush comes again and again along a stroke, at one length and held to the surface as "
                    "things move, or once, from end to end")
            .number("brush_mm", &ContourStyle::brush_mm, {0.0F, 1000.0F}, "mm",
                    "Length after which a brush repeats; 0 for what its picture makes it at the line's width")
            .number(
                "outline_m", &ContourStyle::outline_m, {0.0F, 1000.0F}, "m",
                "Width around objects in the scene, of chains: nearer is wider; 0 for outline_mm of the page")
            .number("boundary_m", &ContourStyle::boundary_m, {0.0F, 1000.0F}, "m",
                    "The same between materials")
            .number("crease_m", &ContourStyle::crease_m, {0.0F, 1000.0F}, "m", "The same along sharp folds")
            .choice("joints", &ContourStyle::joints, {{"round", Joints::round}, {"mitre", Joints::mitre}},
                    "Corners of strokes of chains, and where strokes end at one point")
            .number("pressure", &ContourStyle::pressure, {0.0F, 1.0F}, "",
                    "How much the width of a line varies along it")
            .choice(
                "pressure_from", &ContourStyle::pressure_from,
                {{"light", PressureFrom::light}, {"turn", PressureFrom::turn}, {"both", PressureFrom::both}},
                "Where lines swell: in the shade, where strokes of chains bend, or in both")
            .number("distance_thinning", &ContourStyle::distance_thinning, {0.0F, 1.0F}, "",
                    "How much lines thin with distance")
            .number("taper_mm", &ContourStyle::taper_mm, {0.0F, 100.0F}, "mm",
                    "How far from its ends a stroke of a chain begins to thin")
            .number("overshoot_mm", &ContourStyle::overshoot_mm, {0.0F, 20.0F}, "mm",
                    "How far strokes of chains run beyond their ends")
            .number("wobble_mm", &ContourStyle::wobble_mm, {0.0F, 20.0F}, "mm",
                    "How far strokes of chains sway to either side")
            .integer("strokes", &ContourStyle::strokes, {1, 3}, "",
                     "How often the hand goes over a line of chains, each time a little otherwise")
            .number("retrace_mm", &ContourStyle::retrace_mm, {0.0F, 20.0F}, "mm",
                    "How far later strokes of a line stray from the first")
            .number("jitter_ends_mm", &ContourStyle::jitter_ends_mm, {0.0F, 20.0F}, "mm",
                    "How far strokes of chains end too early or too late")
            .number("jitter_offset_mm", &ContourStyle::jitter_offset_mm, {0.0F, 20.0F}, "mm",
                    "How far strokes of chains lie beside their line")
            .number("jitter_width", &ContourStyle::jitter_width, {0.0F, 0.9F}, "",
                    "How much strokes of chains differ in width, as a share")
            .choice("hidden", &ContourStyle::hidden, {{"none", Hidden::none}, {"dashed", Hidden::dashed}},
                    "Lines of chains behind something")
            .number("hidden_mm", &ContourStyle::hidden_mm, {0.0F, 20.0F}, "mm", "Width of hidden lines")
            .number("hidden_dash_mm", &ContourStyle::hidden_dash_mm, {0.1F, 100.0F}, "mm",
                    "Length of their dashes")
            .number("hidden_gap_mm", &ContourStyle::hidden_gap_mm, {0.1F, 100.0F}, "mm",
                    "Length of the gaps between them")
            .integer("seed", &ContourStyle::seed, {0, 1000000}, "", "Another hand for another number");
    return table;
}

struct BrushImages;

struct ContourInputs {
    gpu::BufferId frame; ///< FrameGlobals
    gpu::BufferId visibility;
    gpu::BufferId triangles;
    gpu::BufferId posed_vertices;
    gpu::BufferId draws;
    gpu::BufferId materials;
    bool own_outlines = false; ///< some material brings an outline of its own
    gpu::ImageId draw;
    gpu::ImageId depth;
    gpu::ImageId normal;
    gpu::ImageId coordinate;
    gpu::ImageId light;
    gpu::ImageId screen_draw; ///< of what is looked through; one texel for none
    bool has_screen = false;
    bool only_cut = false;          ///< only what a texture's alpha cuts has lines
    bool on_processor = false;      ///< the device is no GPU
    bool is_moving = false;         ///< seen otherwise than in the frame before
    BrushImages* brushes = nullptr; ///< of chains; none for the pen alone
    float pixels_per_mm = 1.0F;
    float pixel_angle = 0.001F; ///< size of a pixel at distance one
    glm::uvec2 size_px{0};
};

/// Draws lines in screen space: breaks of identity, depth and normal become seeds, placed where the front
/// triangle ends; jump flooding gives every pixel its nearest seed, and with it an antialiased line of any
/// width.
///
/// Writes  rgba8: square root of the ink's linear colour; coverage in alpha, 0 paper to 1 ink
/// Cost    two full-screen dispatches, and one for each doubling of the width
/// Source  Saito and Takahashi, "Comprehensible Rendering of 3-D Shapes", 1990; Rong and Tan, "Jump
/// Flooding", 2006
[[nodiscard]] gpu::ImageId add_contours(gpu::Graph& graph, const ContourInputs& in,
                                        const ContourStyle& style);

} // namespace estampe::contour
