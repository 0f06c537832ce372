// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace estampe {

/// What a stroke stands for, in the order in which strokes lie upon each other.
enum class StrokeKind : uint8_t {
    hatch,        ///< carries tone
    shadow,       ///< along the edge of a shadow
    suggestive,   ///< where a surface would turn away if the eye moved
    crest,        ///< along a crest of the ground
    valley,       ///< along a rounded fold inwards
    ridge,        ///< along a rounded fold outwards
    crease,       ///< along a sharp fold
    marked,       ///< along an edge that the file marks
    intersection, ///< where surfaces run into each other
    boundary,     ///< between materials
    border,       ///< where a surface ends
    outline,      ///< where a surface turns away
    focus,        ///< points at what matters
    frame,        ///< around the picture, at its margin
};

/// The same word: "hatch", "crease" and so on.
[[nodiscard]] const char* name_of(StrokeKind kind);

/// A point of a stroke.
struct VectorPoint {
    glm::vec2 page_mm{0.0F}; ///< from the upper left corner, y down
    float width_mm = 0.0F;   ///< of the whole stroke
    bool operator==(const VectorPoint&) const = default;
};

/// One stroke of the pen: the middle of the line, and how wide it is.
struct VectorStroke {
    StrokeKind kind = StrokeKind::outline;
    bool is_hidden = false; ///< lies behind something
    bool is_closed = false; ///< the last point is the first again, and the line goes smoothly over it
    uint32_t object = 0;    ///< into VectorDrawing::objects
    uint32_t ink = 0;       ///< into VectorDrawing::inks_srgb
    std::vector<VectorPoint> points; ///< two or more, all on the page
};

/// A drawing as strokes of pens, in a fixed order for a fixed scene and style.
struct VectorDrawing {
    float width_mm = 0.0F;
    float height_mm = 0.0F;
    float hatch_width_mm = 0.0F;      ///< of a stroke of the hatching that is pressed no harder than usual
    float dash_mm = 1.2F;             ///< of hidden strokes
    float dash_gap_mm = 0.9F;         ///< between the dashes
    bool has_mitred_corners = false;  ///< of strokes of one width; else corners are round
    glm::vec3 paper_srgb{1.0F};       ///< components 0 to 1
    bool has_paper = true;            ///< else a file has no rectangle of that colour
    std::vector<glm::vec3> inks_srgb; ///< components 0 to 1; none twice
    std::vector<std::string> objects; ///< names, none empty; may repeat
    std::vector<VectorStroke> strokes;
};

/// How a drawing is written.
struct SvgSettings {
    /// How far curves may stray from the points of a stroke.
    float tolerance_mm = 0.02F;
    /// For pens that draw: lines along the middle only, a layer a pen, in the order of the drawing, no paper.
    bool is_for_plotter = false;
};

/// Writes `drawing` as SVG in millimetres, beside `path` first and renamed into place. Strokes become cubic
/// curves; corners stay. What is of one width is a line of that width, other strokes are filled shapes. Each
/// kind is a layer as Inkscape has them, each object a group in it; hidden strokes have dashed layers of
/// their own. The same drawing gives the same bytes. Throws Error when the page has no size or the folder
/// cannot be written. Cost: about 2 us a point.
void save_svg(const VectorDrawing& drawing, const std::filesystem::path& path,
              const SvgSettings& settings = {});

/// What a plotter has to do.
struct PlotterWork {
    size_t strokes = 0;
    double drawn_mm = 0.0;  ///< with the pen down
    double lifted_mm = 0.0; ///< with the pen up, from the upper left corner on, pen after pen
};

/// What drawing the strokes as they come asks of a plotter, all of one pen before those of the next.
[[nodiscard]] PlotterWork plotter_work(const VectorDrawing& drawing);

/// Makes a drawing ready for a plotter, whose pens have one width each. Hatching thinner than half its usual
/// width is left out, so that tone stays as it is; hidden strokes are cut into dashes; what runs along a
/// stroke drawn already is left out, and so is what is shorter than hatching is wide. Strokes are then sorted
/// by pen, and brought into an order, and turned, such that the pen travels less in the air. The same drawing
/// gives the same order.
///
/// Cost    about 1 s for 20 000 strokes
/// Source  Croes, "A Method for Solving Traveling-Salesman Problems", 1958 (2-opt)
void prepare_for_plotter(VectorDrawing& drawing);

} // namespace estampe
