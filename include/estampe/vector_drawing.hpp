// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace estampe {

/// What a stroke represents. Kinds are listed in drawing order, from bottom to top.
enum class StrokeKind : uint8_t {
    hatch,        ///< Hatching, which carries tone
    shadow,       ///< Edge of a cast shadow
    suggestive,   ///< Suggestive contour: where a surface would turn away if the camera moved slightly
    crest,        ///< Crest of the terrain
    valley,       ///< Rounded concave fold
    ridge,        ///< Rounded convex fold
    crease,       ///< Sharp fold
    marked,       ///< Edge that the file marks
    intersection, ///< Where surfaces intersect
    boundary,     ///< Between materials
    border,       ///< Open edge of a surface
    outline,      ///< Where a surface turns away from the camera
    focus,        ///< Focus line, which points at the subject
    frame,        ///< Frame around the picture, at its margin
};

/// The name of a kind, as in the enumeration: "hatch", "crease" and so on.
[[nodiscard]] const char* name_of(StrokeKind kind);

/// A point of a stroke.
struct VectorPoint {
    glm::vec2 page_mm{0.0F}; ///< From the upper left corner of the page, y down
    float width_mm = 0.0F;   ///< Full width of the stroke
    bool operator==(const VectorPoint&) const = default;
};

/// One pen stroke, as a centre line with widths.
struct VectorStroke {
    StrokeKind kind = StrokeKind::outline;
    bool is_hidden = false;          ///< Hidden by a surface
    bool is_closed = false;          ///< The last point equals the first, and the curve is smooth there
    uint32_t object = 0;             ///< Index into VectorDrawing::objects
    uint32_t ink = 0;                ///< Index into VectorDrawing::inks_srgb
    std::vector<VectorPoint> points; ///< At least two, all on the page
};

/// A drawing as pen strokes. The order is always the same for the same scene and style.
struct VectorDrawing {
    float width_mm = 0.0F; ///< Width of the page
    float height_mm = 0.0F;
    float hatch_width_mm = 0.0F;      ///< Width of a hatching stroke at the usual pressure
    float dash_mm = 1.2F;             ///< Length of the dashes of hidden strokes
    float dash_gap_mm = 0.9F;         ///< Gap between the dashes
    bool has_mitred_corners = false;  ///< Corners of strokes of constant width are mitred; otherwise round
    glm::vec3 paper_srgb{1.0F};       ///< Components from 0 to 1
    bool has_paper = true;            ///< Whether a file has a background rectangle in the paper colour
    std::vector<glm::vec3> inks_srgb; ///< Components from 0 to 1; all different
    std::vector<std::string> objects; ///< Names, none empty; names may repeat
    std::vector<VectorStroke> strokes;
};

/// Settings of an SVG file.
struct SvgSettings {
    /// Largest distance of curves from the points of a stroke.
    float tolerance_mm = 0.02F;
    /// For pen plotters: centre lines only, one layer per pen, in the order of the drawing, no paper.
    bool is_for_plotter = false;
};

/// Writes `drawing` as SVG in millimetres. Strokes become cubic curves that keep sharp corners; a stroke of
/// constant width becomes a stroked line, others become filled shapes. Each kind is an Inkscape layer with
/// one group per object, and hidden strokes have dashed layers of their own. The same drawing gives the same
/// bytes. The file is written beside `path` and renamed. Throws Error if the page has no size or the folder
/// is not writable. Cost: about 2 us per point.
void save_svg(const VectorDrawing& drawing, const std::filesystem::path& path,
              const SvgSettings& settings = {});

/// Work of a plotter for one drawing.
struct PlotterWork {
    size_t strokes = 0;
    double drawn_mm = 0.0;  ///< Distance with the pen down
    double lifted_mm = 0.0; ///< Distance with the pen up, starting at the upper left corner, pen by pen
};

/// Measures the work of a plotter that draws the strokes in their order, all strokes of one pen before those
/// of the next.
[[nodiscard]] PlotterWork plotter_work(const VectorDrawing& drawing);

/// Prepares a drawing for a plotter, whose pens have one width each. Hatching thinner than half its usual
/// width is removed, so that the tone stays the same. Hidden strokes are cut into dashes. Strokes that
/// repeat an earlier stroke, or that are shorter than the hatching width, are removed. Strokes are sorted by
/// pen, then ordered and reversed to shorten the travel with the pen up. The same drawing gives the same
/// order.
///
/// Cost    about 1 s for 20 000 strokes
/// Source  Croes, "A Method for Solving Traveling-Salesman Problems", 1958 (2-opt)
void prepare_for_plotter(VectorDrawing& drawing);

} // namespace estampe
