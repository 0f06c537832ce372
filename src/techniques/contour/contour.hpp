// SPDX-License-Identifier: MIT
#pragma once

#include "gpu/graph/graph.hpp"
#include "shaders/shared.hpp"
#include "style/parameter.hpp"

namespace estampe::contour {

enum class Lines : uint8_t { chains, page };

enum class Silhouettes : uint8_t { smooth, edges };

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
    float depth_step = 1.0F;
    float pressure = 0.8F;
    float distance_thinning = 0.7F;
    float taper_mm = 6.0F;
    float overshoot_mm = 0.0F;
    float wobble_mm = 0.0F;
    int seed = 1;
};

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
            .number("depth_step", &ContourStyle::depth_step, {0.05F, 100.0F}, "",
                    "How far a surface must fall away behind another to be lined: less draws more")
            .number("pressure", &ContourStyle::pressure, {0.0F, 1.0F}, "",
                    "How much a line swells in the shade and thins in the light")
            .number("distance_thinning", &ContourStyle::distance_thinning, {0.0F, 1.0F}, "",
                    "How much lines thin with distance")
            .number("taper_mm", &ContourStyle::taper_mm, {0.0F, 100.0F}, "mm",
                    "How far from its ends a stroke of a chain begins to thin")
            .number("overshoot_mm", &ContourStyle::overshoot_mm, {0.0F, 20.0F}, "mm",
                    "How far strokes of chains run beyond their ends")
            .number("wobble_mm", &ContourStyle::wobble_mm, {0.0F, 20.0F}, "mm",
                    "How far strokes of chains sway to either side")
            .integer("seed", &ContourStyle::seed, {0, 1000000}, "", "Another hand for another number");
    return table;
}

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
    bool only_cut = false;     ///< only what a texture's alpha cuts has lines
    bool on_processor = false; ///< the device is no GPU
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
