// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace estampe {

/// Kind of a stroke: the tone or line that the stroke represents. Kinds are listed in drawing order, from
/// bottom to top.
enum class StrokeKind : uint8_t {
    hatch,        ///< Hatching stroke, which carries tone
    shadow,       ///< Line at the edge of a cast shadow
    suggestive,   ///< Suggestive contour: a line where a surface would turn away if the camera moved slightly
    leaf,         ///< Mark where the light ends on a clump of leaves
    crest,        ///< Line along the crest of a dune of the terrain
    valley,       ///< Valley line, along a rounded concave fold
    ridge,        ///< Ridge line, along a rounded convex fold
    crease,       ///< Line along a sharp fold
    marked,       ///< Line along an edge that the scene's file marks
    intersection, ///< Line where two surfaces intersect
    boundary,     ///< Line between two materials
    border,       ///< Line along the open edge of a surface
    outline,      ///< Line where a surface turns away from the camera
    focus,        ///< Focus line, which points at the subject
    frame,        ///< Frame line around the picture, at its margin
};

/// Returns the name of a kind of stroke, as in the enumeration: "hatch", "crease" and so on.
[[nodiscard]] const char* name_of(StrokeKind kind);

/// A point of a pen stroke's centre line, with the width of the stroke there.
struct VectorPoint {
    glm::vec2 page_mm{0.0F}; ///< Position on the page from the upper left corner; y points down
    float width_mm = 0.0F;   ///< Full width of the stroke at this point
    bool operator==(const VectorPoint&) const = default;
};

/// One pen stroke: a centre line with a width at each point.
struct VectorStroke {
    StrokeKind kind = StrokeKind::outline;
    bool is_hidden = false; ///< A surface hides the stroke
    /// The stroke is a loop: its last point equals the first, and the curve is smooth there.
    bool is_closed = false;
    uint32_t object = 0; ///< Object that the stroke belongs to, as an index of VectorDrawing::objects
    uint32_t ink = 0;    ///< Ink of the stroke, as an index of VectorDrawing::inks_srgb
    std::vector<VectorPoint> points; ///< Points of the stroke in drawing order: at least two, all on the page
};

/// A drawing as pen strokes. The same scene and style always give the same order of strokes.
struct VectorDrawing {
    float width_mm = 0.0F; ///< Width of the page
    float height_mm = 0.0F;
    float hatch_width_mm = 0.0F; ///< Width of a hatching stroke at normal pen pressure
    float dash_mm = 1.2F;        ///< Length of the dashes of hidden strokes
    float dash_gap_mm = 0.9F;    ///< Length of the gaps between the dashes of hidden strokes
    /// True: strokes of constant width have mitred corners. False: round corners.
    bool has_mitred_corners = false;
    glm::vec3 paper_srgb{1.0F}; ///< sRGB colour of the paper, components from 0 to 1
    bool has_paper = true;      ///< A file of this drawing gets a background rectangle in the paper colour
    /// sRGB colours of the inks, components from 0 to 1; all colours are different.
    std::vector<glm::vec3> inks_srgb;
    std::vector<std::string> objects; ///< Names of the drawn objects; no name is empty, and names may repeat
    std::vector<VectorStroke> strokes;
};

/// Settings of an SVG file.
struct SvgSettings {
    /// Largest distance of the file's curves from the points of a stroke.
    float tolerance_mm = 0.02F;
    /// The file is for a pen plotter: centre lines only, one layer per pen, in the order of the drawing, no
    /// paper.
    bool is_for_plotter = false;
};

/// Writes `drawing` as SVG in millimetres. Strokes become cubic curves that keep sharp corners; a stroke of
/// constant width becomes a stroked line, a stroke of varying width becomes a filled shape. Each kind of
/// stroke is an Inkscape layer with one group per object, and hidden strokes have dashed layers of their own.
/// The same drawing gives the same bytes. The file is written beside `path` and renamed. Throws Error if the
/// page has no size or the folder is not writable. Cost: about 2 us per point.
void save_svg(const VectorDrawing& drawing, const std::filesystem::path& path,
              const SvgSettings& settings = {});

/// Distances that a plotter's pen travels for one drawing.
struct PlotterWork {
    size_t strokes = 0;
    double drawn_mm = 0.0; ///< Distance that the pen travels on the paper
    /// Distance that the pen travels while lifted, starting at the upper left corner of the page.
    double lifted_mm = 0.0;
};

/// Computes how far a plotter's pen travels. The plotter draws the strokes in the drawing's order, but all
/// strokes of one pen before the strokes of the next pen.
[[nodiscard]] PlotterWork plotter_work(const VectorDrawing& drawing);

/// Prepares a drawing for a plotter, whose pens have one width each. Hatching thinner than half its usual
/// width is removed, so that the tone stays the same. Hidden strokes are cut into dashes. A stroke is removed
/// if it repeats an earlier stroke, and hatching if it clogs the paper between two strokes. Strokes whose
/// ends continue each other, over a gap of about the pen's width, are joined. Strokes shorter than a
/// millimetre are removed, unless they are lines that stand alone. Strokes are sorted by pen, then ordered
/// and reversed to shorten the travel with the pen up. Equal drawings have equal orders of strokes.
///
/// Cost     about 1 s for 20 000 strokes
/// Sources  Croes, "A Method for Solving Traveling-Salesman Problems", 1958 (2-opt); Or, "Traveling
///          Salesman-Type Combinatorial Problems", 1976 (or-opt)
void prepare_for_plotter(VectorDrawing& drawing);

} // namespace estampe
